#pragma once

#include "cycles/heidenhain/context.hpp"

/// What cycles 412, 413, 421 and 422 have in common: a circle measured from their parameters.
namespace probewright::cycles::heidenhain {

struct MeasuredCircle {
  Vector3 centre = Vector3::Zero();  ///< in the measuring plane; the third coordinate is the measuring height
  double diameter = 0;
};

/// Which Q parameters hold the nominal circle.
struct CircleParameters {
  int centre1 = 0, centre2 = 0, diameter = 0;
};

/// Touches the circle as Q325, Q247, Q261, Q320, Q260, Q301, Q423 and Q365 say and fits it: three touches exactly, four
/// by least squares. Throws Alarm for a stepping angle below 5 degrees.
MeasuredCircle measureCircle(Context& context, const CircleParameters& numbers, Side side);

}  // namespace probewright::cycles::heidenhain
