#include "control/heidenhain/control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/kinematics.hpp"
#include "control/heidenhain/tool_table.hpp"

namespace probewright::control::heidenhain {
namespace {

constexpr std::array<NumberColumn, 3> linearNames = {"X", "Y", "Z"};
constexpr std::array<NumberColumn, 3> spaceAngleNames = {"SPA", "SPB", "SPC"};

void check(const Result<void>& done) {
  if (!done) throw Alarm("Table write error", done.error().message, done.error().advice);
}

/// A preset table with the one column ROT (iTNC 530) turns the working plane, whatever its axis is.
ActivePreset aboutToolAxis(ActivePreset preset, const TypedTable& presets, const WorkingPlane& plane) {
  if (presets.hasColumn("SPC") || !presets.hasColumn("ROT")) return preset;
  const double rotation = preset.spaceAngles.sum();
  preset.spaceAngles.setZero();
  preset.spaceAngles[plane.tool] = rotation;
  return preset;
}

}  // namespace

Control::Control(ControlKind kind, machine::Machine& machine, Tables tables_, MachineParameters parameters_)
    : panel(journal),
      channel(machine, journal),
      tables(std::move(tables_)),
      parameters(parameters_),
      kinematics(std::make_shared<Kinematics>(machine.description())),
      kind_(kind) {
  channel.programUnit = &unit;
  channel.onToolByHand = [this](const machine::ToolOrder& order, const std::string& detail) {
    panel.stop(askForTool(order, detail), channel.seconds());
  };
  if (presetRow(0)) activatePreset(0);
}

void Control::note(const TypedTable& table, const std::string& row, Column column, const std::string& before) {
  const std::string after = table.text(row, column);
  if (after == before) return;
  journal.write({table.table().name(), fmt::format("row {}, column {}", row, column.name()), before, after});
}

std::map<TypedTable*, TypedTable> Control::tablesWith(const std::vector<NumberCell>& cells) {
  std::map<TypedTable*, TypedTable> changed;
  for (const NumberCell& cell : cells) {
    TypedTable& table = changed.try_emplace(&cell.table, cell.table).first->second;
    check(table.setNumber(cell.row, cell.column, cell.value));
  }
  return changed;
}

void Control::requireRoomFor(const std::vector<NumberCell>& cells) const { tablesWith(cells); }

void Control::writeNumbers(const std::vector<NumberCell>& cells) {
  std::map<TypedTable*, TypedTable> changed = tablesWith(cells);
  for (auto& [table, content] : changed)
    std::swap(*table, content);
  for (const NumberCell& cell : cells)
    note(cell.table, cell.row, cell.column, changed.at(&cell.table).text(cell.row, cell.column));
}

void Control::writeNumber(TypedTable& table, const std::string& row, NumberColumn column, double value) {
  const std::string before = table.text(row, column);
  check(table.setNumber(row, column, value));
  note(table, row, column, before);
}

void Control::writeText(TypedTable& table, const std::string& row, Column column, const std::string& value) {
  const std::string before = table.text(row, column);
  check(table.setText(row, column, value));
  note(table, row, column, before);
}

namespace {

/// "it has 1 PROBE, 2, 3 MILL D12": the first of them.
std::string toolsOf(const TypedTable& tools) {
  constexpr std::size_t most = 8;
  std::string list;
  std::size_t count = 0;
  for (const std::string& row : tools.table().keys()) {
    if (row == "0") continue;
    if (++count > most) return list + " ...";
    const std::string name = tools.text(row, "NAME");
    list += (list.empty() ? "it has " : ", ") + row + (name.empty() ? "" : " " + name);
  }
  return list.empty() ? "it has none" : list;
}

}  // namespace

std::string Control::toolRowNamed(const std::string& name) const {
  if (const auto row = findToolNamed(tables.tools, name)) return *row;
  if (name.empty()) {
    throw Alarm("Tool not defined", "The name of the tool is empty", "give the QS parameter its text before");
  }
  throw Alarm("Tool not defined", fmt::format("TOOL.T has no tool named {}", name),
              "add the tool or correct its name; " + toolsOf(tables.tools));
}

std::string Control::usableTool(const std::string& called) {
  std::string row = called;
  for (std::vector<std::string> locked; tables.tools.text(row, "TL") == "L";) {
    locked.push_back(row);
    const std::string replacement = tables.tools.text(row, "RT");
    if (replacement.empty() || replacement == "0") {
      throw Alarm("Tool locked",
                  fmt::format("Tool {} is locked in TOOL.T (column TL) and has no replacement tool (RT)", row),
                  "release the tool, call another one, or enter its replacement in column RT");
    }
    if (!tables.tools.hasRow(replacement)) {
      throw Alarm("Replacement tool not defined",
                  fmt::format("Tool {} is locked; TOOL.T has no tool {}, its replacement (RT)", row, replacement),
                  "add the tool or correct RT; " + toolsOf(tables.tools));
    }
    if (std::ranges::find(locked, replacement) != locked.end()) {
      throw Alarm("Tool locked", fmt::format("Tool {} and all of its replacement tools (RT) are locked", called),
                  "release one of them");
    }
    row = replacement;
  }
  if (row != called) {
    panel.message(EventKind::Warning, fmt::format("Tool {} is locked; tool {} replaces it (column RT)", called, row),
                  channel.seconds());
  }
  return row;
}

void Control::callTool(const std::string& called, std::optional<char> axis, double deltaLength, double deltaRadius,
                       double deltaRadius2) {
  if (called != "0" && !tables.tools.hasRow(called)) {
    throw Alarm("Tool not defined", fmt::format("TOOL.T has no tool {}", called),
                "add the tool or correct its number; " + toolsOf(tables.tools));
  }
  const std::string row = usableTool(called);
  ActiveTool next = tool;
  next.row = row;
  next.called = true;
  const std::size_t point = row.find('.');
  next.number = static_cast<int>(parseInteger(row.substr(0, point)).value_or(0));
  next.index = point == std::string::npos ? 0 : static_cast<int>(parseInteger(row.substr(point + 1)).value_or(0));
  next.name = tables.tools.text(row, "NAME");
  if (axis) next.axis = *axis;
  next.deltaLength = deltaLength;
  next.deltaRadius = deltaRadius;
  next.deltaRadius2 = deltaRadius2;
  const std::string probe = tables.tools.text(row, "TP_NO");
  next.probeRow = probe == "0" || probe == "-" ? "" : probe;
  if (!tool.called || next.row != tool.row) {
    const bool byHand = !isTNC640() && row == "0" && axis && handProbe.number != 0;
    // Tool 0 is an empty spindle, whatever its row is named.
    channel.changeTool(byHand ? handProbe : machine::ToolOrder{next.number, next.number == 0 ? "" : next.name});
    panel.message(EventKind::Tool,
                  byHand ? fmt::format("Tool 0: touch probe {} put in by hand, axis {}", handProbe.name, next.axis)
                         : fmt::format("Tool {}{}{}", row, next.name.empty() ? "" : " ", next.name),
                  channel.seconds());
  }
  tool = std::move(next);
  refreshTool();
  meetProbe();
}

void Control::meetProbe() {
  channel.alarms.collision = "Collision";
  if (!isTNC640() || tool.probeRow.empty() || !tables.probes.hasRow(tool.probeRow)) return;
  const std::string serial = channel.machine().probeSerial();
  if (!serial.empty() && tables.probes.hasColumn("SERIAL")) {
    writeText(tables.probes, tool.probeRow, "SERIAL", serial);
  }
  if (tables.probes.text(tool.probeRow, "REACTION") == "EMERGSTOP") channel.alarms.collision = "Emergency stop";
}

void Control::refreshTool() {
  const auto cell = [&](NumberColumn column) { return tables.tools.numberOr(tool.row, column, 0); };
  const bool calibrated = probing_ && !keepsCalibrationInTable();
  tool.length = calibrated ? parameters.calibratedLength : cell("L") + cell("DL");
  tool.radius = calibrated ? parameters.calibratedRadius : cell("R") + cell("DR");
  tool.radius2 = cell("R2") + cell("DR2");
  coordinates.plane = WorkingPlane::ofToolAxis(tool.axis);
  coordinates.preset = aboutToolAxis(coordinates.preset, tables.presets, coordinates.plane);
  channel.toolVector = Vector3::Zero();
  channel.toolVector[coordinates.plane.tool] = tool.length + (calibrated ? 0 : tool.deltaLength);
  channel.toolRadius = tool.radius + (calibrated ? 0 : tool.deltaRadius);
}

void Control::setProbing(bool probing) {
  if (probing_ == probing || keepsCalibrationInTable()) return;
  probing_ = probing;
  refreshTool();
}

void Control::writeCalibration(double MachineParameters::*member, const std::string& name, double value) {
  const std::string before = formatFixed(parameters.*member, 4);
  parameters.*member = value;
  const std::string after = formatFixed(value, 4);
  if (after != before) journal.write({"calibration data", name, before, after});
}

std::optional<ActivePreset> Control::presetRow(int row) const {
  const auto exact = exactPresets_.find(row);
  if (exact != exactPresets_.end()) return aboutToolAxis(exact->second, tables.presets, coordinates.plane);
  const std::string key = std::to_string(row);
  const TypedTable& table = tables.presets;
  if (!table.hasRow(key)) return std::nullopt;
  ActivePreset preset;
  preset.row = row;
  for (std::size_t i = 0; i < 3; ++i) {
    preset.origin[static_cast<Eigen::Index>(i)] = table.numberOr(key, linearNames[i], 0);
    if (table.hasColumn(spaceAngleNames[i])) {
      preset.spaceAngles[static_cast<Eigen::Index>(i)] = table.numberOr(key, spaceAngleNames[i], 0);
    }
  }
  if (table.hasColumn("ROT")) preset.spaceAngles[coordinates.plane.tool] = table.numberOr(key, "ROT", 0);
  const machine::MachineDescription& description = channel.description();
  for (std::size_t i = 0; i < description.axes.size(); ++i) {
    const machine::Axis& axis = description.axes[i];
    if (axis.kind != machine::AxisKind::Rotary) continue;
    const NumberColumn position = NumberColumn::named(axis.name);
    if (table.hasColumn(position)) preset.rotaryOffset[i] = table.numberOr(key, position, 0);
    const std::string offsetName = axis.name + "_OFFS";
    const NumberColumn offset = NumberColumn::named(offsetName);
    if (table.hasColumn(offset)) preset.rotaryOffset[i] += table.numberOr(key, offset, 0);
  }
  return preset;
}

void Control::activatePreset(int row) {
  const std::optional<ActivePreset> preset = presetRow(row);
  if (!preset) {
    throw Alarm("Preset not defined", fmt::format("The preset table has no row {}", row),
                "add the row or correct the number");
  }
  coordinates.preset = *preset;
  applyCoordinates();
}

void Control::requireWritablePreset(int row) const {
  const std::string key = std::to_string(row);
  if (tables.presets.hasRow(key) && !tables.presets.text(key, "LOCKED").empty()) {
    throw Alarm("Preset locked", fmt::format("Row {} of the preset table is write-protected", row),
                "unlock the row or use another");
  }
}

void Control::writePreset(int row, const PresetChange& change) {
  requireWritablePreset(row);
  const std::string key = std::to_string(row);
  ActivePreset preset = presetRow(row).value_or(ActivePreset{});
  preset.row = row;
  // What is refused has written nothing, not even the row.
  TypedTable changed = tables.presets;
  check(changed.ensureRow(key));
  std::vector<std::string> columns;
  const auto set = [&](NumberColumn column, double value) {
    check(changed.setNumber(key, column, value));
    columns.emplace_back(column.name());
  };
  const auto toolAxis = static_cast<std::size_t>(coordinates.plane.tool);
  for (std::size_t i = 0; i < 3; ++i) {
    if (change.origin[i]) {
      preset.origin[static_cast<Eigen::Index>(i)] = *change.origin[i];
      set(linearNames[i], *change.origin[i]);
    }
    if (change.spaceAngles[i]) {
      preset.spaceAngles[static_cast<Eigen::Index>(i)] = *change.spaceAngles[i];
      if (changed.hasColumn(spaceAngleNames[i])) {
        set(spaceAngleNames[i], *change.spaceAngles[i]);
      } else if (i == toolAxis && changed.hasColumn("ROT")) {
        set("ROT", *change.spaceAngles[i]);
      } else {
        throw Alarm("Table write error", fmt::format("The preset table has no column {}", spaceAngleNames[i].name()));
      }
    }
  }
  const machine::MachineDescription& description = channel.description();
  for (std::size_t i = 0; i < description.axes.size(); ++i) {
    if (!change.rotaryOffset[i]) continue;
    preset.rotaryOffset[i] = *change.rotaryOffset[i];
    const std::string offsetName = description.axes[i].name + "_OFFS";
    const NumberColumn position = NumberColumn::named(description.axes[i].name);
    const NumberColumn offset = NumberColumn::named(offsetName);
    const bool hasOffset = changed.hasColumn(offset);
    double written = *change.rotaryOffset[i];
    if (hasOffset && changed.hasColumn(position)) written -= changed.numberOr(key, position, 0);
    set(hasOffset ? offset : position, written);
  }
  std::swap(tables.presets, changed);
  for (const std::string& column : columns)
    note(tables.presets, key, Column::named(column), changed.text(key, Column::named(column)));
  exactPresets_[row] = preset;
  if (row == coordinates.preset.row) {
    coordinates.preset = preset;
    applyCoordinates();
  }
}

void Control::applyKinematics() {
  channel.setDescription(kinematics->description());
  const Vector3 base = kinematics->data().base;
  channel.tipDeviation = nullptr;
  if (kinematics->grid) {
    channel.tipDeviation = [base, grid = *kinematics->grid](const machine::AxisPositions& axes) {
      return Vector3(base + grid.at(axes));
    };
  } else if (!base.isZero(0)) {
    channel.tipDeviation = [base](const machine::AxisPositions&) { return Vector3(base); };
  }
  applyCoordinates();
}

void Control::applyCoordinates() {
  channel.rotaryOffset = coordinates.axisOffset();
  const bool follows = coordinates.tilt.has_value() || channel.holdTip || coordinates.tiltedAxesInPosition;
  channel.setFollowing(follows ? Following::Kinematics : Following::LinearAxes, coordinates.preset.rotaryOffset);
  channel.setFrame(coordinates.machineFromProgram());
}

}  // namespace probewright::control::heidenhain
