#include "control/heidenhain/probe_table.hpp"

#include <array>

namespace probewright::control::heidenhain {

namespace {

using enum CellKind;

constexpr std::array columns = {
    ColumnSpec{"NO", "NR", 5, Integer, 0, "number of the touch probe; TP_NO of the tool table names it"},
    ColumnSpec{"TYPE", "", 12, Text, 0, "model of the touch probe", "TS460"},
    ColumnSpec{"CAL_OF1", "", 12, Length, 4, "ball centre from the spindle axis, main axis", "0"},
    ColumnSpec{"CAL_OF2", "", 12, Length, 4, "ball centre from the spindle axis, minor axis", "0"},
    ColumnSpec{"CAL_ANG", "", 10, Angle, 4, "spindle angle when calibrating and probing", "0"},
    ColumnSpec{"F", "", 9, Feed, 0, "probing feed", "300"},
    ColumnSpec{"FMAX", "", 9, Feed, 0, "feed of positioning between points", "2000"},
    ColumnSpec{"DIST", "", 12, Length, 4, "longest path to the touch point", "10"},
    ColumnSpec{"SET_UP", "", 12, Length, 4, "set-up clearance, added to that of the cycle", "2"},
    ColumnSpec{"F_PREPOS", "", 14, Text, 0, "FMAX_PROBE or FMAX_MACHINE", "FMAX_PROBE"},
    ColumnSpec{"TRACK", "", 7, Text, 0, "ON: orient the spindle to the probing direction", "OFF"},
    ColumnSpec{"SERIAL", "", 16, Text, 0, "serial number, entered by the control"},
    ColumnSpec{"REACTION", "", 12, Text, 0, "NCSTOP or EMERGSTOP on a collision", "NCSTOP"},
    ColumnSpec{"STYLUS", "", 12, Text, 0, "shape of the stylus", "SIMPLE", onTNC640},
};

}  // namespace

std::span<const ColumnSpec> probeColumns() { return columns; }

TypedTable defaultProbeTable(ControlKind kind, TableUnit unit) {
  TypedTable table = TypedTable::create("TCHPROBE.TP", unit, columns, kind, 2);
  return table;
}

std::optional<TouchProbe> findProbe(const TypedTable& table, int number) {
  const std::string row = std::to_string(number);
  if (!table.hasRow(row)) return std::nullopt;
  TouchProbe probe;
  probe.type = table.text(row, "TYPE");
  probe.centreOffset1 = table.numberOr(row, "CAL_OF1", probe.centreOffset1);
  probe.centreOffset2 = table.numberOr(row, "CAL_OF2", probe.centreOffset2);
  probe.calibrationAngle = table.numberOr(row, "CAL_ANG", probe.calibrationAngle);
  probe.feed = table.numberOr(row, "F", probe.feed);
  probe.rapid = table.numberOr(row, "FMAX", probe.rapid);
  probe.maximumTravel = table.numberOr(row, "DIST", probe.maximumTravel);
  probe.setUpClearance = table.numberOr(row, "SET_UP", probe.setUpClearance);
  probe.prepositionAtMachineRapid = table.text(row, "F_PREPOS") == "FMAX_MACHINE";
  probe.track = table.text(row, "TRACK") == "ON";
  probe.serial = table.text(row, "SERIAL");
  probe.stylus = table.text(row, "STYLUS");
  return probe;
}

}  // namespace probewright::control::heidenhain
