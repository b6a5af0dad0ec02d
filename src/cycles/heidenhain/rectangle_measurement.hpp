#pragma once

#include "cycles/heidenhain/context.hpp"

/// What cycles 410, 411, 423 and 424 have in common: a rectangle measured from their parameters.
namespace probewright::cycles::heidenhain {

struct MeasuredRectangle {
  Vector3 centre = Vector3::Zero();
  double length1 = 0, length2 = 0;  ///< along main and minor axis
};

/// Which Q parameters hold the nominal rectangle.
struct RectangleParameters {
  int centre1 = 0, centre2 = 0, length1 = 0, length2 = 0;
};

/// Touches the middle of the four sides as Q261, Q320, Q260 and Q301 say. The centre lies half way between opposite
/// touches; on a rectangle skewed by a small angle the lengths are too large by the factor 1/cos(angle), as on the
/// control.
MeasuredRectangle measureRectangle(Context& context, const RectangleParameters& numbers, Side side);

/// The same for the two walls of a slot or ridge across axis 0 (main) or 1 (minor).
struct MeasuredWidth {
  double centre = 0;  ///< coordinate of the centre line in the measured axis
  double width = 0;
  double height = 0;  ///< measuring height
};
MeasuredWidth measureWidth(Context& context, const Vector2& centre, double width, int axis, Side side,
                           bool betweenAtClearance);

}  // namespace probewright::cycles::heidenhain
