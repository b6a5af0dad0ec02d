#include "control/heidenhain/preset_table.hpp"

#include <array>

namespace probewright::control::heidenhain {

namespace {

using enum CellKind;

constexpr std::array columns = {
    ColumnSpec{"NO", "NR", 7, Integer, 0, "number of the preset", "", onTNC640},
    ColumnSpec{"NR", "NO", 7, Integer, 0, "number of the preset", "", onITNC530},
    ColumnSpec{"DOC", "", 17, Text, 0, "comment"},
    ColumnSpec{"ROT", "", 11, Angle, 4, "basic rotation", "0", onITNC530},
    ColumnSpec{"X", "", 14, Length, 4, "origin", "0"},
    ColumnSpec{"Y", "", 14, Length, 4, "origin", "0"},
    ColumnSpec{"Z", "", 14, Length, 4, "origin", "0"},
    ColumnSpec{"SPA", "", 11, Angle, 4, "spatial angle of the basic rotation about X", "0", onTNC640},
    ColumnSpec{"SPB", "", 11, Angle, 4, "spatial angle of the basic rotation about Y", "0", onTNC640},
    ColumnSpec{"SPC", "", 11, Angle, 4, "spatial angle of the basic rotation about Z", "0", onTNC640},
    ColumnSpec{"A", "", 14, Angle, 4, "zero of the rotary axis", "0"},
    ColumnSpec{"B", "", 14, Angle, 4, "zero of the rotary axis", "0"},
    ColumnSpec{"C", "", 14, Angle, 4, "zero of the rotary axis", "0"},
    ColumnSpec{"U", "", 14, Length, 4, "zero of the parallel axis", "0"},
    ColumnSpec{"V", "", 14, Length, 4, "zero of the parallel axis", "0"},
    ColumnSpec{"W", "", 14, Length, 4, "zero of the parallel axis", "0"},
    ColumnSpec{"X_OFFS", "", 14, Length, 4, "axis offset", "0", onTNC640},
    ColumnSpec{"Y_OFFS", "", 14, Length, 4, "axis offset", "0", onTNC640},
    ColumnSpec{"Z_OFFS", "", 14, Length, 4, "axis offset", "0", onTNC640},
    ColumnSpec{"A_OFFS", "", 14, Angle, 4, "axis offset", "0", onTNC640},
    ColumnSpec{"B_OFFS", "", 14, Angle, 4, "axis offset", "0", onTNC640},
    ColumnSpec{"C_OFFS", "", 14, Angle, 4, "axis offset", "0", onTNC640},
    ColumnSpec{"U_OFFS", "", 14, Length, 4, "axis offset", "0", onTNC640},
    ColumnSpec{"V_OFFS", "", 14, Length, 4, "axis offset", "0", onTNC640},
    ColumnSpec{"W_OFFS", "", 14, Length, 4, "axis offset", "0", onTNC640},
    ColumnSpec{"ACTNO", "", 7, Integer, 0, "number of the active preset, entered by the control", "", onTNC640},
    ColumnSpec{"LOCKED", "", 17, Text, 0, "any entry: the row is write-protected", "", onTNC640},
};

}  // namespace

std::span<const ColumnSpec> presetColumns() { return columns; }

TypedTable defaultPresetTable(ControlKind kind, TableUnit unit, std::size_t rows) {
  return TypedTable::create("PRESET.PR", unit, columns, kind, rows);
}

}  // namespace probewright::control::heidenhain
