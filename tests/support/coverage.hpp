#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include "control/control_kind.hpp"
#include "control/journal.hpp"
#include "cycles/catalogue.hpp"

/// What the running test has done with which cycle on which control, noted as properties of the test: the benches call
/// this, tests do not. `scripts/coverage-table` makes the table of docs/coverage.md of the properties of tests that
/// passed.
///
/// A cycle "runs" if it ended without an alarm. Its results, table writes, logs and refusals count as compared when a
/// test has read that very result, that very table, log or alarm from the bench after a run in which the cycle left it;
/// what was left but never read has the mark "left".
namespace probewright::testing_support::coverage {

using control::ControlKind;
using control::CycleRecord;
using control::Journal;

inline void note(ControlKind control, std::string_view cycle, std::string_view what) {
  static const testing::TestInfo* noted = nullptr;
  static std::set<std::string> seen;
  const testing::TestInfo* running = testing::UnitTest::GetInstance()->current_test_info();
  if (running == nullptr) return;
  if (running != noted) {
    noted = running;
    seen.clear();
  }
  std::string key = "covers ";
  for (const std::string_view part :
       {control::name(control), std::string_view(" "), cycle, std::string_view(" "), what})
    key += part;
  if (seen.insert(key).second) testing::Test::RecordProperty(key, "yes");
}

/// What the cycles of a run from record `first` on did and left.
inline void noteRun(ControlKind control, const Journal& journal, std::size_t first = 0) {
  for (std::size_t i = first; i < journal.cycles.size(); ++i) {
    const CycleRecord& cycle = journal.cycles[i];
    note(control, cycle.name, "parsed");
    note(control, cycle.name, cycle.alarm.empty() ? "runs" : "refusals left");
    if (!cycle.results.empty()) note(control, cycle.name, "results left");
    if (!cycle.writes.empty()) note(control, cycle.name, "writes left");
    if (!cycle.logFiles.empty() || !cycle.screens.empty()) note(control, cycle.name, "log left");
  }
}

inline bool leaves(ControlKind control, const CycleRecord& cycle, std::string_view result) {
  const auto named = [&](const auto& each) { return each.name == result; };
  if (std::ranges::any_of(cycle.results, named)) return true;
  const cycles::CycleDefinition* definition = control::onBothTNC.contains(control)
                                                  ? cycles::heidenhainCycle(std::atoi(cycle.name.c_str()))
                                                  : cycles::sinumerikCycle(cycle.name);
  return definition != nullptr && std::ranges::any_of(definition->results, named);
}

/// A test reads a result by its name: it belongs to the last cycle that left it and ended well.
inline void resultRead(ControlKind control, const Journal& journal, std::string_view result) {
  for (std::size_t i = journal.cycles.size(); i-- > 0;) {
    if (!leaves(control, journal.cycles[i], result)) continue;
    note(control, journal.cycles[i].name, "results");
    return;
  }
}

/// A test reads entries of a table: those of all cycles whose writes `matches` accepts.
template <class Matches>
void writesRead(ControlKind control, const Journal& journal, const Matches& matches) {
  for (const CycleRecord& cycle : journal.cycles) {
    if (std::ranges::any_of(cycle.writes, matches)) note(control, cycle.name, "writes");
  }
}

/// A test reads a log file, or with an empty name what was on the screen.
inline void logRead(ControlKind control, const Journal& journal, const std::string& file) {
  for (const CycleRecord& cycle : journal.cycles) {
    const bool left = file.empty() ? !cycle.screens.empty() : std::ranges::count(cycle.logFiles, file) > 0;
    if (left) note(control, cycle.name, "log");
  }
}

/// A test reads what the run ended with: the refusal of the cycle that ended with an alarm, otherwise that of the last
/// call (`word` and a number or name behind it, "TCH PROBE 421", "CYCLE977") up to the line of `place`.
inline void refusalRead(ControlKind control, const Journal& journal, const SourcePlace& place, std::string_view text,
                        std::string_view word) {
  if (!journal.cycles.empty() && !journal.cycles.back().alarm.empty()) {
    note(control, journal.cycles.back().name, "refusals");
    return;
  }
  std::uint64_t line = 1;
  std::size_t end = 0;
  while (end < text.size() && line <= place.line)
    line += text[end++] == '\n' ? 1 : 0;
  const std::size_t call = text.substr(0, end).rfind(word);
  if (call == std::string_view::npos || place.line == 0) return;
  std::size_t digits = call + word.size();
  while (digits < text.size() && text[digits] == ' ')
    ++digits;
  std::size_t last = digits;
  while (last < text.size() && std::isdigit(static_cast<unsigned char>(text[last])) != 0)
    ++last;
  const std::string number(text.substr(digits, last - digits));
  if (number.empty()) return;
  note(control, control::onBothTNC.contains(control) ? number : std::string(word) + number, "refusals");
}

/// A program was checked as a whole: its calls (numbers behind `word`) are read, if nothing is wrong with it.
inline void noteRead(ControlKind control, std::string_view text, const Diagnostics& mistakes, std::string_view word) {
  if (!mistakes.empty()) return refusalRead(control, {}, mistakes.front().place, text, word);
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const int number = std::atoi(std::string(text.substr(at + word.size(), 8)).c_str());
    const std::string name =
        control::onBothTNC.contains(control) ? std::to_string(number) : fmt::format("{}{}", word, number);
    note(control, name, "parsed");
  }
}

}  // namespace probewright::testing_support::coverage
