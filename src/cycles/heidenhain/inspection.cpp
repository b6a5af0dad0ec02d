#include "cycles/heidenhain/inspection.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "cycles/heidenhain/tool_monitoring.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::EventKind;

namespace {

/// One section of the log: a title and what stands beside and below it.
struct Section {
  std::string_view rule;
  std::string_view title;
  std::vector<LogLine> lines;
};

}  // namespace

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

std::string logText(Context& context, const Inspection& inspection) {
  const auto& control = context.control();
  const std::int64_t now = control.wallClockStart +
                           static_cast<std::int64_t>(std::llround(context.channel().seconds() - control.startSeconds));
  const std::tm time = fmt::gmtime(static_cast<std::time_t>(now));
  const std::string rule(61, '-');
  const std::string stars(61, '*');

  Section nominal{rule, "Nominal values:", {}}, limits{rule, "Given limit values:", {}},
      actual{stars, "Actual values:", inspection.measured}, deviations{rule, "Deviations:", {}},
      further{stars, "Further measuring results:", inspection.further};
  std::vector<LogLine> actualItems;
  for (const Inspected& item : inspection.items) {
    nominal.lines.push_back({item.label, item.nominal});
    actualItems.push_back({item.label, item.actual});
    deviations.lines.push_back({item.label, item.deviation()});
    if (item.maximum) limits.lines.push_back({item.maximumLabel, *item.maximum});
    if (item.minimum) limits.lines.push_back({item.minimumLabel, *item.minimum});
  }
  actual.lines.insert(actual.lines.begin(), actualItems.begin(), actualItems.end());

  std::string text =
      fmt::format("****** Measuring Log for Probing Cycle {} {} *****\n\n", context.record().name, inspection.title);
  text += fmt::format("Date:              {:02}-{:02}-{:04}\n", time.tm_mday, time.tm_mon + 1, time.tm_year + 1900);
  text += fmt::format("Time:              {}:{:02}:{:02}\n", time.tm_hour, time.tm_min, time.tm_sec);
  text += fmt::format("Measuring program: {}\n", control.programPath);
  // Values end in one column throughout, 8 characters right of the longest label.
  constexpr std::size_t indent = 21, shortestLabel = 43, valueWidth = 8;
  std::size_t width = shortestLabel;
  for (const Section* section : {&nominal, &limits, &actual, &deviations}) {
    for (const LogLine& line : section->lines)
      width = std::max(width, line.label.size() + 1);
  }
  const int decimals = control.unit == 1 ? 4 : 5;
  for (const Section* section : {&nominal, &limits, &actual, &deviations, &further}) {
    if (section->lines.empty()) continue;
    text += fmt::format("{}\n", section->rule);
    const std::size_t left = std::max(indent, section->title.size() + 1);
    for (std::size_t i = 0; i < section->lines.size(); ++i) {
      const LogLine& line = section->lines[i];
      const double value = line.kind == ValueKind::Length ? line.value / control.unit : line.value;
      const std::string label = fmt::format("{:<{}}{}:", i == 0 ? section->title : "", left, line.label);
      const std::string number = formatFixed(value, decimals);
      const std::size_t end = indent + width + valueWidth;
      const std::size_t room = std::max(end - std::min(end, label.size()), number.size() + 1);
      text += fmt::format("{}{:>{}}\n", label, number, room);
    }
  }
  text += "******************** End of measuring log ********************\n";
  return text;
}

void writeLog(Context& context, const Inspection& inspection) {
  const int log = context.option(281);
  const std::optional<bool> interrupt = context.control().overrides.interrupt;
  if (interrupt ? *interrupt : log == 2) context.stop(logText(context, inspection));
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
