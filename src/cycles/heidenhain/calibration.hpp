#pragma once

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/parameters.hpp"
#include "probing/heidenhain_strategies.hpp"

/// What the calibration cycles 460 to 463 have in common.
namespace probewright::cycles::heidenhain {

namespace parameters {

/// Q407 of ring, stud and sphere.
constexpr Parameter standardRadius(std::string_view meaning) {
  return {.name = "Q407",
          .address = 407,
          .meaning = meaning,
          .kind = ValueKind::Length,
          .minimum = 0.0001,
          .maximum = 99.9999};
}

inline constexpr Parameter calibrationTouches = {.name = "Q423",
                                                 .address = 423,
                                                 .meaning = "number of touches around the standard",
                                                 .kind = ValueKind::Integer,
                                                 .minimum = 3,
                                                 .maximum = 8};

inline constexpr Parameter calibrationStartAngle =
    angle(380, "Q380", "angle of the first touch from the main axis", 0, 360);

}  // namespace parameters

/// One pass around the standard.
struct CalibrationPass {
  std::string_view name;  ///< in English, for the log
  int touches = 0;
  Vector2 centre = Vector2::Zero();
  double ballRadius = 0;
};

/// What a radius calibration has found.
struct CalibratedRadius {
  PartPoint centre = {};  ///< of ring, stud or sphere; as the spindle axis sees it at CAL_ANG
  double radius = 0;      ///< effective ball radius
  std::optional<Vector2> centreOffset = std::nullopt;  ///< CAL_OF1, CAL_OF2, if the spindle can reverse the probe
  double standardRadius = 0;
  std::vector<CalibrationPass> passes = {};  ///< in the order in which they were made
};

struct CalibrationTask {
  Vector2 centre = Vector2::Zero();  ///< rough centre of the standard
  double standardRadius = 0;
  Side side = Side::Inside;
  int count = 4;  ///< touches of the fine measurement
  double startAngle = 0;
  double measuringHeight = 0;  ///< of the ball centre
  double travelHeight = 0;     ///< of the ball centre, on the way to a stud or sphere and back
  double extraClearance = 0;
  probing::Between between = probing::Between::AtClearanceHeight;  ///< around a stud or sphere
  bool centreOffset = true;  ///< false: only the radius is wanted, so the probe is not turned by 180 degrees
};

/// The prober for calibrating: without tip offset, turned to CAL_ANG where the spindle can be oriented, with the
/// radius of the tool table as a first guess. Only a stylus whose ball stands aside is turned to every touch, with the
/// offset of the touch probe table as a first guess.
probing::HeidenhainProber calibrationProber(Context& context);

/// Coarse measurement of the centre by four touches, fine measurement by `count` touches from there; then, if the
/// spindle can be oriented, as many more touches with the probe turned by 180 degrees, which give the centre offset.
/// With TRACK = ON the radius is that of as many more touches with the probe turned to each. A ball that stands aside
/// can touch with one half of its surface only: turned to every touch it tells how far it reaches, held across two
/// touches how far of that is ball and how far offset.
CalibratedRadius calibrateRadius(Context& context, probing::HeidenhainProber& prober, CalibrationTask task);

/// Writes R and the centre offset, puts them into effect and, on the TNC 640, notes them in TCHPRAUTO.html with the
/// passes that found them.
void storeRadius(Context& context, const CalibratedRadius& calibrated);

/// The length with which the control now computes, that of the oversizes included.
double activeLength(Context& context);

/// Writes the effective length L (DL becomes 0), puts it into effect and, on the TNC 640, notes it in TCHPRAUTO.html
/// with the reference point (Q434).
void storeLength(Context& context, double length);

}  // namespace probewright::cycles::heidenhain
