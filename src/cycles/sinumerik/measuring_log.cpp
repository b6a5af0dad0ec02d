#include "cycles/sinumerik/measuring_log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "base/utc.hpp"

namespace probewright::cycles::sinumerik {
namespace {

using control::CycleRecord;
using control::ResultRecord;
using control::Role;

constexpr std::size_t leastLabelWidth = 46, valueWidth = 12;

const ResultRecord* resultNamed(const CycleRecord& record, const std::string& name) {
  // The last one counts: a cycle may measure again.
  const auto found = std::find_if(record.results.rbegin(), record.results.rend(),
                                  [&](const ResultRecord& each) { return each.name == name; });
  return found == record.results.rend() ? nullptr : &*found;
}

const ResultRecord* ovr(const CycleRecord& record, int index) {
  return resultNamed(record, fmt::format("_OVR[{}]", index));
}

std::string parameter(const CycleRecord& record, const std::string& name) {
  const auto found = std::ranges::find(record.parameters, name, &control::ParameterRecord::name);
  return found == record.parameters.end() ? std::string() : found->value;
}

/// The result in _OVR that has this role of the characteristic, or null.
const ResultRecord* partner(const CycleRecord& record, Role role, const control::Characteristic& of) {
  const auto found = std::find_if(record.results.rbegin(), record.results.rend(), [&](const ResultRecord& each) {
    return each.kind.role == role && each.kind.of == of && each.name.starts_with("_OVR");
  });
  return found == record.results.rend() ? nullptr : &*found;
}

/// A value that was measured, beside which its set value and its difference stand.
bool isMeasured(const ResultRecord& result) {
  return result.kind.role == Role::Actual || result.kind.role == Role::Touch;
}

/// True if the value stands in the row of the one that was measured.
bool standsBeside(const CycleRecord& record, const ResultRecord& result) {
  if (result.kind.role != Role::Set && result.kind.role != Role::Difference) return false;
  return partner(record, Role::Actual, result.kind.of) != nullptr ||
         partner(record, Role::Touch, result.kind.of) != nullptr;
}

std::string number(const std::optional<double>& value) { return value ? formatFixed(*value, 4) : std::string(); }

std::string_view word(control::Verdict verdict) {
  constexpr std::array<std::string_view, 4> words = {"", "good", "rework", "scrap"};
  return words[static_cast<std::size_t>(verdict)];
}

std::string labelOf(const MeasuredRow& row) {
  return row.unit.empty() ? row.label : fmt::format("{} [{}]", row.label, row.unit);
}

/// As wide as the longest label asks.
std::size_t labelWidthOf(const std::vector<MeasuredRow>& rows) {
  std::size_t width = leastLabelWidth;
  for (const MeasuredRow& row : rows)
    width = std::max(width, labelOf(row).size());
  return width;
}

/// The rows in columns, a heading above them.
std::string columns(const std::vector<MeasuredRow>& rows) {
  const std::size_t labelWidth = labelWidthOf(rows);
  const bool limits = std::ranges::any_of(rows, [](const MeasuredRow& row) { return row.lower || row.upper; });
  std::string text = fmt::format("{:<{}}{:>{w}}{:>{w}}{:>{w}}", "", labelWidth, "Setpoint", "Measured", "Difference",
                                 fmt::arg("w", valueWidth));
  if (limits) text += fmt::format("{:>{w}}{:>{w}}", "Lower limit", "Upper limit", fmt::arg("w", valueWidth));
  text += "\n";
  for (const MeasuredRow& row : rows) {
    std::string line = fmt::format("{:<{}}{:>{w}}{:>{w}}{:>{w}}", labelOf(row), labelWidth, number(row.setpoint),
                                   number(row.measured), number(row.difference), fmt::arg("w", valueWidth));
    if (limits) line += fmt::format("{:>{w}}{:>{w}}", number(row.lower), number(row.upper), fmt::arg("w", valueWidth));
    if (row.verdict != control::Verdict::None) line += fmt::format("  {}", word(row.verdict));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string variantOf(const CycleRecord& record) {
  const std::string variant = parameter(record, "S_MVAR");
  return variant.empty() ? std::string() : fmt::format("S_MVAR = {}", variant);
}

/// What was corrected: the memory of the first entry written.
std::string corrected(const CycleRecord& record) {
  if (record.writes.empty()) return {};
  const control::WriteRecord& first = record.writes.front();
  return fmt::format("{}{}", first.table, first.entry);
}

std::string toolText(const Control& control) {
  return fmt::format("T {} D{}", control.tool.name.empty() ? std::to_string(control.tool.number) : control.tool.name,
                     control.tool.edge);
}

/// The tool whose offset the call names: "T MILL D1 DL2"; empty if it corrects none.
std::string correctedTool(const Control& control, const CycleRecord& record) {
  const ResultRecord* tool = resultNamed(record, "_OVI[8]");
  if (tool == nullptr || tool->value == 0) return {};
  const auto value = [&record](const char* name) {
    const ResultRecord* result = resultNamed(record, name);
    return result == nullptr ? 0 : result->value;
  };
  const auto name = control.data.get("$TC_TP2", {static_cast<int>(tool->value)});
  const std::string* text = name ? std::get_if<std::string>(&*name) : nullptr;
  std::string line = fmt::format(
      "T {} D{:.0f}", text != nullptr && !text->empty() ? *text : fmt::format("{:.0f}", tool->value), value("_OVI[0]"));
  if (const double dl = value("_OVI[13]"); dl != 0) line += fmt::format(" DL{:.0f}", dl);
  return line;
}

std::tm clock(const Control& control, double seconds) { return utcTime(control.wallClockStart, seconds); }

std::string probeText(const CycleRecord& record) {
  const ResultRecord* probe = resultNamed(record, "_OVI[5]");
  return probe == nullptr ? std::string() : fmt::format("{:.0f}", probe->value);
}

std::string textEntry(const Control& control, const MeasuringLog& log, const CycleRecord& record) {
  const std::string rule(94, '-');
  std::string text;
  if (log.entries == 0) {
    text += fmt::format("{}\nDate: {:%Y-%m-%d}   Time: {:%H:%M:%S}\nProgram: {}\nLog: {}\n{}\n", rule,
                        clock(control, record.endSeconds), clock(control, record.endSeconds), control.programPath,
                        log.file, rule);
  }
  text += fmt::format("{}  {}  {}   {}   Time: {:%H:%M:%S}   Line: {}\n", log.entries + 1, record.name, record.title,
                      variantOf(record), clock(control, record.endSeconds), record.place.line);
  text += columns(measuredRows(record));
  if (const std::string probe = probeText(record); !probe.empty()) text += fmt::format("Probe number: {}   ", probe);
  text += toolText(control);
  if (const std::string tool = correctedTool(control, record); !tool.empty())
    text += fmt::format("   Corrected tool: {}", tool);
  if (const std::string target = corrected(record); !target.empty()) text += fmt::format("   Corrected: {}", target);
  if (!record.alarm.empty()) text += fmt::format("\nAlarm: {}", record.alarm);
  return text + "\n" + rule + "\n";
}

/// A field of the table: quoted where it holds a separator or a quotation mark.
std::string field(const std::string& text) {
  if (text.find_first_of(";\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' ? ' ' : c;
  }
  return quoted + '"';
}

std::string tableEntry(const Control& control, const MeasuringLog& log, const CycleRecord& record) {
  std::string text;
  if (log.entries == 0) {
    text +=
        "No;Date;Time;Program;Line;Cycle;Variant;Value;Unit;Setpoint;Measured;Difference;Lower limit;Upper limit;"
        "Status;Probe;Tool;Corrected;Alarm\n";
  }
  const std::tm time = clock(control, record.endSeconds);
  std::vector<MeasuredRow> rows = measuredRows(record);
  if (rows.empty()) rows.emplace_back();  // an alarm before the first value
  for (const MeasuredRow& row : rows) {
    text +=
        fmt::format("{};{:%Y-%m-%d};{:%H:%M:%S};{};{};{};{};{};{};{};{};{};{};{};{};{};{};{};{}\n", log.entries + 1,
                    time, time, field(control.programPath), record.place.line, record.name, parameter(record, "S_MVAR"),
                    field(row.label), row.unit, number(row.setpoint), number(row.measured), number(row.difference),
                    number(row.lower), number(row.upper), word(row.verdict), probeText(record),
                    field(toolText(control)), field(corrected(record)), field(record.alarm));
  }
  return text;
}

}  // namespace

std::vector<MeasuredRow> measuredRows(const CycleRecord& record) {
  // Only single cutting edges have elements from 100 on.
  const bool edges =
      std::ranges::any_of(record.results, [](const ResultRecord& each) { return each.kind.of.item > 0; });
  const int count = edges ? 500 : static_cast<int>(Control::afterKept);
  std::vector<MeasuredRow> rows;
  for (int i = 0; i < count; ++i) {
    const ResultRecord* result = ovr(record, i);
    if (result == nullptr || standsBeside(record, *result)) continue;
    MeasuredRow row;
    row.unit = result->unit;
    row.measured = result->value;
    if (!isMeasured(*result)) {
      row.label = result->meaning;
      rows.push_back(std::move(row));
      continue;
    }
    row.label = result->label;
    const ResultRecord* set = partner(record, Role::Set, result->kind.of);
    const ResultRecord* difference = partner(record, Role::Difference, result->kind.of);
    if (set != nullptr) row.setpoint = set->value;
    if (difference != nullptr) row.difference = difference->value;
    for (const ResultRecord* each : {result, difference}) {
      if (each == nullptr || each->verdict == control::Verdict::None) continue;
      // Limits of a difference count from the set value.
      const double from = each == result ? 0 : row.setpoint.value_or(0);
      if (each->lowerLimit) row.lower = from + *each->lowerLimit;
      if (each->upperLimit) row.upper = from + *each->upperLimit;
      row.verdict = each->verdict;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string resultScreen(const Control& control, const CycleRecord& record) {
  std::string text = fmt::format("{}  {}   {}\n", record.name, record.title, variantOf(record));
  const std::vector<MeasuredRow> rows = measuredRows(record);
  text += columns(rows);
  const std::size_t labelWidth = labelWidthOf(rows);
  const auto line = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) text += fmt::format("{:<{}}{}\n", name, labelWidth, value);
  };
  // Where the cycle leaves no result for it: as the call says.
  if (std::ranges::none_of(rows, [](const MeasuredRow& row) { return row.label == "safe area"; }))
    line("safe area", parameter(record, "S_TSA"));
  line("probe number", probeText(record));
  line("tool", toolText(control));
  line("corrected tool", correctedTool(control, record));
  line("corrected", corrected(record));
  line("alarm", record.alarm);
  return text;
}

void addToLog(Control& control, MeasuringLog& log, const CycleRecord& record) {
  control.panel.appendToFile(log.file, log.form == MeasuringLog::Form::Text ? textEntry(control, log, record)
                                                                            : tableEntry(control, log, record));
  ++log.entries;
}

void outputResults(Control& control, CycleRecord& record, int alarm) {
  control::sinumerik::ResultOutput& output = control.output;
  const auto write = [&](MeasuringLog& log) {
    addToLog(control, log, record);
    if (std::ranges::find(record.logFiles, log.file) == record.logFiles.end()) record.logFiles.push_back(log.file);
  };
  for (MeasuringLog& log : output.logs)
    write(log);
  if (output.programLog) write(*output.programLog);

  const int display = output.display.value_or(truncated(control.data.number("$SCS_MEA_RESULT_DISPLAY", {}, 0)));
  if (display != 0 && display != 1 && display != 3 && display != 4) {
    const std::string text =
        fmt::format("$SCS_MEA_RESULT_DISPLAY = {}: the result screen knows 0, 1, 3 and 4, and stays off", display);
    const auto told = [&](const control::EventRecord& event) { return event.text == text; };
    if (std::ranges::none_of(control.journal.events, told))
      control.panel.message(control::EventKind::Warning, text, control.channel.seconds());
  }
  const bool limitsExceeded = alarm >= 61303 && alarm <= 61306;
  const bool waits = display == 3 || (display == 4 && limitsExceeded);
  if (!waits && display != 1 && !control.panel.showAllResults) return;
  record.screens.push_back(resultScreen(control, record));
  if (waits) control.panel.stop(record.screens.back(), control.channel.seconds());
}

}  // namespace probewright::cycles::sinumerik
