#include "cycles/heidenhain/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "control/alarm.hpp"
#include "cycles/heidenhain/tool_monitoring.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::EventKind;

Inspected inspectedPosition(int parameter, int deviationParameter, std::string label, double nominal, double actual,
                            double tolerance) {
  Inspected item;
  item.parameter = parameter;
  item.deviationParameter = deviationParameter;
  std::string inSentence = label;
  if (!inSentence.empty()) inSentence[0] = lower(inSentence[0]);
  item.maximumLabel = "Maximum limit for " + inSentence;
  item.minimumLabel = "Minimum limit for " + inSentence;
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

namespace {

void judge(Inspected& item, Side side) {
  if (!item.maximum && !item.minimum) return;
  constexpr double none = std::numeric_limits<double>::infinity();
  const metrology::Limits limits{item.minimum.value_or(-none), item.maximum.value_or(none)};
  item.verdict =
      side == Side::Inside ? metrology::boreVerdict(item.actual, limits) : metrology::studVerdict(item.actual, limits);
}

}  // namespace

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
  if (maximum != 0) item.maximum = maximum;
  if (minimum != 0) item.minimum = minimum;
  judge(item, side);
  return item;
}

Inspected inspectedCoordinate(int parameter, std::string label, std::string limitLabel, double nominal, double actual,
                              double maximum, double minimum, Side side) {
  Inspected item =
      inspectedDimension(parameter, 0, std::move(label), std::move(limitLabel), nominal, actual, 0, 0, side);
  if (maximum == 0 && minimum == 0) return item;
  item.maximum = maximum;
  item.minimum = minimum;
  judge(item, side);
  return item;
}

Verdict verdictOf(const Inspection& inspection) {
  Verdict verdict = Verdict::Good;
  for (const Inspected& item : inspection.items)
    verdict = metrology::worst(verdict, item.verdict);
  return verdict;
}

void writeLog(Context& context, const Inspection& inspection) {
  const int log = context.option(281);
  if (log == 1) context.log(fmt::format("TCHPR{}.TXT", context.record().name), logText(context, inspection));
  const std::optional<bool> interrupt = context.control().overrides.interrupt;
  if (interrupt ? *interrupt : log == 2) {
    context.stop(logText(context, inspection));
  } else if (context.control().panel.showAllResults) {
    context.record().screens.push_back(logText(context, inspection));
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
    const double unit = context.control().mainUnit;
    const int decimals = unit == 1 ? 4 : 5;
    std::string which;
    for (const Inspected& item : inspection.items) {
      if (item.verdict != Verdict::Rework && item.verdict != Verdict::Scrap) continue;
      which += fmt::format("{0}{1} {2:.{4}f} ({3:+.{4}f})", which.empty() ? "" : ", ", item.label, item.actual / unit,
                           item.deviation() / unit, decimals);
    }
    throw Alarm("Tolerance exceeded", fmt::format("{}: {}", verdict == Verdict::Scrap ? "Scrap" : "Rework", which));
  }
}

}  // namespace probewright::cycles::heidenhain
