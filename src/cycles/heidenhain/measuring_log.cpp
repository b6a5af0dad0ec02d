#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "base/number_text.hpp"
#include "base/utc.hpp"
#include "base/utf8.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/log_texts.hpp"

namespace probewright::cycles::heidenhain {
namespace {

/// One section of the log: a title and what stands beside and below it.
struct Section {
  std::string_view rule;
  std::string_view title;
  std::vector<LogLine> lines;
};

constexpr std::size_t ruleWidth = 61, capitalRuleWidth = 104, shorterCapitalRule = 100;

/// `text` between stars on a line of `columns`.
std::string amongStars(const std::string& text, std::size_t columns) {
  const std::size_t stars = columns - std::min(columns, characterCount(text) + 2);
  return fmt::format("{} {} {}\n", std::string(stars / 2, '*'), text, std::string(stars - stars / 2, '*'));
}

}  // namespace

std::string logText(Context& context, const Inspection& inspection) {
  const auto& control = context.control();
  const DialogLanguage language = control.panel.language;
  const bool capitals = !control.isTNC640() && !context.entry().capitalTerms.empty() && hasEnglishLogs(language);
  const LogFrame& frame = capitals ? capitalLogFrame() : logFrame(language);
  const auto term = [&](std::string_view english) {
    const Entry& entry = context.entry();
    return capitals ? capitalTerm(english, entry.capitalTerms)
                    : std::string(translated(english, language, entry.logTerms));
  };
  const std::tm time = utcTime(control.wallClockStart, context.channel().seconds() - control.startSeconds);
  const std::size_t columns = capitals ? capitalRuleWidth : ruleWidth;
  const std::string rule(columns, '-'), first(capitals ? shorterCapitalRule : ruleWidth, '-'), stars(columns, '*');

  Section nominal{first, frame.nominal, {}}, limits{first, frame.limits, {}}, actual{stars, frame.actual, {}},
      deviations{rule, frame.deviations, {}}, further{stars, frame.further, {}};
  const auto add = [&term](Section& section, std::string_view label, double value, ValueKind kind) {
    section.lines.push_back({term(label), value, kind});
  };
  for (const Inspected& item : inspection.items) {
    add(nominal, item.label, item.nominal, ValueKind::Length);
    add(actual, item.label, item.actual, ValueKind::Length);
    add(deviations, item.label, item.deviation(), ValueKind::Length);
    if (item.maximum) add(limits, item.maximumLabel, *item.maximum, ValueKind::Length);
    if (item.minimum) add(limits, item.minimumLabel, *item.minimum, ValueKind::Length);
  }
  for (const LogLine& line : inspection.measured)
    add(actual, line.label, line.value, line.kind);
  for (const LogLine& line : inspection.further)
    add(further, line.label, line.value, line.kind);

  // Values end in one column throughout, 8 characters right of the longest label, further where a value needs it.
  constexpr std::size_t shortestLabel = 43, valueWidth = 8;
  std::size_t indent = 0, labelWidth = shortestLabel, headWidth = 0;
  for (const Section* section : {&nominal, &limits, &actual, &deviations}) {
    indent = std::max(indent, characterCount(section->title) + 2);
    for (const LogLine& line : section->lines)
      labelWidth = std::max(labelWidth, characterCount(line.label) + 1);
  }
  for (const std::string_view label : {frame.date, frame.time, frame.program})
    headWidth = std::max(headWidth, characterCount(label) + 1);

  const std::string title = fmt::format(fmt::runtime(frame.title), context.record().name, term(inspection.title));
  std::string text = capitals ? rule + "\n" + amongStars(title, columns) : fmt::format("****** {} *****\n\n", title);
  const auto head = [&](std::string_view label) {
    return capitals ? std::string(label) + " " : padded(label, headWidth);
  };
  text += head(frame.date) + fmt::format(fmt::runtime(frame.dateForm), time) + "\n";
  text += head(frame.time) + fmt::format("{}:{:02}:{:02}\n", time.tm_hour, time.tm_min, time.tm_sec);
  text += head(frame.program) + control.programPath + "\n";
  const int decimals = control.mainUnit == 1 ? 4 : 5;
  struct Row {
    std::string label, value;
  };
  std::vector<std::pair<const Section*, std::vector<Row>>> filled;
  std::size_t end = indent + labelWidth + valueWidth;
  for (const Section* section : {&nominal, &limits, &actual, &deviations, &further}) {
    if (section->lines.empty()) continue;
    std::vector<Row>& rows = filled.emplace_back(section, std::vector<Row>()).second;
    const std::size_t left = std::max(indent, characterCount(section->title) + 1);
    for (const LogLine& line : section->lines) {
      const bool length = line.kind == ValueKind::Length;
      rows.push_back({padded(rows.empty() ? section->title : "", left) + line.label + ":",
                      formatFixed(length ? line.value / control.mainUnit : line.value, length ? decimals : 4)});
      end = std::max(end, characterCount(rows.back().label) + 1 + rows.back().value.size());
    }
  }
  for (const auto& [section, rows] : filled) {
    text += fmt::format("{}\n", section->rule);
    for (const Row& row : rows)
      text += fmt::format("{}{:>{}}\n", row.label, row.value, end - characterCount(row.label));
  }
  text += amongStars(std::string(frame.end), capitals ? columns : characterCount(frame.end) + 42);
  return text;
}

}  // namespace probewright::cycles::heidenhain
