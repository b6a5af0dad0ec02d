#pragma once

#include "cycles/heidenhain/context.hpp"

/// What the cycles that touch one point from a programmed pre-position have in common (0, 1).
namespace probewright::cycles::heidenhain {

/// In a straight line, all axes at once and without clearance height, to the pre-position of the block (the words
/// probe_word::coordinate), from wherever the probe stands.
void moveToProgrammedPosition(Context& context);

/// Of cycle 0, which chooses its parameter by its first word; cycle 1 leaves those after the first.
inline constexpr ResultDefinition singleTouchResults[] = {
    {"Qn", {"measured ", "coordinate"}, result::actual(of::coordinate).main()},
    {"Q115", "position at the touch, X", result::touched(of::positionX).fallback()},
    {"Q116", "position at the touch, Y", result::touched(of::positionY).fallback()},
    {"Q117", "position at the touch, Z", result::touched(of::positionZ).fallback()},
    {"Q118", "position at the touch, 4th axis", result::touched(of::position4)},
    {"Q119", "position at the touch, 5th axis", result::touched(of::position5)},
};

/// Sets Q115 to Q119: the position at the touch in X, Y, Z and the first two rotary axes, in the active
/// coordinate system. Stylus length and ball radius are not taken into account: it is the tool reference point's.
void storeTouchPosition(Context& context, const EvaluatedTouch& touch);

}  // namespace probewright::cycles::heidenhain
