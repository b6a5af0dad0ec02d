#include "reports/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/number_text.hpp"
#include "base/utf8.hpp"
#include "cycles/main_results.hpp"
#include "records/readable_text.hpp"
#include "records/results.hpp"
#include "reports/screen_lines.hpp"
#include "reports/truth_summary.hpp"
#include "words/words.hpp"

namespace probewright::reports {

namespace {

using control::Verdict;

enum class Tone { Plain, Good, Warning, Bad };

class Painter {
public:
  explicit Painter(Colour colour) : on_(colour == Colour::On) {}

  std::string operator()(Tone tone, std::string_view text) const {
    const char* code = tone == Tone::Good ? "32" : tone == Tone::Warning ? "33" : "31";
    if (!on_ || tone == Tone::Plain || text.empty()) return std::string(text);
    return fmt::format("\x1b[1;{}m{}\x1b[0m", code, text);
  }

private:
  bool on_;
};

Tone tone(Verdict verdict) {
  switch (verdict) {
    case Verdict::None:
      return Tone::Plain;
    case Verdict::Good:
      return Tone::Good;
    case Verdict::Rework:
      return Tone::Warning;
    case Verdict::Scrap:
      return Tone::Bad;
  }
  return Tone::Plain;
}

/// The key of its text; nothing for None.
std::string_view word(Verdict verdict) {
  switch (verdict) {
    case Verdict::None:
      return "";
    case Verdict::Good:
      return "sumGood";
    case Verdict::Rework:
      return "sumRework";
    case Verdict::Scrap:
      return "sumScrap";
  }
  return "";
}

std::string quantity(double value, const std::string& unit, control::DialogLanguage language) {
  if (!std::isfinite(value)) return words::text(language, "sumNotANumber");
  return unit.empty() ? formatShortest(value) : formatFixed(value, unit == "in" ? 5 : 4);
}

constexpr double inch = 25.4;

/// The result in the unit of its program.
control::ResultRecord inInches(control::ResultRecord result) {
  if (result.unit != "mm") return result;
  result.unit = "in";
  result.value /= inch;
  for (auto* length : {&result.nominal, &result.deviation, &result.lowerLimit, &result.upperLimit}) {
    if (*length) **length /= inch;
  }
  return result;
}

std::string fileName(const std::string& path) { return path.substr(path.find_last_of("/\\") + 1); }

/// How the texts of this run are written.
struct Style {
  Painter paint;
  records::ReadableText readable;
  std::string mainProgram;
  bool inches = false;
  control::DialogLanguage language = control::DialogLanguage::English;

  std::string text(std::string_view key, words::Values values = {}) const { return words::text(language, key, values); }
  std::string counted(std::string_view key, std::size_t n, words::Values values = {}) const {
    return words::counted(language, key, n, values);
  }
  /// A sentence about the run, fit for a terminal.
  std::string sentence(const std::string& bytes) const { return words::translated(language, line(bytes)); }
  std::string painted(Verdict verdict) const { return paint(tone(verdict), text(word(verdict))); }

  /// One line of text whatever the program put into it: control characters must not reach the terminal.
  std::string line(const std::string& bytes) const {
    std::string text = readable(bytes);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
    // U+0080 to U+009F: some terminals take them for the beginning of a command too.
    for (std::size_t at = text.find('\xC2'); at != std::string::npos; at = text.find('\xC2', at + 1)) {
      if (at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) < 0xA0) text.replace(at, 2, " ");
    }
    return text;
  }

