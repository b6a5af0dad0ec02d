#pragma once

#include "cycles/heidenhain/context.hpp"

/// What cycles 3 and 4 have in common: one measuring move from where the probe stands, and four Q parameters.
namespace probewright::cycles::heidenhain {

/// Program coordinates X, Y, Z or, with `inMachine`, machine coordinates.
struct FreeMeasurement {
  Vector3 direction = Vector3::UnitX();  ///< any length but 0
  double distance = 0;                   ///< mm; negative: against the direction
  bool directionInMachine = false;
  bool resultInMachine = false;
  bool withTipOffset = false;  ///< the result takes CAL_OF1, CAL_OF2 into account
  bool alarmIfDeflected = true;
};

/// Measures with the feed and retraction of the block and writes the ball centre and the status: 1 touched, -1 not.
/// Throws Alarm for a parameter number that leaves no room for four values.
void measureFreely(Context& context, const FreeMeasurement& measurement);

}  // namespace probewright::cycles::heidenhain
