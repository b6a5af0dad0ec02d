#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "support/sinumerik_bench.hpp"

/// Result screens and measuring logs: a hole of 40.012 mm, nominal 40, centre 0.05 and -0.02 off.
namespace probewright::testing_support {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double diameter = 40.012;

class HoleBench : public SinumerikBench {
public:
  HoleBench() : SinumerikBench(world()) {
    plantFrame(*this, "$P_UIFR", 1, {0, 0, -400});
    control.programPath = "PART.MPF";
    control.wallClockStart = 1353499200;  // 21 November 2012, 12:00:00
  }

private:
  static simulation::Truth world() {
    simulation::Truth truth = perfectWorld();
    place(truth, simulation::Ring(diameter / 2, 60, -40), Pose(Eigen::Translation3d(0.05, -0.02, -400)));
    return truth;
  }
};

const NamedNumbers hole = {{"S_MVAR", 1}, {"S_PRNUM", 1}, {"S_SETV", 40}, {"S_FA", 2}, {"S_TSA", 1}, {"S_NMSP", 1}};

void measure(SinumerikBench& bench, const NamedNumbers& changes = {}) {
  bench.start({0, 0, -10});
  bench.run("CYCLE977", with(hole, changes));
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line + ";");
  for (std::string field; std::getline(stream, field, ';');)
    fields.push_back(field);
  return fields;
}

/// The words of the line that begins with `label`.
std::vector<std::string> valuesBehind(const std::string& text, const std::string& label) {
  for (const std::string& line : linesOf(text)) {
    if (!line.starts_with(label)) continue;
    std::istringstream stream(line.substr(label.size()));
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
      words.push_back(word);
    return words;
  }
  return {};
}

