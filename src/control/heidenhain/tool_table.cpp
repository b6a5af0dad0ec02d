#include "control/heidenhain/tool_table.hpp"

#include <fmt/format.h>

#include <array>

namespace probewright::control::heidenhain {

namespace {

using enum CellKind;

// name, other name, width, kind, decimals, meaning, entry of a new row, controls
constexpr std::array columns = {
    ColumnSpec{"T", "", 8, Number, 0, "tool number, with its step after a point"},
    ColumnSpec{"NAME", "", 33, Text, 0, "tool name"},
    ColumnSpec{"L", "", 13, Length, 4, "tool length", "0"},
    ColumnSpec{"R", "", 13, Length, 4, "tool radius", "0"},
    ColumnSpec{"R2", "", 13, Length, 4, "corner radius", "0"},
    ColumnSpec{"DL", "", 10, Length, 4, "delta value of the length", "0"},
    ColumnSpec{"DR", "", 10, Length, 4, "delta value of the radius", "0"},
    ColumnSpec{"DR2", "", 10, Length, 4, "delta value of the corner radius", "0"},
    ColumnSpec{"TL", "", 4, Text, 0, "L: the tool is locked"},
    ColumnSpec{"RT", "", 8, Text, 0, "replacement tool"},
    ColumnSpec{"TIME1", "", 7, Number, 0, "maximum tool life, minutes"},
    ColumnSpec{"TIME2", "", 7, Number, 0, "maximum tool life at a tool call, minutes"},
    ColumnSpec{"CUR.TIME", "CUR_TIME", 10, Number, 2, "current tool life, minutes"},
    ColumnSpec{"TYP", "", 10, Text, 0, "type of the tool; TCHP is a touch probe", "", onTNC640},
    ColumnSpec{"DOC", "", 17, Text, 0, "comment"},
    ColumnSpec{"PLC", "", 10, Text, 0, "information for the PLC"},
    ColumnSpec{"LCUTS", "", 12, Length, 4, "cutting edge length"},
    ColumnSpec{"ANGLE", "", 9, Angle, 3, "maximum plunge angle"},
    ColumnSpec{"CUT", "CUT.", 5, Integer, 0, "number of teeth"},
    ColumnSpec{"LTOL", "", 8, Length, 4, "wear tolerance of the length; 0 is none"},
    ColumnSpec{"RTOL", "", 8, Length, 4, "wear tolerance of the radius; 0 is none"},
    ColumnSpec{"DIRECT", "DIRECT.", 8, Text, 0, "cutting direction when measured rotating: - is M3, + is M4", "",
               onBothTNC, "-+"},
    ColumnSpec{"R-OFFS", "TT:R-OFFS", 12, Length, 4, "radial offset in tool measurement; empty is the radius"},
    ColumnSpec{"L-OFFS", "TT:L-OFFS", 12, Length, 4, "axial offset in tool measurement"},
    ColumnSpec{"LBREAK", "", 8, Length, 4, "breakage tolerance of the length; 0 is none"},
    ColumnSpec{"RBREAK", "", 8, Length, 4, "breakage tolerance of the radius; 0 is none"},
    ColumnSpec{"NMAX", "", 8, Integer, 0, "maximum spindle speed"},
    ColumnSpec{"LIFTOFF", "", 8, Text, 0, "Y: lifts off at an NC stop"},
    ColumnSpec{"TP_NO", "", 6, Integer, 0, "row of the touch probe table", "", onTNC640},
    ColumnSpec{"DR2TABLE", "", 34, Text, 0, "table of the 3-D calibration of a touch probe, *.3DTC", "", onTNC640},
    ColumnSpec{"T-ANGLE", "", 9, Angle, 3, "point angle"},
    ColumnSpec{"CAL-OF1", "CAL_OF1", 12, Length, 4, "centre offset of the ball, main axis", "", onITNC530},
    ColumnSpec{"CAL-OF2", "CAL_OF2", 12, Length, 4, "centre offset of the ball, minor axis", "", onITNC530},
    ColumnSpec{"CAL-ANG", "CAL_ANG", 10, Angle, 4, "spindle angle of the calibration", "", onITNC530},
};

}  // namespace

std::span<const ColumnSpec> toolColumns() { return columns; }

TypedTable defaultToolTable(ControlKind kind, TableUnit unit) {
  return TypedTable::create("TOOL.T", unit, columns, kind, 1);
}

std::optional<std::string> findToolNamed(const TypedTable& table, std::string_view name) {
  if (name.empty()) return std::nullopt;  // tools without a name have none to be found by
  for (const std::string& key : table.table().keys()) {
    if (table.text(key, "NAME") == name) return key;
  }
  return std::nullopt;
}

std::string toolKey(int number, int step) {
  return step == 0 ? fmt::format("{}", number) : fmt::format("{}.{}", number, step);
}

}  // namespace probewright::control::heidenhain