  std::string place(const SourcePlace& place) const {
    if (place.line == 0) return "";
    if (place.file == mainProgram || place.file.empty()) return text("sumLine", {{"line", std::to_string(place.line)}});
    return fmt::format("{}:{}", line(fileName(place.file)), place.line);
  }
};

std::string duration(double seconds, const Style& style) {
  if (!(seconds >= 60)) return style.text("sumSeconds", {{"s", fmt::format("{:.1f}", seconds)}});
  const auto whole = std::llround(seconds);
  if (whole < 3600)
    return style.text("sumMinutes", {{"min", std::to_string(whole / 60)}, {"s", std::to_string(whole % 60)}});
  return style.text("sumHours", {{"h", std::to_string(whole / 3600)}, {"min", std::to_string(whole % 3600 / 60)}});
}

std::string distance(double mm) {
  return mm < 1000 ? fmt::format("{:.0f} mm", mm) : fmt::format("{:.2f} m", mm / 1000);
}

std::string meaningOf(const control::ResultRecord& result, const Style& style) {
  return words::meaning(style.language, result.kind, style.line(result.meaning));
}

std::string resultLine(const control::ResultRecord& measured, const std::optional<records::TrueValue>& truth,
                       std::size_t meaningWidth, const Style& style) {
  const control::ResultRecord result = style.inches ? inInches(measured) : measured;
  std::string limits;
  if (result.lowerLimit && result.upperLimit)
    limits = fmt::format("  [{} .. {}]", quantity(*result.lowerLimit, result.unit, style.language),
                         quantity(*result.upperLimit, result.unit, style.language));
  std::string deviation;
  if (result.deviation && std::isfinite(*result.deviation))
    deviation = "  " + style.text("sumDeviation",
                                  {{"value", result.unit.empty()
                                                 ? formatShortest(*result.deviation)
                                                 : formatSigned(*result.deviation, result.unit == "in" ? 5 : 4)}});
  std::string text =
      fmt::format("      {:<9} {:<{}} {:>11} {:<3}{}{}", style.line(result.name), meaningOf(result, style),
                  meaningWidth, quantity(result.value, result.unit, style.language), result.unit, deviation, limits);
  text.erase(text.find_last_not_of(' ') + 1);
  if (result.verdict != Verdict::None) text += "  " + style.painted(result.verdict);
  if (truth) {
    records::TrueValue known = *truth;
    if (result.unit != measured.unit) known.value /= inch;
    text += besideResult(known, result.value, result.unit == "in" ? 5 : 4, style.language);
  }
  return text + "\n";
}

std::string writeLine(const control::WriteRecord& write, const Style& style) {
  const auto shown = [&](const std::string& value) {
    return value.empty() ? style.text("sumEmpty") : style.line(value);
  };
  return fmt::format("      -> {} {}: {} -> {}\n", words::phrase(style.language, style.line(write.table)),
                     words::phrase(style.language, style.line(write.entry)), shown(write.before), shown(write.after));
}

/// A text of several lines in a frame, as a screen shows it.
std::string screenText(const std::string& screen, const control::CycleRecord& cycle, const Style& style) {
  std::string text = "      +" + std::string(30, '-') + "\n";
  std::size_t begin = 0;
  while (begin < screen.size()) {
    const std::size_t end = std::min(screen.find('\n', begin), screen.size());
    text += "      | " + screenLine(style.line(screen.substr(begin, end - begin)), cycle, style.language) + "\n";
    begin = end + 1;
  }
  return text + "      +" + std::string(30, '-') + "\n";
}

std::string cycleText(const control::CycleRecord& cycle, const records::CycleTruth& truth, std::size_t number,
                      bool saidAtTheEnd, const Style& style) {
  std::string text = fmt::format("{:>3}  {} {}", number, style.line(cycle.name), style.sentence(cycle.title));
  const std::string place = style.place(cycle.place);
  if (!place.empty()) text += fmt::format("  ({})", place);
  if (!cycle.alarm.empty())
    text += "  " + style.paint(Tone::Bad, style.text("sumAlarm"));
  else if (cycle.verdict != Verdict::None)
    text += "  " + style.painted(cycle.verdict);
  text += "\n";
  const std::vector<bool> isMain = cycles::mainResults(cycle);
  std::size_t width = 44;
  for (std::size_t i = 0; i < isMain.size(); ++i) {
    if (isMain[i]) width = std::max(width, characterCount(meaningOf(cycle.results[i], style)));
  }
  for (std::size_t i = 0; i < isMain.size(); ++i) {
    if (!isMain[i]) continue;
    const auto known = i < truth.results.size() ? truth.results[i] : std::nullopt;
    text += resultLine(cycle.results[i], known, width, style);
  }
  for (const auto& write : cycle.writes)
    text += writeLine(write, style);
  for (const auto& screen : cycle.screens)
    text += screenText(screen, cycle, style);
  for (const auto& file : cycle.logFiles)
    text += "      " + style.text("sumLog", {{"file", style.line(fileName(file))}}) + "\n";
  if (!cycle.alarm.empty() && !saidAtTheEnd)
    text += fmt::format("      {}\n", style.paint(Tone::Bad, style.sentence(cycle.alarm)));
  return text;
}

/// The key of the text.
std::string_view eventWord(control::EventKind kind) {
  switch (kind) {
    case control::EventKind::Message:
      return "sumMessage";
    case control::EventKind::Alarm:
      return "sumAlarm";
    case control::EventKind::Stop:
      return "sumStop";
    case control::EventKind::Skipped:
      return "sumSkipped";
    case control::EventKind::Tool:
      return "sumTool";
    case control::EventKind::Warning:
      return "sumWarning";
  }
  return "sumMessage";
}

std::string eventText(const control::EventRecord& event, const Style& style) {
  const bool grave = event.kind == control::EventKind::Alarm || event.kind == control::EventKind::Stop;
  const bool doubtful = event.kind == control::EventKind::Warning || event.kind == control::EventKind::Skipped;
  std::string text = "  " +
                     style.paint(grave      ? Tone::Bad
                                 : doubtful ? Tone::Warning
                                            : Tone::Plain,
                                 style.text(eventWord(event.kind))) +
                     "  ";
  text += style.sentence(event.code);
  if (!event.code.empty() && !event.text.empty()) text += ": ";
  // Of a screen at which the program stopped its first line; all of it stands with its cycle.
  const std::size_t lineEnd = event.kind == control::EventKind::Stop ? event.text.find('\n') : std::string::npos;
  const std::string said = event.text.substr(0, lineEnd);
  // The program's own words stay as they are.
  const bool own = event.kind == control::EventKind::Message || event.kind == control::EventKind::Stop;
  text += own ? words::phrase(style.language, style.line(said)) : style.sentence(said);
  if (lineEnd != std::string::npos) text += " ...";
  const std::string place = style.place(event.place);
  if (!place.empty()) text += fmt::format("  ({})", place);
  return text + "\n";
}

/// As an exit text says it.
std::string messageOf(const control::EventRecord& event) {
  return event.code.empty() ? event.text : event.code + ": " + event.text;
}

std::string outcome(const control::Journal& journal, const records::RunInfo& run, Cause cause, const Style& style) {
  std::size_t toleranced = 0, outside = 0;
  for (const auto& cycle : journal.cycles) {
    for (const auto& result : cycle.results) {
      toleranced += result.verdict != Verdict::None;
      outside += result.verdict == Verdict::Rework || result.verdict == Verdict::Scrap;
    }
  }
  const std::string why = run.exitText.empty() || cause == Cause::Told ? "" : ": " + style.sentence(run.exitText);
  switch (run.exit) {
    case records::ExitState::Stopped:
      return style.paint(Tone::Bad, style.text("sumStopped")) + why;
    case records::ExitState::InputMistake:
      return style.paint(Tone::Bad, style.text("sumInputMistake")) + why;
    case records::ExitState::Internal:
      return style.paint(Tone::Bad, style.text("sumInternalError")) + why;
    case records::ExitState::Good:
    case records::ExitState::OutOfTolerance:
      break;
  }
  const Verdict worst = records::worstVerdict(journal);
  if (run.exit == records::ExitState::OutOfTolerance || worst >= Verdict::Rework)
    return style.paint(worst == Verdict::Scrap ? Tone::Bad : Tone::Warning, style.text("sumOutOfTolerance")) +
           (outside > 0 ? ": " + style.counted("sumOutside", toleranced, {{"bad", std::to_string(outside)}}) : why);
  const std::string good = style.painted(Verdict::Good) + ": ";
  return good + (toleranced == 0 ? style.text("sumNothingToleranced") : style.counted("sumAllWithin", toleranced));
}

}  // namespace

