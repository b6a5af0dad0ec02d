#include "control/heidenhain/turning_tool_table.hpp"

#include <array>

namespace probewright::control::heidenhain {

namespace {

using enum CellKind;

constexpr std::array columns = {
    ColumnSpec{"T", "", 8, Number, 0, "tool number, as in TOOL.T"},
    ColumnSpec{"NAME", "", 33, Text, 0, "tool name"},
    ColumnSpec{"ZL", "", 13, Length, 4, "tool length in Z", "0"},
    ColumnSpec{"XL", "", 13, Length, 4, "tool length in X", "0"},
    ColumnSpec{"YL", "", 13, Length, 4, "tool length in Y", "0"},
    ColumnSpec{"DZL", "", 10, Length, 4, "delta value of the length in Z", "0"},
    ColumnSpec{"DXL", "", 10, Length, 4, "delta value of the length in X", "0"},
    ColumnSpec{"DYL", "", 10, Length, 4, "delta value of the length in Y", "0"},
    ColumnSpec{"RS", "", 10, Length, 4, "cutting edge radius", "0"},
    ColumnSpec{"DRS", "", 10, Length, 4, "delta value of the cutting edge radius", "0"},
    ColumnSpec{"TO", "", 5, Integer, 0, "orientation of the cutting edge, 1 to 9", "1"},
    ColumnSpec{"ORI", "", 9, Angle, 3, "spindle angle when turning", "0"},
    ColumnSpec{"SPB-INSERT", "", 12, Angle, 3, "angle of the insert about the tool", "0"},
    ColumnSpec{"TYPE", "", 12, Text, 0, "ROUGH, FINISH, THREAD, RECESS, BUTTON, RECTURN", "ROUGH"},
    ColumnSpec{"TL", "", 4, Text, 0, "L: the tool is locked"},
};

}  // namespace

std::span<const ColumnSpec> turningToolColumns() { return columns; }

TypedTable defaultTurningToolTable(TableUnit unit) {
  return TypedTable::create("TOOLTURN.TRN", unit, columns, ControlKind::TNC640, 0);
}

}  // namespace probewright::control::heidenhain
