#include "session/heidenhain/own_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "session/own_control.hpp"

namespace probewright::session::heidenhain {

namespace hh = control::heidenhain;
using machine::OwnOffset;
using machine::OwnTables;
using machine::OwnTool;

namespace {

/// The column of an axis in the preset table; nothing if it has none.
std::optional<hh::NumberColumn> columnOf(const hh::TypedTable& presets, const machine::Axis& axis) {
  static constexpr std::array<hh::NumberColumn, 3> linear = {"X", "Y", "Z"};
  static constexpr std::array<hh::NumberColumn, 6> rotary = {"A_OFFS", "B_OFFS", "C_OFFS", "A", "B", "C"};
  for (const hh::NumberColumn column : linear)
    if (axis.name == column.name()) return column;
  if (axis.kind != machine::AxisKind::Rotary) return std::nullopt;
  for (const hh::NumberColumn column : rotary)
    if (column.name().substr(0, 1) == axis.name && presets.hasColumn(column)) return column;
  return std::nullopt;
}

hh::NumberColumn rotationColumn(const hh::TypedTable& presets) {
  return presets.hasColumn("SPC") ? hh::NumberColumn("SPC") : hh::NumberColumn("ROT");
}

bool isTilted(const hh::TypedTable& presets, const std::string& row) {
  return presets.numberOr(row, "SPA", 0) != 0 || presets.numberOr(row, "SPB", 0) != 0;
}

/// The row as the machine's own control would have it; `offset` tells what is not in the table.
OwnOffset offsetOf(const hh::TypedTable& presets, const std::string& row, OwnOffset offset,
                   const machine::MachineDescription& machine) {
  for (std::size_t i = 0; i < machine.axes.size(); ++i)
    if (const auto column = columnOf(presets, machine.axes[i])) offset.origin[i] = presets.numberOr(row, *column, 0);
  offset.rotation = presets.numberOr(row, rotationColumn(presets), 0);
  return offset;
}

bool isProbe(const hh::TypedTable& tools, const std::string& row) {
  return tools.text(row, "TYP") == "TCHP" || tools.number(row, "TP_NO").value_or(0) > 0;
}

OwnTool toolOf(const hh::TypedTable& tools, const std::string& row, OwnTool tool) {
  tool.length = tools.numberOr(row, "L", 0) + tools.numberOr(row, "DL", 0);
  if (!isProbe(tools, row)) tool.diameter = 2 * (tools.numberOr(row, "R", 0) + tools.numberOr(row, "DR", 0));
  return tool;
}

bool differ(double a, double b) { return !(std::abs(a - b) <= sameNumber); }

}  // namespace

std::vector<std::string> takeOver(hh::Tables& tables, const OwnTables& own,
                                  const machine::MachineDescription& machine) {
  std::vector<std::string> notes;
  hh::TypedTable& presets = tables.presets;
  for (const OwnOffset& offset : own.offsets) {
    const std::string row = std::to_string(offset.number);
    if (isUnset(offset) || isTilted(presets, row)) continue;
    if (same(offsetOf(presets, row, offset, machine), offset, machine.axes.size()) && presets.hasRow(row)) continue;
    bool set = true;
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
      const auto column = columnOf(presets, machine.axes[i]);
      if (column) set = set && presets.setNumber(row, *column, offset.origin[i]).has_value();
    }
    for (const hh::NumberColumn column : {hh::NumberColumn("SPC"), hh::NumberColumn("ROT")})
      if (presets.hasColumn(column)) set = set && presets.setNumber(row, column, offset.rotation).has_value();
    notes.push_back(
        set ? takenOver("preset " + row, offset, machine)
            : fmt::format("preset {} has no room for what the machine has as {}", row, ownOffsetName(offset.number)));
  }
  for (const OwnTool& tool : own.tools) {
    const std::string row = std::to_string(tool.number);
    if (!tables.tools.hasRow(row)) continue;
    const OwnTool known = toolOf(tables.tools, row, tool);
    const auto take = [&](double value, double before, double wear, hh::NumberColumn column, const char* what) {
      if (value == 0 || !differ(value, before)) return;
      const bool set = tables.tools.setNumber(row, column, value - wear).has_value();
      notes.push_back(fmt::format("the {} of tool {} is {}: {:.4f}", what, row,
                                  set ? "that of the machine's tool table" : "too large for the tool table", value));
    };
    take(tool.length, known.length, tables.tools.numberOr(row, "DL", 0), "L", "length");
    take(tool.diameter / 2, known.diameter / 2, tables.tools.numberOr(row, "DR", 0), "R", "radius");
  }
  return notes;
}

OwnTables differing(const hh::Tables& tables, const OwnTables& own, const machine::MachineDescription& machine) {
  OwnTables changed;
  for (const OwnOffset& offset : own.offsets) {
    const std::string row = std::to_string(offset.number);
    if (!tables.presets.hasRow(row) || isTilted(tables.presets, row)) continue;
    const OwnOffset now = offsetOf(tables.presets, row, offset, machine);
    if (!same(now, offset, machine.axes.size())) changed.offsets.push_back(now);
  }
  for (const OwnTool& tool : own.tools) {
    const std::string row = std::to_string(tool.number);
    if (!tables.tools.hasRow(row)) continue;
    const OwnTool now = toolOf(tables.tools, row, tool);
    if (differ(now.length, tool.length) || differ(now.diameter, tool.diameter)) changed.tools.push_back(now);
  }
  return changed;
}

}  // namespace probewright::session::heidenhain
