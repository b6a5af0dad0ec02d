#pragma once

#include "cycles/heidenhain/context.hpp"

/// Where the presetting cycles 408 to 419 put what they have found.
namespace probewright::cycles::heidenhain {

/// A feature in the active program coordinate system and the coordinates that it is to get.
/// Axes without a wish keep their place.
struct NewPreset {
  PartPoint measured;
  std::array<std::optional<double>, 3> wish;
  /// Basic rotation to be set together with it, degrees added to the present one.
  std::optional<double> rotation;
};

/// Refuses, before anything is touched, a transfer that Q303 and Q305 leave nowhere to go: Q303 = -1 with a row, Q303 =
/// 0 with a row without an active datum table, a row of the preset table that is locked.
void requireTransferTarget(Context& context);

/// Refuses an angle for the datum table when none is active: "`because`" says which parameter asks for it, "`wayOut`"
/// what else the program can do.
void requireDatumTable(Context& context, std::string_view because, std::string_view wayOut);

/// Writes the preset as Q303 and Q305 say: Q305 = 0 copies the
/// active preset to row 0 and activates it, clearing simple transformations; otherwise row Q305 of the preset table
/// (effective at once if it is the active one) or of the active datum table. The feature reads the wished coordinates
/// once that row is active, whatever basic rotation the row has; a row that is new takes over the active preset.
void transferPreset(Context& context, const NewPreset& preset);

/// The end of the presetting cycles that can also set the touch probe axis: transfers `preset`; then, if Q381 = 1,
/// touches the surface at (Q382, Q383, Q384), still meant in the coordinates that were active when the cycle began, and
/// sets Q333 there.
void finishPreset(Context& context, const NewPreset& preset);

/// Writes into a row of the preset table; a row that is new takes over the rest from the active preset.
void writePresetRow(Context& context, int row, Control::PresetChange change);

/// Row 0 takes the active preset with `change` and becomes active; simple transformations are cleared.
void copyActivePresetTo0(Context& context, Control::PresetChange change);

/// Writes an angle into column A, B or C of row Q305 of the active datum table.
void writeDatumAngle(Context& context, std::size_t axis, double degrees);

/// Adds an angle to column A, B or C of a row of the active datum table.
void addDatumAngle(Context& context, std::size_t axis, int row, double degrees);

/// Takes the basic rotation of the active preset out of effect; the table keeps it.
void resetBasicRotation(Context& context);

/// The change of a preset that gives it a basic rotation by `degrees` about the tool axis and no other.
Control::PresetChange rotationChange(Context& context, double degrees);

/// Sets the basic rotation (degrees about the tool axis): row 0 stands for the active preset.
void setBasicRotation(Context& context, double degrees, int row);

}  // namespace probewright::cycles::heidenhain
