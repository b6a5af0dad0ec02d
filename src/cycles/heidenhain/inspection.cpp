#include "cycles/heidenhain/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/alarm.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::EventKind;

Inspected inspectedPosition(int parameter, int deviationParameter, std::string label, double nominal, double actual,
                            double tolerance) {
  Inspected item;
  item.parameter = parameter;
  item.deviationParameter = deviationParameter;
  std::string lower = label;
  if (!lower.empty()) lower[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(lower[0])));
  item.maximumLabel = "Maximum limit for " + lower;
  item.minimumLabel = "Minimum limit for " + lower;
  item.label = std::move(label);
  item.nominal = nominal;
  item.actual = actual;
  if (tolerance != 0) {
    item.maximum = nominal + tolerance;
    item.minimum = nominal - tolerance;
    item.verdict = metrology::positionVerdict(actual, {*item.minimum, *item.maximum});
  }
  return item;
}

Inspected inspectedDimension(int parameter, int deviationParameter, std::string label, std::string limitLabel,
                             double nominal, double actual, double maximum, double minimum, Side side) {
  Inspected item;
  item.parameter = parameter;
  item.deviationParameter = deviationParameter;
  item.label = std::move(label);
  item.maximumLabel = "Maximum dimension for " + limitLabel;
  item.minimumLabel = "Minimum dimension for " + limitLabel;
  item.nominal = nominal;
  item.actual = actual;
  if (maximum != 0 || minimum != 0) {
    item.maximum = maximum;
    item.minimum = minimum;
    const metrology::Limits limits{minimum, maximum};
    item.verdict =
        side == Side::Inside ? metrology::boreVerdict(actual, limits) : metrology::studVerdict(actual, limits);
  }
  return item;
}

Verdict verdictOf(const Inspection& inspection) {
  Verdict verdict = Verdict::Good;
  for (const Inspected& item : inspection.items)
    verdict = metrology::worst(verdict, item.verdict);
  return verdict;
}

std::string monitoredToolRow(Context& context) {
  const Argument& argument = context.arguments().at(330);
  auto& control = context.control();
  if (argument.isText) return argument.text.empty() ? "" : control.toolRowNamed(argument.text);
  if (argument.number == 0) return "";
  const double number = std::floor(argument.number);
  const int index = static_cast<int>(std::lround((argument.number - number) * 10));
  const std::string row = index == 0 ? fmt::format("{:.0f}", number) : fmt::format("{:.0f}.{}", number, index);
  if (!control.tables.tools.hasRow(row)) {
    throw Alarm("Tool not defined", fmt::format("Q330 names tool {}, which TOOL.T does not have", row),
                "correct Q330 or add the tool");
  }
  return row;
}

namespace {

/// Corrects the tool by the material left, or locks it if the deviation says that it broke.
void monitorTool(Context& context, const ToolMonitoring& monitoring) {
  const std::string row = monitoredToolRow(context);
  if (row.empty()) return;
  auto& control = context.control();
  auto& tools = control.tables.tools;
  const double breakage = tools.numberOr(row, "RBREAK", 0);
  if (breakage > 0 && std::abs(monitoring.monitored) > breakage) {
    control.writeText(tools, row, "TL", "L");
    throw Alarm(
        "Tool breakage",
        fmt::format("The deviation {:.4f} mm exceeds the breakage tolerance {:.4f} mm of tool {}; the tool is locked",
                    monitoring.monitored, breakage, row),
        "check the tool, then release it in TOOL.T (column TL)");
  }
  if (!monitoring.correct) return;
  const std::string column = monitoring.length ? "DL" : "DR";
  control.writeNumber(tools, row, column, tools.numberOr(row, column, 0) - monitoring.excess);
}

}  // namespace

void writeLog(Context& context, const Inspection& inspection) {
  const int log = context.option(281);
  const std::optional<bool> interrupt = context.control().overrides.interrupt;
  if (interrupt ? *interrupt : log == 2) {
    context.stop(logText(context, inspection));
  } else if (context.control().panel.showAllResults) {
    context.record().screens.push_back(logText(context, inspection));
  }
  if (log == 1) {
    context.log(fmt::format("TCHPR{}.TXT", context.record().name), logText(context, inspection));
  }
}

void finishInspection(Context& context, const Inspection& inspection, const ToolMonitoring& tool) {
  for (const Inspected& item : inspection.items) {
    context.result(item.parameter, item.actual, {item.nominal, item.minimum, item.maximum, item.verdict});
  }
  for (const Inspected& item : inspection.items) {
    if (item.deviationParameter != 0) context.result(item.deviationParameter, item.deviation());
  }
  const Verdict verdict = verdictOf(inspection);
  context.record().verdict = verdict;
  context.set(180, verdict == Verdict::Good ? 1 : 0);
  context.set(181, verdict == Verdict::Rework ? 1 : 0);
  context.set(182, verdict == Verdict::Scrap ? 1 : 0);

  writeLog(context, inspection);
  monitorTool(context, tool);

  if (context.option(309) == 1 && verdict != Verdict::Good) {
    std::string which;
    for (const Inspected& item : inspection.items) {
      if (item.verdict != Verdict::Rework && item.verdict != Verdict::Scrap) continue;
      which +=
          fmt::format("{}{} {:.4f} ({:+.4f})", which.empty() ? "" : ", ", item.label, item.actual, item.deviation());
    }
    throw Alarm("Tolerance exceeded", fmt::format("{}: {}", verdict == Verdict::Scrap ? "Scrap" : "Rework", which));
  }
}

}  // namespace probewright::cycles::heidenhain
