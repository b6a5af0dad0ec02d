#include "cycles/heidenhain/tool_monitoring.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/tool_table.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::heidenhain::NumberColumn;

std::string monitoredToolRow(Context& context) {
  const Argument& argument = context.arguments().at(330);
  auto& control = context.control();
  if (argument.isText) return argument.text.empty() ? "" : control.toolRowNamed(argument.text);
  if (argument.number == 0) return "";
  const double number = std::floor(argument.number);
  const int index = static_cast<int>(std::lround((argument.number - number) * 10));
  const std::string row = control::heidenhain::toolKey(truncated(number), index);
  if (!control.tables.tools.hasRow(row)) {
    throw Alarm("Tool not defined", fmt::format("Q330 names tool {}, which TOOL.T does not have", row),
                "correct Q330 or add the tool");
  }
  return row;
}

namespace {

bool isTurningTool(Context& context, const std::string& row) {
  auto& control = context.control();
  return control.isTNC640() && control.tables.tools.text(row, "TYP") == "TURN";
}

}  // namespace

void requireMonitoredTool(Context& context) {
  const std::string row = monitoredToolRow(context);
  if (row.empty() || !isTurningTool(context, row)) return;
  if (context.arguments().definition().parameter(498) == nullptr) {
    throw Alarm(
        "Tool type not permitted",
        fmt::format("Tool {} is a turning tool; cycle {} monitors mills and drills", row, context.record().name),
        "use cycle 421, 422 or 427, or set Q330 = 0");
  }
  if (!context.given(498) || !context.given(531)) {
    throw Alarm("Cycle parameter wrong", fmt::format("Tool {} is a turning tool, but Q498 or Q531 is missing", row),
                "enter how the tool stood when it turned the workpiece");
  }
  const auto& table = context.control().tables.turningTools;
  if (!table || !table->hasRow(row)) {
    throw Alarm("Tool not defined", fmt::format("TOOLTURN.TRN has no tool {}, which Q330 names", row),
                "add the tool to TOOLTURN.TRN");
  }
}

namespace {

void lockIfBroken(Context& context, const std::string& row, NumberColumn column, double deviation) {
  auto& control = context.control();
  auto& tools = control.tables.tools;
  const double breakage = tools.numberOr(row, column, 0);
  if (!(breakage > 0) || std::abs(deviation) <= breakage) return;
  control.writeText(tools, row, "TL", "L");
  throw Alarm(
      "Tool breakage",
      fmt::format(
          "The deviation {:.4f} mm exceeds the breakage tolerance {:.4f} mm ({}) of tool {}; the tool is locked",
          deviation, breakage, column.name(), row),
      "check the tool, then release it in TOOL.T (column TL)");
}

void correctTurningTool(Context& context, const std::string& row, const ToolMonitoring& monitoring) {
  auto& control = context.control();
  auto& table = control.tables.turningTools;
  // The tool's axes in (away from the turning axis, along the tool axis of the program).
  const double incidence = radiansFromDegrees(context.q(531));
  const Vector2 z(std::sin(incidence), std::cos(incidence));
  const Vector2 x = (context.option(498) == 1 ? -1 : 1) * Vector2(std::cos(incidence), -std::sin(incidence));
  const Vector2 shift = monitoring.length ? Vector2(0, *monitoring.turned) : Vector2(*monitoring.turned, 0);
  const auto add = [&](NumberColumn column, double value) {
    if (std::abs(value) < 5e-7) return;
    control.writeNumber(*table, row, column, table->numberOr(row, column, 0) + value);
  };
  add("DZL", -shift.dot(z));
  add("DXL", shift.dot(x));
}

}  // namespace

void monitorTool(Context& context, const ToolMonitoring& monitoring) {
  const std::string row = monitoredToolRow(context);
  if (row.empty()) return;
  auto& control = context.control();
  auto& tools = control.tables.tools;
  if (isTurningTool(context, row)) {
    lockIfBroken(context, row, "LBREAK", monitoring.monitored);
    correctTurningTool(context, row, monitoring);
    return;
  }
  lockIfBroken(context, row, "RBREAK", monitoring.monitored);
  if (!monitoring.correct) return;
  const NumberColumn column = monitoring.length ? NumberColumn("DL") : NumberColumn("DR");
  control.writeNumber(tools, row, column, tools.numberOr(row, column, 0) - monitoring.excess);
}

}  // namespace probewright::cycles::heidenhain