TEST(ResultScreen, ComesAsTheSettingDataSays) {
  HoleBench bench;
  measure(bench);
  EXPECT_EQ(bench.screen(), "");
  bench.set("$SCS_MEA_RESULT_DISPLAY", {}, 1);
  measure(bench);
  EXPECT_THAT(bench.screen(), HasSubstr("CYCLE977"));
  EXPECT_THAT(bench.screen(), HasSubstr("S_MVAR = 1"));
  EXPECT_THAT(valuesBehind(bench.screen(), "diameter of the hole [mm]"), ElementsAre("40.0000", "40.0120", "0.0120"));
  EXPECT_THAT(valuesBehind(bench.screen(), "centre, 1st axis [mm]"), ElementsAre("0.0000", "0.0500", "0.0500"));
  EXPECT_THAT(valuesBehind(bench.screen(), "centre, 2nd axis [mm]"), ElementsAre("0.0000", "-0.0200", "-0.0200"));
  EXPECT_THAT(valuesBehind(bench.screen(), "safe area"), ElementsAre("1"));
  EXPECT_THAT(valuesBehind(bench.screen(), "probe number"), ElementsAre("1"));
  EXPECT_THAT(valuesBehind(bench.screen(), "tool"), ElementsAre("T", "PROBE", "D1"));
  const auto stops = [&] {
    return std::ranges::count(bench.control.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
  };
  EXPECT_EQ(stops(), 0);
  bench.set("$SCS_MEA_RESULT_DISPLAY", {}, 3);
  measure(bench);
  EXPECT_NE(bench.screen(), "");
  EXPECT_EQ(stops(), 1);
  bench.set("$SCS_MEA_RESULT_DISPLAY", {}, 4);
  measure(bench);
  EXPECT_EQ(bench.screen(), "");
  EXPECT_EQ(stops(), 1);
  // Outside the safe area the alarm brings the screen, with what was measured until then.
  bench.start({0, 0, -10});
  EXPECT_EQ(bench.alarmOf("CYCLE977", with(hole, {{"S_TSA", 0.001}})), "61303");
  EXPECT_THAT(bench.screen(), HasSubstr("61303"));
  EXPECT_EQ(stops(), 2);
}

/// CYCLE150 decides instead of the setting data: S_PICT 0 is off, the tens say how.
TEST(ResultScreen, IsTurnedOnAndOffByCycle150) {
  const struct {
    double setting, picture;
    bool shown, waits;
  } cases[] = {{1, 0, false, false}, {0, 1, true, false}, {3, 11, true, false}, {0, 31, true, true}};
  for (const auto& each : cases) {
    SCOPED_TRACE(each.picture);
    HoleBench bench;
    bench.set("$SCS_MEA_RESULT_DISPLAY", {}, each.setting);
    bench.run("CYCLE150", {{"S_PICT", each.picture}});
    measure(bench);
    EXPECT_EQ(bench.screen() != "", each.shown);
    const auto isStop = [](const control::EventRecord& event) { return event.kind == control::EventKind::Stop; };
    EXPECT_EQ(std::ranges::any_of(bench.control.journal.events, isStop), each.waits);
  }
}

TEST(ResultScreen, NamesWhatWasCorrected) {
  HoleBench bench;
  bench.control.panel.showAllResults = true;
  measure(bench, {{"S_MVAR", 101}, {"S_KNUM", 1}});
  EXPECT_THAT(valuesBehind(bench.screen(), "corrected").front(), HasSubstr("$P_UIFR[1,X,"));
}

TEST(MeasuringLog, IsWrittenAsText) {
  HoleBench bench;
  bench.run("CYCLE150", {{"S_PICT", 0}, {"S_PROT", 1}}, {{"S_PATH", "/_N_WKS_DIR/holes.log"}});
  measure(bench);
  measure(bench);
  const std::string text = bench.log("holes.TXT");
  const auto lines = linesOf(text);
  ASSERT_GT(lines.size(), 6U);
  EXPECT_THAT(lines[1], ::testing::MatchesRegex("Date: 2012-11-21   Time: 12:0[0-9]:[0-9][0-9]"));
  EXPECT_EQ(lines[2], "Program: PART.MPF");
  EXPECT_EQ(lines[3], "Log: holes.TXT");
  EXPECT_TRUE(lines[5].starts_with("1  CYCLE977  "));
  EXPECT_THAT(text, HasSubstr("\n2  CYCLE977  "));
  EXPECT_THAT(valuesBehind(text, "centre, 2nd axis [mm]"), ElementsAre("0.0000", "-0.0200", "-0.0200"));
  EXPECT_THAT(text, HasSubstr("Probe number: 1   T PROBE D1"));
}

TEST(MeasuringLog, IsWrittenAsTable) {
  HoleBench bench;
  bench.run("CYCLE150", {{"S_PROT", 101}}, {{"S_PATH", "holes"}});
  measure(bench);
  const auto lines = linesOf(bench.log("holes.CSV"));
  ASSERT_EQ(lines.size(), 4U) << "a heading, the diameter and both coordinates of the centre";
  const auto heading = fieldsOf(lines[0]);
  const auto column = [&](const std::string& line, const std::string& name) {
    const auto found = std::ranges::find(heading, name);
    EXPECT_NE(found, heading.end()) << name;
    return fieldsOf(line)[static_cast<std::size_t>(found - heading.begin())];
  };
  for (const std::string& line : lines)
    EXPECT_EQ(fieldsOf(line).size(), heading.size()) << line;
  EXPECT_EQ(column(lines[1], "Cycle"), "CYCLE977");
  EXPECT_EQ(column(lines[1], "Variant"), "1");
  EXPECT_EQ(column(lines[1], "Setpoint"), "40.0000");
  EXPECT_EQ(column(lines[1], "Measured"), "40.0120");
  EXPECT_EQ(column(lines[1], "Difference"), "0.0120");
  EXPECT_EQ(column(lines[1], "Unit"), "mm");
  EXPECT_EQ(column(lines[2], "Value"), "centre, 1st axis");
  EXPECT_EQ(column(lines[2], "Measured"), "0.0500");
  EXPECT_EQ(column(lines[2], "Date"), "2012-11-21");
  // An alarm is logged too, and what was measured before it.
  bench.start({0, 0, -10});
  EXPECT_EQ(bench.alarmOf("CYCLE977", with(hole, {{"S_TSA", 0.001}})), "61303");
  EXPECT_THAT(column(linesOf(bench.log("holes.CSV")).back(), "Alarm"), HasSubstr("61303"));
}

/// A field with a separator or a quotation mark is quoted, and what is quoted in it is doubled (RFC 4180).
TEST(MeasuringLog, QuotesFieldsOfTheTable) {
  HoleBench bench;
  bench.control.programPath = "A;\"B\".MPF";
  bench.run("CYCLE150", {{"S_PROT", 101}}, {{"S_PATH", "holes"}});
  measure(bench);
  EXPECT_THAT(bench.log("holes.CSV"), HasSubstr(";\"A;\"\"B\"\".MPF\";"));
}

TEST(MeasuringLog, BeginsEndsAndGoesOnAsCycle150Says) {
  HoleBench bench;
  const auto entries = [&](const std::string& file) {
    const std::string text = bench.log(file);
    std::size_t count = 0;
    for (std::size_t at = text.find("CYCLE977"); at != std::string::npos; at = text.find("CYCLE977", at + 1))
      ++count;
    return count;
  };
  const auto setLog = [&](int code, const char* file) {
    bench.run("CYCLE150", {{"S_PROT", code}}, {{"S_PATH", file}});
  };
  setLog(1, "A");
  measure(bench);
  setLog(0, "");
  measure(bench);
  EXPECT_EQ(entries("A.TXT"), 1U);
  setLog(1001, "A");
  measure(bench);
  EXPECT_EQ(entries("A.TXT"), 2U);
  setLog(1, "A");
  measure(bench);
  EXPECT_EQ(entries("A.TXT"), 1U);
  setLog(0, "");
  measure(bench);
  setLog(2, "B");
  measure(bench);
  EXPECT_EQ(entries("B.TXT"), 1U);
  setLog(1, "");
  measure(bench);
  EXPECT_EQ(entries("MEASPROT.TXT"), 1U);
}

TEST(MeasuringLog, GoesOnCountingWhereAnotherLogCameBetween) {
  HoleBench bench;
  for (const auto& [code, file, numbers] :
       {std::tuple{1, "A.TXT", std::vector<std::string>{"1", "2", "3"}},
        std::tuple{101, "A.CSV", std::vector<std::string>{"1", "1", "1", "2", "2", "2", "3", "3", "3"}}}) {
    const auto setLog = [&](int digits, const char* name) {
      bench.run("CYCLE150", {{"S_PROT", digits}}, {{"S_PATH", name}});
    };
    setLog(code, "A");
    measure(bench);
    measure(bench);
    setLog(code, "B");
    measure(bench);
    setLog(1000 + code, "A");
    measure(bench);
    std::vector<std::string> found;
    std::size_t headings = 0;
    for (const std::string& line : linesOf(bench.log(file))) {
      headings += line.starts_with("No;") || line.starts_with("Date:") ? 1 : 0;
      const std::size_t end = line.find_first_not_of("0123456789");
      if (end != 0 && end != std::string::npos) found.push_back(line.substr(0, end));
    }
    EXPECT_EQ(found, numbers) << file;
    EXPECT_EQ(headings, 1U);
  }
}

TEST(MeasuringLog, RefusesDigitsThatCycle150DoesNotHave) {
  HoleBench bench;
  for (const NamedNumbers& call :
       {NamedNumbers{{"S_PICT", 2}}, {{"S_PICT", 21}}, {{"S_PROT", 3}}, {{"S_PROT", 201}}, {{"S_PROT", 2001}}})
    EXPECT_EQ(bench.alarmOf("CYCLE150", call), "12150") << call.front().first << " " << call.front().second;
  EXPECT_EQ(bench.alarmOf("CYCLE150", {{"S_PICT", 41}, {"S_PROT", 1111}}), "");
}

}  // namespace
}  // namespace probewright::testing_support
