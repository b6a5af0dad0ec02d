#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cycles/sinumerik/context.hpp"

/// What the calibration of a workpiece probe finds and where it goes.
namespace probewright::cycles::sinumerik {

/// Results of every calibration of a workpiece probe.
inline constexpr std::array<ResultDefinition, 24> calibrationResults = {{
    {"_OVR[4]", "effective diameter of the ball", result::actual(of::diameter).main()},
    {"_OVR[5]", {"difference of the ", "diameter"}, result::difference(of::diameter)},
    {"_OVR[8]", "trigger point, minus direction, 1st axis", result::touched(of::position1.number(1)).fallback()},
    {"_OVR[9]", "its difference", result::difference(of::position1.number(1))},
    {"_OVR[10]", "trigger point, plus direction, 1st axis", result::touched(of::position1.number(2)).fallback()},
    {"_OVR[11]", "its difference", result::difference(of::position1.number(2))},
    {"_OVR[12]", "trigger point, minus direction, 2nd axis", result::touched(of::position2.number(1)).fallback()},
    {"_OVR[13]", "its difference", result::difference(of::position2.number(1))},
    {"_OVR[14]", "trigger point, plus direction, 2nd axis", result::touched(of::position2.number(2)).fallback()},
    {"_OVR[15]", "its difference", result::difference(of::position2.number(2))},
    {"_OVR[16]", "trigger point, minus direction, 3rd axis", result::touched(of::position3.number(1)).fallback()},
    {"_OVR[17]", "its difference", result::difference(of::position3.number(1))},
    {"_OVR[18]", "trigger point, plus direction, 3rd axis", result::touched(of::position3.number(2)).fallback()},
    {"_OVR[19]", "its difference", result::difference(of::position3.number(2))},
    {"_OVR[20]", "position deviation of the ball, 1st axis", result::actual(of::eccentricity1).main()},
    {"_OVR[21]", "position deviation of the ball, 2nd axis", result::actual(of::eccentricity2).main()},
    {"_OVR[22]", "length of the probe", result::actual(of::length3).main()},
    {"_OVR[24]", "angle of the directions", result::actual(of::angle)},
    {"_OVR[27]", "zero offset range", result::setting(of::distance)},
    {"_OVR[28]", "safe area", result::setting(of::distance)},
    {"_OVI[2]", "number of the cycle", result::status},
    {"_OVI[3]", "measuring variant", result::setting()},
    {"_OVI[5]", "data set of the probe", result::setting()},
    {"_OVI[9]", "number of the alarm", result::status},
}};

/// Gathers what a calibration finds and writes all of it at the end (`store`), or nothing if a value is further from
/// its predecessor than the safe area allows.
class ProbeCalibration {
public:
  explicit ProbeCalibration(Context& context);

  /// The radius that start positions are computed with: as calibrated before, else as in the tool data. Of an L-shaped
  /// probe its reach: arm and ball.
  double assumedRadius() const;
  /// The tool centre point at the signal, mean of S_NMSP touches, with the feed of this calibration (S_VMS, or setting
  /// data). `assumed`: from the tool centre point to the surface.
  PlanePlace touch(const PartPoint& setpoint, const PlaneWay& direction, double path, double assumed);

  /// Axis 0, 1, 2; `sign` +1, -1: the direction of the touch.
  void setTrigger(int axis, double sign, double value);
  void setBallDiameter(double value);
  void setDeviation(int axis, double value);
  enum class Deviation { Measured, Kept };
  /// Ball diameter and, if wanted, deviation from both trigger points of one axis; from one where the other is unknown.
  void completeAxis(int axis, Deviation deviation);
  /// Adds to the geometry of the tool length that acts in an axis of the plane.
  void correctLength(int axis, double amount);

  /// What the variant's list of results names is shown even where it stays as it was: ball diameter, the trigger points
  /// of `axes`, the deviations, the length that acts in the 3rd axis.
  enum class Listed { Triggers, WithDeviations, WithLength, WithDeviationsAndLength };
  void list(std::vector<int> axes, Listed listed);

  /// Alarm 61303 or all written: setting data of the data set, and the ball radius to the tool data if the machine
  /// wants it there.
  void store();

private:
  double trigger(int axis, double sign) const;
  /// An L-shaped probe.
  bool bent() const;
  void showUnchanged();
  std::string lengthName(int axis) const;
  /// What is calibrated, into SD 54609 and 54610: a digit for each axis of the plane from the units on (1 minus, 2
  /// plus, 3 both directions); units the plane (1 G17), tens 1 with position deviation, hundreds 1 with the length.
  void noteStatus();

  struct Change {
    std::string name;
    int result;  ///< _OVR index
    double value;
    bool compared;  ///< with its predecessor: the difference is the next result
  };
  static Change triggerChange(int axis, double sign, double value);
  static Change ballDiameterChange(double value);
  static Change deviationChange(int axis, double value);
  Context& context_;
  int dataSet_;
  double feed_;
  std::vector<Change> changes_;
  std::vector<std::pair<int, double>> lengths_;
  std::vector<Change> listed_;  ///< by name and result
  bool listsLength_ = false;
};

}  // namespace probewright::cycles::sinumerik
