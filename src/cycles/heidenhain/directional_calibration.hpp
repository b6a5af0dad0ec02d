#pragma once

#include "cycles/heidenhain/calibration.hpp"

/// The 3-D calibration of cycle 460: how the probe responds in every direction.
namespace probewright::cycles::heidenhain {

struct DirectionalTask {
  Vector2 centre = Vector2::Zero();  ///< of the sphere in the plane
  bool centreKnown = false;          ///< false: `centre` still has the tip offset in it
  double standardRadius = 0;
  int rings = 0;          ///< touches between pole and equator, Q455
  int count = 4;          ///< touches around the sphere on each ring
  double startAngle = 0;  ///< of the first touch of a ring
  double extraClearance = 0;
  double travelHeight = 0;                                         ///< of the ball centre, between the rings
  probing::Between between = probing::Between::AtMeasuringHeight;  ///< the touches of a ring
};

/// Touches the pole of the sphere and `count` points on each of `rings` circles down to the equator, and writes what
/// the distances of the ball from the sphere's centre differ from ball and sphere radius into the table that DR2TABLE
/// names; without an entry a table named after the tool is made and entered. Radius and centre offset must be
/// calibrated. Throws Alarm if option 92 or the column is missing.
void calibrateDirections(Context& context, const DirectionalTask& task);

/// Refuses a 3-D calibration without option 92, or without column DR2TABLE in the tool table.
void requireDirectionalCalibration(Context& context);

}  // namespace probewright::cycles::heidenhain
