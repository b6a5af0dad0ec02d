#include "reports/summary.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "records/sample_run.hpp"
#include "reports/truth_summary.hpp"

namespace probewright::reports {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// The second event of `journal`, another one.
template <class Change>
void changeEvent(control::Journal& journal, Change change) {
  std::vector<control::EventRecord> events(journal.events.begin(), journal.events.end());
  change(events.at(1));
  journal.events.clear();
  for (const auto& event : events)
    journal.events.push_back(event);
}

TEST(Summary, TellsEachCycleWithItsLineResultsAndChanges) {
  const std::string text = summaryText(sample::journal(), sample::runInfo());
  EXPECT_THAT(text, StartsWith("BEARING_BLOCK.H, TNC640, 3-axis mill, Bearing block\n"));
  EXPECT_THAT(text, HasSubstr("  1  400 Basic rotation  (line 8)\n"));
  EXPECT_THAT(text, ContainsRegex("Q150 +actual value of the rotation angle +1\\.5008 deg\n"));
  EXPECT_THAT(text, HasSubstr("      -> PRESET.PR row 5, column SPC: +0.0000 -> +1.5008\n"));
  EXPECT_THAT(text, HasSubstr("  4  421 Measure a hole  (line 43)  OK\n"));
  EXPECT_THAT(text,
              ContainsRegex("Q153 +actual value, diameter +30\\.0119 mm +deviation \\+0\\.0119 +\\[30\\.0000 \\.\\. "
                            "30\\.0210\\]  OK\n"));
  EXPECT_THAT(text,
              ContainsRegex("Q155 .* 80\\.0541 mm +deviation \\+0\\.0541 +\\[79\\.9700 \\.\\. 80\\.0300\\]  REWORK\n"));
  EXPECT_THAT(text, HasSubstr("      log TCHPR421.TXT\n"));
  EXPECT_THAT(text, HasSubstr("      +------------------------------\n"
                              "      | Measuring log 424\n"
                              "      | Side length in minor axis:   80.0541\n"
                              "      +------------------------------\n"));
  EXPECT_THAT(text, HasSubstr("  by the program itself\n      -> PRESET.PR active row: 0 -> 5\n"));
  EXPECT_THAT(text, HasSubstr("  message  BORE 30.012 / WIDTH 80.054  (line 60)\n"));
  EXPECT_THAT(text, EndsWith("OUT OF TOLERANCE: 1 of 5 toleranced values\n"
                             "5 cycles, 15 touches, path 2.31 m, time 1 min 35 s, no alarms\n"));
  EXPECT_THAT(text, Not(HasSubstr("\x1b")));
}

TEST(Summary, ShowsTheInchesOfAProgramInInches) {
  records::RunInfo run = sample::runInfo();
  run.inches = true;
  const std::string text = summaryText(sample::journal(), run);
  // 30.0119 mm, 0.0119 mm above, between 30.0000 mm and 30.0210 mm
  EXPECT_THAT(text, ContainsRegex("Q153 +actual value, diameter +1\\.18157 in +deviation \\+0\\.00047 +\\[1\\.18110 "
                                  "\\.\\. 1\\.18193\\]  OK\n"));
  EXPECT_THAT(text, ContainsRegex("Q150 +actual value of the rotation angle +1\\.5008 deg\n"));
}

TEST(Summary, NamesTheAlarmOnce) {
  auto journal = sample::alarmJournal();
  journal.cycles.back().alarm = "Touch point inaccessible: no contact within the measuring path of 10 mm";
  const std::string text = summaryText(journal, sample::alarmRunInfo());
  EXPECT_THAT(text, HasSubstr("  3  412 Preset at the centre of a hole  (line 27)  ALARM\n"));
  EXPECT_THAT(text,
              EndsWith("STOPPED: Touch point inaccessible: no contact within the measuring path of 10 mm  (line 27)\n"
                       "3 cycles, 4 touches and 1 failed attempt, path 640 mm, time 33.7 s, 1 alarm\n"));
  EXPECT_EQ(text.find("no contact"), text.rfind("no contact"));
}

TEST(Summary, LeavesOutTheReasonThatWasTold) {
  const std::string text = summaryText(sample::alarmJournal(), sample::alarmRunInfo(), Colour::Off, Cause::Told);
  EXPECT_THAT(text, HasSubstr("\nSTOPPED  (line 27)\n"));
  EXPECT_THAT(text, Not(HasSubstr("no contact")));
}

TEST(Summary, NamesAnAlarmThatDidNotEndTheRun) {
  auto journal = sample::journal();
  journal.events.push_back({control::EventKind::Alarm, {}, "65000", "a message of the program", 1});
  EXPECT_THAT(summaryText(journal, sample::runInfo()), HasSubstr("  ALARM  65000: a message of the program\n"));
}

TEST(Summary, SaysOkOnlyWhenAllIsWithinTheLimits) {
  auto journal = sample::journal();
  auto run = sample::runInfo();
  run.exit = records::ExitState::Good;
  EXPECT_THAT(summaryText(journal, run), HasSubstr("\nOUT OF TOLERANCE"));
  journal.cycles.pop_back();
  EXPECT_THAT(summaryText(journal, run), HasSubstr("\nOK: all 3 toleranced values are within the limits\n"));
  journal.cycles.pop_back();
  EXPECT_THAT(summaryText(journal, run), HasSubstr("\nOK: the program ran to its end, nothing had a tolerance\n"));
}

TEST(Summary, ColoursVerdictsOnRequest) {
  const std::string text = summaryText(sample::journal(), sample::runInfo(), Colour::On);
  EXPECT_THAT(text, HasSubstr("\x1b[1;32mOK\x1b[0m"));
  EXPECT_THAT(text, HasSubstr("\x1b[1;33mREWORK\x1b[0m"));
}

TEST(Summary, KeepsControlCharactersFromTheTerminal) {
  auto journal = sample::journal();
  changeEvent(journal, [](auto& event) { event.text = "beep\x07\x1b[2Jgone\nnext \xC2\x9B"; });
  EXPECT_THAT(summaryText(journal, sample::runInfo()), HasSubstr("beep  [2Jgone next    (line 60)\n"));
}

TEST(Summary, ReadsOldTextsOfAProgramInAscii) {
  auto journal = sample::journal();
  changeEvent(journal, [](auto& event) {
    event.text =
        "Gr\xF6\xDF"
        "e 1.23";
  });
  EXPECT_THAT(summaryText(journal, sample::runInfo()), HasSubstr("Gr\xC3\xB6\xC3\x9F"
                                                                 "e 1.23  (line 60)\n"));
}

TEST(Summary, ShowsOfAStopItsFirstLine) {
  auto journal = sample::journal();
  changeEvent(journal, [](auto& event) {
    event.kind = control::EventKind::Stop;
    event.text = "Measuring log 424\nSide length";
  });
  EXPECT_THAT(summaryText(journal, sample::runInfo()), HasSubstr("Measuring log 424 ...  (line 60)\n"));
}

TEST(Summary, NamesTheSubprogramOfACycle) {
  auto journal = sample::journal();
  journal.cycles[0].place = {"subs/ALIGN.H", 4, 1};
  EXPECT_THAT(summaryText(journal, sample::runInfo()), HasSubstr("  1  400 Basic rotation  (ALIGN.H:4)\n"));
}

TEST(Summary, KeepsACycleWithoutTolerancesShort) {
  control::Journal journal;
  journal.cycles.emplace_back();
  for (int i = 0; i < 20; ++i)
    journal.cycles[0].results.push_back(sample::plain(fmt::format("R{}", i), "", i));
  const std::string text = summaryText(journal, {});
  EXPECT_THAT(text, HasSubstr("R5 "));
  EXPECT_THAT(text, Not(HasSubstr("R6 ")));
}

TEST(Summary, ShowsTheAnglesOfAPlane) {
  control::Journal journal;
  journal.cycles.push_back(sample::cycle("431", "MEASURE PLANE", 0, 1, 1));
  journal.cycles[0].results = {sample::plain("Q158", "projection angle of the A axis", 0.5, "deg"),
                               sample::plain("Q172", "space angle C", -0.25, "deg"),
                               sample::plain("Q173", "first touch in the touch probe axis", -1.4)};
  journal.cycles[0].results[2].nominal = 0;
  journal.cycles[0].results[2].deviation = -1.4;
  const std::string text = summaryText(journal, {});
  EXPECT_THAT(text, HasSubstr("Q158 "));
  EXPECT_THAT(text, HasSubstr("Q172 "));
  EXPECT_THAT(text, Not(HasSubstr("Q173 ")));
}

TEST(Summary, SurvivesAnEmptyRunAndNumbersThatAreNone) {
  EXPECT_THAT(summaryText({}, {}), HasSubstr("0 cycles, 0 touches, path 0 mm, time 0.0 s, no alarms\n"));
  control::Journal journal;
  journal.cycles.emplace_back();
  journal.cycles[0].results = {sample::plain("Q1", "", std::numeric_limits<double>::quiet_NaN())};
  EXPECT_THAT(summaryText(journal, {}), HasSubstr("not a number"));
}

/// A table's numbers in the order of the table, up to eight; of more the eight that are wrong most.
TEST(TruthSummary, NamesEightNumbersOfAnEntry) {
  const TruthStyle style{.line = [](const std::string& text) { return text; }, .place = {}};
  const auto namesOf = [&](int count) {
    records::EntryTruth entry;
    entry.name = "axis C";
    entry.distance = 0.1;
    for (int i = 1; i <= count; ++i)
      entry.values.push_back({fmt::format("P{}", i), "mm", 10, 10 + 0.01 * i});
    records::Truth truth;
    truth.entries.push_back(entry);
    const std::string text = entriesText(truth, style);
    std::map<std::size_t, int> places;
    for (int i = 1; i <= count; ++i)
      if (const std::size_t at = text.find(fmt::format("P{} ", i)); at != std::string::npos) places[at] = i;
    std::vector<int> names;
    for (const auto& [at, name] : places)
      names.push_back(name);
    return std::pair(names, text.find("...") != std::string::npos);
  };
  EXPECT_EQ(namesOf(8), std::pair(std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}, false));
  EXPECT_EQ(namesOf(9), std::pair(std::vector<int>{9, 8, 7, 6, 5, 4, 3, 2}, true));
}

/// Without a limit the nearest approach is told; with one only what came nearer than that.
TEST(Summary, TellsTheNearestApproach) {
  const TruthStyle style{.line = [](const std::string& text) { return text; },
                         .place = [](const SourcePlace& place) { return place.file; }};
  records::Clearance clearance;
  for (const double distance : {7.0, 2.0, 5.0}) {
    records::ClearanceSpan span;
    span.distance = distance;
    span.part = "stylus";
    span.solid = "vice";
    clearance.spans.push_back(span);
  }
  EXPECT_THAT(clearanceText(clearance, style), AllOf(HasSubstr("2.0 mm"), HasSubstr("vice"), Not(HasSubstr("5.0"))));
  clearance.limit = 6;
  EXPECT_THAT(clearanceText(clearance, style), AllOf(HasSubstr("2.0 mm"), HasSubstr("5.0 mm"), Not(HasSubstr("7.0"))));
  clearance.limit = 1;
  EXPECT_EQ(clearanceText(clearance, style), "");
}

}  // namespace
}  // namespace probewright::reports
