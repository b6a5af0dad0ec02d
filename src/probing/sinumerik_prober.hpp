#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>

#include "control/channel.hpp"
#include "control/working_plane.hpp"

/// The measuring move and the positioning habits of the SINUMERIK measuring cycles.
namespace probewright::probing {

/// A calibration data set (SD 54600 to 54611, one index) and what the tool data say about the probe.
///
/// A trigger point is the way from the tool centre point at the signal to the surface along its axis: for an ideal ball
/// +radius in plus direction, -radius in minus direction. Axes: 1st, 2nd, 3rd axis of the plane.
struct SinumerikProbe {
  double ballDiameter = 0;                      ///< SD 54600, effective
  std::array<double, 3> triggerMinus{};         ///< SD 54601, 54603, 54605
  std::array<double, 3> triggerPlus{};          ///< SD 54602, 54604, 54606
  Vector2 positionDeviation = Vector2::Zero();  ///< SD 54607, 54608
  double feed = 300;                            ///< SD 54611, mm/min
  bool monodirectional = false;                 ///< tool type 712: the spindle turns the probe into each direction
  double correctionAngle = 0;                   ///< $TC_DP10, degrees
  bool calibrationWatched = true;               ///< MD 51740 bit 0: unknown trigger points are refused
  bool lengthToCentre = false;                  ///< the tool length ends at the ball's centre, not at its south pole
  double starBallRadius = 0;  ///< of a star: of each of its balls, which ballDiameter goes across; else 0
};

/// Speeds and habits from setting data.
struct SinumerikHabits {
  double planeFeed = 1000;                       ///< SD 55634, mm/min
  double infeedFeed = 1000;                      ///< SD 55636, mm/min
  double circleFeed = 1000;                      ///< SD 55640, mm/min
  double fastFeed = 900;                         ///< SD 55638, mm/min
  double rapidPercent = 50;                      ///< SD 55632
  bool monitorCollisions = true;                 ///< SD 55740 bit 0
  bool oneAttempt = false;                       ///< SD 55740 bit 3
  bool fastApproach = false;                     ///< SD 55740 bit 4
  bool rapidRetract = false;                     ///< SD 55740 bit 5
  std::function<void()> spindlePositioned = {};  ///< called after each positioning of the spindle
};

/// One measured point.
struct MeasuredPoint {
  /// Tool centre point at the signal (mean of the measurements), as if the tool stood upright on the
  /// plane: SinumerikProber::uprightTcp().
  PlanePlace tcp;
  PartPoint surface;               ///< by trigger points
  machine::AxisPositions latched;  ///< of the last measurement
  std::size_t record = 0;          ///< the place of its touch in the cycle's record
};

/// A direction of the plane as the spindle sees it as it stands now, wherever frames and rotary axes have turned the
/// workpiece or the head: X, Y, Z of the spindle's frame at spindle angle 0, unit length.
Vector3 directionFromSpindle(const control::Channel& channel, const control::WorkingPlane& plane,
                             const PlaneWay& direction);

/// The angle about the spindle axis at which a direction of the plane lies for the spindle as it stands now, wherever
/// frames and rotary axes have turned the workpiece or the head; degrees, from the plane's 1st axis at spindle angle 0.
double angleFromSpindle(const control::Channel& channel, const control::WorkingPlane& plane, const PlaneWay& direction);

/// Moves the probe in coordinates (1st, 2nd, 3rd axis of the plane) of the workpiece coordinate system. Positions are
/// those of the tool centre point (TCP), as the tool length defines it.
class SinumerikProber {
public:
  SinumerikProber(control::Channel& channel, const control::WorkingPlane& plane, const SinumerikProbe& probe,
                  SinumerikHabits habits)
      : channel_(channel), plane_(plane), probe_(probe), habits_(std::move(habits)) {}

  const SinumerikProbe& probe() const { return probe_; }
  double ballRadius() const { return probe_.ballDiameter / 2; }

  PlanePlace position() const;

  /// Positioning inside a cycle: in the plane, in the infeed axis; watched for collisions (alarm 61302).
  void moveTo(const PlanePlace& tcp);
  /// In the plane only, at the present height.
  void moveInPlane(const PlanePlace& tcp);
  /// In the infeed axis only.
  void moveHeightTo(double height);
  /// On an arc about `centre` in the plane, turning by `angle` degrees.
  void moveOnArc(const PartPoint& centre, double angle);

  /// Where the ball's centre lies beside the tool centre point, at right angles to `direction`, by the calibrated
  /// position deviation. measure() leads the ball's centre, not the tool centre point, along the line through the set
  /// point.
  PlaneWay lateralDeviation(const PlaneWay& direction) const;
  /// Where a tool that stands upright on the plane, its ball in the same place, would have its tool centre point, seen
  /// from the one that the tool has as it stands. Not 0 where the workpiece system is tilted against the tool and the
  /// tool length ends at the ball's south pole: the ball's centre lies a radius along the tool then, and trigger points
  /// count from it. In the plane for a `direction` of the plane: heights stay as they are programmed.
  PlaneWay uprightTcp(const PlaneWay& direction) const;
  /// Direction from the ball towards the spindle, unit length.
  PlaneWay toolAxis() const;
  /// True if the workpiece system is mirrored along an axis of the plane, as for a part in the counter-spindle. The
  /// other side of the ball touches there: trigger points and deviations are those of the machine's direction.
  bool mirrored(int axis) const;
  /// What the trigger points say for a direction (unit vector): the way from the TCP to the surface along it.
  double trigger(const PlaneWay& direction) const;

  /// Turns the spindle so that the probe's +X side looks into `direction`; nothing for directions along the tool.
  void alignTo(const PlaneWay& direction);

  /// Measures the surface expected at `setpoint` in `direction` (unit): moves to the start position `path` (DFA) in
  /// front of it, probes over at most twice that way, returns to the start position; `count` times (S_NMSP), averaged.
  /// With nothing touched, five attempts, then alarm 61301. Alarm 61341 if the probe was never calibrated in that
  /// direction.
  MeasuredPoint measure(const PartPoint& setpoint, const PlaneWay& direction, double path, int count = 1);

  /// The TCP at the signal without any compensation, for calibration; otherwise as measure(). `assumedTrigger` stands
  /// in for the trigger point while it is unknown. `part`: what of the stylus is meant to touch.
  MeasuredPoint measureUncompensated(const PartPoint& setpoint, const PlaneWay& direction, double path, int count,
                                     double assumedTrigger, double feed,
                                     control::TouchWith part = control::TouchWith::Ball);

private:
  MeasuredPoint stroke(const PartPoint& setpoint, const PlaneWay& direction, double path, int count,
                       const PlaneWay& surfaceFromTcp, double feed, control::TouchWith part = control::TouchWith::Ball);
  void orientTo(const PlaneWay& direction);
  Vector2 deviation() const;
  machine::Feed rapidTo(const PlanePlace& tcp) const;

  control::Channel& channel_;
  control::WorkingPlane plane_;
  SinumerikProbe probe_;
  SinumerikHabits habits_;
};

}  // namespace probewright::probing
