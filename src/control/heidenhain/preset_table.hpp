#pragma once

#include <array>

#include "control/heidenhain/typed_table.hpp"
#include "geometry/primitives.hpp"

/// The preset table PRESET.PR: where workpieces sit, in machine coordinates. Row 0 is the preset set by hand.
namespace probewright::control::heidenhain {

/// The columns of PRESET.PR on both controls. TNC 640: NO, SPA, SPB, SPC and the offset columns; iTNC 530: NR, ROT.
std::span<const ColumnSpec> presetColumns();

/// A row of PRESET.PR; mm and degrees; entries that the table doesn't have are 0.
struct Preset {
  Vector3 origin = Vector3::Zero();     ///< X, Y, Z
  Vector3 rotation = Vector3::Zero();   ///< SPA, SPB, SPC; on the iTNC 530 (0, 0, ROT)
  std::array<double, 3> rotary = {};    ///< A, B, C
  std::array<double, 3> parallel = {};  ///< U, V, W
  std::array<double, 9> offsets = {};   ///< X_OFFS, Y_OFFS, Z_OFFS, A_OFFS, ..., W_OFFS
  std::string comment;                  ///< DOC
  bool locked = false;                  ///< LOCKED has an entry
};

/// A preset table with rows 0 and 1, all zero.
TypedTable defaultPresetTable(ControlKind kind, TableUnit unit = TableUnit::Millimetre, std::size_t rows = 2);

std::optional<Preset> findPreset(const TypedTable& table, int number);

/// Writes the numbers of `preset` that the table has a column for; a cell whose text would not change stays as it is.
/// Adds the row if it is missing; DOC and LOCKED stay.
Result<void> setPreset(TypedTable& table, int number, const Preset& preset);

}  // namespace probewright::control::heidenhain
