#pragma once

#include "cycles/heidenhain/context.hpp"

/// What cycles 401 to 405 have in common: a rotary axis turns the workpiece until it is aligned.
namespace probewright::cycles::heidenhain {

/// The rotary axis of the table that turns the workpiece about machine axis 0, 1 or 2 (X, Y, Z). Throws Alarm if the
/// machine has none.
std::size_t requireTable(Context& context, int about);

/// Turns the workpiece with it by `degrees` counter-clockwise, seen in machine coordinates, at the positioning feed.
/// Returns the axis.
std::size_t turnWorkpiece(Context& context, int about, double degrees);

/// About which machine axis (0, 1, 2: X, Y, Z) the rotary axis of the table turns that is nearest to the workpiece.
/// Throws Alarm if there is none, or if it stands askew.
int firstTableTurn(Context& context);

/// What 401 and 402 enter for the rotary axis that has turned by `turned` degrees, as Q337 says. The TNC 640 sets its
/// angle to zero in row Q305, or gives the active preset the offset that leaves the angle shown what it was; the
/// iTNC 530 sets it to zero in the active preset, or enters nothing.
void enterAlignment(Context& context, std::size_t axis, double turned);

/// Which row of the preset table takes an angle: that of Q305, where row 0 takes over the active preset and becomes
/// active, or the active one.
enum class PresetRow { OfQ305, Active };

/// Sets the angle of the rotary axis to zero where it stands: in the preset table or the active datum table as Q303
/// says.
void zeroRotaryAxis(Context& context, std::size_t axis, PresetRow row);

/// The same in the preset table only.
void zeroRotaryAxisInPreset(Context& context, std::size_t axis, PresetRow row);

}  // namespace probewright::cycles::heidenhain