std::string summaryText(const control::Journal& journal, const records::RunInfo& run, Colour colour, Cause cause,
                        control::DialogLanguage language) {
  const Style style{Painter(colour), records::ReadableText(run), run.programs.empty() ? "" : run.programs[0].path,
                    run.inches, language};
  std::string text = style.line(fileName(style.mainProgram));
  for (const std::string& part : {run.control, words::phrase(language, run.machine), run.partName})
    if (!part.empty()) text += (text.empty() ? "" : ", ") + style.line(part);
  text += "\n";
  if (!run.skipLevels.empty()) {
    const std::string levels = fmt::format("{}", fmt::join(run.skipLevels, ", "));
    text += "  " + style.text("sumSkippedBlocks", {{"levels", levels}}) + "\n";
  }

  for (std::size_t i = 0; i < journal.cycles.size(); ++i) {
    const control::CycleRecord& cycle = journal.cycles[i];
    const bool known = run.truth && i < run.truth->cycles.size();
    text += cycleText(cycle, known ? run.truth->cycles[i] : records::CycleTruth(), i + 1,
                      !cycle.alarm.empty() && cycle.alarm == run.exitText, style);
  }
  if (!journal.writes.empty()) text += "  " + style.text("sumByProgram") + "\n";
  for (const auto& write : journal.writes)
    text += writeLine(write, style);
  const TruthStyle truthStyle{language, [&](const std::string& bytes) { return style.line(bytes); },
                              [&](const SourcePlace& place) { return style.place(place); }};
  if (run.truth) text += entriesText(*run.truth, truthStyle);
  std::size_t alarms = 0;
  std::string where;
  for (std::size_t i = 0; i < journal.events.size(); ++i) {
    const control::EventRecord event = journal.events[i];
    const bool isAlarm = event.kind == control::EventKind::Alarm;
    alarms += isAlarm;
    // What ended the run is said once, as its outcome.
    const bool ended = isAlarm && i + 1 == journal.events.size() && messageOf(event) == run.exitText;
    if (ended) where = style.place(event.place);
    if (event.kind != control::EventKind::Tool && !ended) text += eventText(event, style);
  }
  if (run.truth && run.truth->clearance) text += clearanceText(*run.truth->clearance, truthStyle);
  if (run.truth) text += nearEndsText(run.truth->nearEnds, truthStyle);
  if (run.truth) text += diagnosesText(*run.truth, truthStyle);
  if (!where.empty()) where = fmt::format("  ({})", where);
  const records::TouchCount touches = records::countTouches(journal);
  std::string touchText = style.counted("touches", touches.touched);
  if (touches.failed > 0)
    touchText =
        style.text("sumTouches", {{"touches", touchText}, {"failed", style.counted("failedAttempts", touches.failed)}});
  text += outcome(journal, run, cause, style) + where + "\n";
  return text +
         style.text("sumTotals",
                    {{"cycles", style.counted("cycles", journal.cycles.size())},
                     {"touches", touchText},
                     {"path", distance(run.totalPathLength)},
                     {"time", duration(run.totalSeconds, style)},
                     {"alarms", alarms == 0 ? style.text("sumNoAlarms") : style.counted("alarms", alarms)}}) +
         "\n";
}

}  // namespace probewright::reports
