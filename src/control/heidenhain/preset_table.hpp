#pragma once

#include "control/heidenhain/typed_table.hpp"

/// The preset table PRESET.PR: where workpieces sit, in machine coordinates. Row 0 is the preset set by hand.
namespace probewright::control::heidenhain {

/// The columns of PRESET.PR on both controls. TNC 640: NO, SPA, SPB, SPC and the offset columns; iTNC 530: NR, ROT.
std::span<const ColumnSpec> presetColumns();

/// A preset table with rows 0 and 1, all zero.
TypedTable defaultPresetTable(ControlKind kind, TableUnit unit = TableUnit::Millimetre, std::size_t rows = 2);

}  // namespace probewright::control::heidenhain
