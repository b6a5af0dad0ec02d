#pragma once

#include <array>

#include "cycles/heidenhain/context.hpp"
#include "metrology/elements.hpp"

/// What cycles 414 and 415 have in common: a corner of two sides with two touches each.
namespace probewright::cycles::heidenhain {

/// Two touches of the side along the main axis, then two of the side along the minor axis.
using CornerTouches = std::array<PlannedTouch, 4>;

struct MeasuredCorner {
  PartPoint point;
  metrology::Line2 firstSide;
};

/// Touches at the measuring height Q261 with Q320, Q260 and Q301. The sides are lines through the ball centres, moved
/// by the ball radius into the material, and hold at any skew. At an outside corner the way from the first to the
/// second side leads around it.
MeasuredCorner measureCorner(Context& context, const CornerTouches& touches, Side side);

/// Results Q151 and Q152, the preset in both axes, and the basic rotation from the first side if Q304 = 1.
void presetCorner(Context& context, const MeasuredCorner& corner);

}  // namespace probewright::cycles::heidenhain
