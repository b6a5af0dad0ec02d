#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "execution/klartext/tools.hpp"

namespace probewright::execution::klartext {

void Tools::callTool(const ToolCall& call, Evaluation& evaluation) {
  control::heidenhain::ActiveTool& active = control_.tool;
  const bool names = call.number.present() || call.name.present();
  const auto delta = [&](const Operand& operand, double unchanged) {
    if (operand.present()) return run_.length(operand, evaluation);
    return names ? 0.0 : unchanged;
  };
  std::string row = active.row.empty() ? std::string("0") : active.row;
  if (call.name.present()) {
    row = control_.toolRowNamed(evaluation.text(call.name));
  } else if (call.number.present()) {
    const double number = evaluation.number(call.number);
    double index = evaluation.numberOr(call.index, 0);
    // A tool that a parameter names carries its index after the point.
    if (!call.index.present()) index = std::round((number - std::floor(number)) * 10);
    row = control::heidenhain::toolKey(truncated(std::floor(number)), static_cast<int>(index));
  }
  const double deltaLength = delta(call.deltaLength, active.deltaLength);
  const double deltaRadius = delta(call.deltaRadius, active.deltaRadius);
  const double deltaRadius2 = delta(call.deltaRadius2, active.deltaRadius2);
  if (names || call.axis != 0 || call.deltaLength.present() || call.deltaRadius.present() ||
      call.deltaRadius2.present()) {
    control_.callTool(row, call.axis == 0 ? std::nullopt : std::optional<char>(call.axis), deltaLength, deltaRadius,
                      deltaRadius2);
    guidance_.placeControlledPoint();
    control_.applyCoordinates();
  }
  if (call.spindleSpeed.present()) {
    const double speed = evaluation.number(call.spindleSpeed);
    if (!(speed >= 0)) {
      throw control::Alarm("Spindle speed wrong", fmt::format("A spindle speed of {} is not possible", speed),
                           "program S of 0 or more; M4 turns the other way");
    }
    control_.tool.spindleSpeed = speed;
    const machine::Rotation rotation = control_.channel.spindleRotation();
    if (rotation != machine::Rotation::None) control_.channel.turnSpindle(rotation, speed);
  }
  if (call.cuttingSpeed.present()) run_.leaveOut("The cutting speed VC of TOOL CALL");
  if (call.feed.present()) control_.tool.feed = run_.feed(call.feed, evaluation);
  publishTool();
}

/// TOOL DEF names the tool that comes next. The dimensions that older programs give it are those of TOOL.T here.
void Tools::defineTool(const Command& command, Evaluation& evaluation) {
  const Word* named = find(command.words, "T", evaluation);
  const Value tool = evaluation.value(named->value);
  std::string row;
  if (isText(tool)) {
    row = control_.toolRowNamed(std::get<std::string>(tool));
  } else {
    const double number = std::get<double>(tool);
    prepared_ = std::floor(number);
    row = control::heidenhain::toolKey(truncated(std::floor(number)),
                                       static_cast<int>(std::round((number - std::floor(number)) * 10)));
  }
  const auto& tools = control_.tables.tools;
  using control::heidenhain::NumberColumn;
  for (const NumberColumn column : {NumberColumn("L"), NumberColumn("R")}) {
    const Word* given = find(command.words, column.name(), evaluation);
    if (given == nullptr) continue;
    const double value = run_.length(given->value, evaluation);
    constexpr double shown = 1e-4;  // the digits of the table
    if (tools.hasRow(row) && std::abs(tools.numberOr(row, column, 0) - value) <= shown) continue;
    run_.leaveOut("TOOL DEF with a length or radius other than that in TOOL.T");
  }
}

void Tools::refresh() {
  control_.refreshTool();
  guidance_.placeControlledPoint();
}

double Tools::teeth() const { return std::max(control_.tables.tools.numberOr(control_.tool.row, "CUT", 1), 1.0); }

/// Q108 tool radius, Q109 tool axis, Q110 spindle, Q113 unit of the main program, Q114 tool length.
void Tools::publishTool() {
  const control::heidenhain::ActiveTool& tool = control_.tool;
  control_.q.setQ(108, (tool.radius + tool.deltaRadius) / control_.unit);
  const std::size_t axis = std::string_view("XYZ???UVW").find(tool.axis);
  control_.q.setQ(109, !tool.called || axis == std::string_view::npos ? -1 : static_cast<double>(axis));
  control_.q.setQ(110, spindle_.state());
  control_.q.setQ(113, control_.mainUnit == 1 ? 0 : 1);
  control_.q.setQ(114, (tool.length + tool.deltaLength) / control_.unit);
}

}  // namespace probewright::execution::klartext
