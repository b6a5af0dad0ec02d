#pragma once

#include "cycles/heidenhain/context.hpp"

/// What cycles 401 to 405 have in common: a rotary axis turns the workpiece until it is aligned.
namespace probewright::cycles::heidenhain {

/// Turns the workpiece by `degrees` counter-clockwise about machine axis 0, 1 or 2 (X, Y, Z), seen in machine
/// coordinates, with the rotary axis of the table that does so (A, B, C), at the positioning feed. Returns the axis.
/// Throws Alarm if the machine has none.
std::size_t turnWorkpiece(Context& context, int about, double degrees);

/// Sets the angle of the rotary axis to zero where it stands: in the preset table or the active datum table as Q303
/// says; in row Q305 if `rowGiven` (row 0 takes over the active preset and becomes active), else in the active row.
void zeroRotaryAxis(Context& context, std::size_t axis, bool rowGiven);

/// The same in the preset table only: in row Q305 if `rowGiven` (row 0 takes over the active preset and becomes
/// active), else in the active row.
void zeroRotaryAxisInPreset(Context& context, std::size_t axis, bool rowGiven);

}  // namespace probewright::cycles::heidenhain
