#pragma once

#include "cycles/heidenhain/context.hpp"

/// What the cycles that touch one point from a programmed pre-position have in common (0, 1).
namespace probewright::cycles::heidenhain {

/// In a straight line, all axes at once and without clearance height, to the pre-position of the block (the words
/// probe_word::coordinate), from wherever the probe stands.
void moveToProgrammedPosition(Context& context);

/// Of cycle 0, which chooses its parameter by its first word; cycle 1 leaves those after the first.
inline constexpr ResultDefinition singleTouchResults[] = {
    {"Qn", "measured coordinate"},
    {"Q115", "position at the touch, X"},
    {"Q116", "position at the touch, Y"},
    {"Q117", "position at the touch, Z"},
    {"Q118", "position at the touch, 4th axis", ValueKind::Angle},
    {"Q119", "position at the touch, 5th axis", ValueKind::Angle},
};

/// Sets Q115 to Q119: the position at the touch in X, Y, Z and the first two rotary axes, in the active
/// coordinate system. Stylus length and ball radius are not taken into account: it is the tool reference point's.
void storeTouchPosition(Context& context, const EvaluatedTouch& touch);

}  // namespace probewright::cycles::heidenhain
