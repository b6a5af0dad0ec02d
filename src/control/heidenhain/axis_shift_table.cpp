#include "control/heidenhain/axis_shift_table.hpp"

#include <array>

namespace probewright::control::heidenhain {

namespace {

using enum CellKind;

constexpr std::array columns = {
    ColumnSpec{"NR", "", 5, Integer, 0, "traverse range"},
    ColumnSpec{"TOOL", "", 8, Text, 0, "the tool that calibrated"},
    ColumnSpec{"DIRECTION", "", 11, Integer, 0, "probing directions, Q364"},
    ColumnSpec{"X", "", 16, Length, 6, "tool tip at the signal, machine coordinates; empty: not probed"},
    ColumnSpec{"Y", "", 16, Length, 6, ""},
    ColumnSpec{"Z", "", 16, Length, 6, ""},
};

}  // namespace

std::span<const ColumnSpec> axisShiftColumns() { return columns; }

TypedTable defaultAxisShiftTable() {
  return TypedTable::create("AXSHIFT.TAB", TableUnit::Millimetre, columns, ControlKind::iTNC530, 0);
}

}  // namespace probewright::control::heidenhain
