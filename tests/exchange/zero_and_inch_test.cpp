#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cycles_kinematics/sphere_worlds.hpp"
#include "exchange/formats.hpp"
#include "records/results.hpp"
#include "reports/summary.hpp"
#include "support/lathe_bench.hpp"

/// Numbers that are easily written wrong: zeros that come out negative, and numbers without a unit in programs that
/// count in inches.
namespace probewright {
namespace {

using namespace testing_support;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// "-0", "-0.000", "-0.0e3" as a number of their own.
const char* const negativeZero = "(^|[^0-9A-Za-z.+-])-0(\\.0*)?($|[^0-9.])";

/// All that people and programs read of a run.
std::string allTexts(const session::RunOutcome& outcome) {
  std::string all = reports::summaryText(outcome.journal, outcome.info);
  all += records::resultsText(outcome.journal, outcome.info);
  const auto inspection = exchange::inspectionOf(outcome.journal, outcome.info);
  for (const exchange::Format& format : exchange::formats()) {
    if (format.name == "xlsx") continue;
    const auto text = format.write(inspection);
    EXPECT_TRUE(text) << format.name;
    if (text) all += *text;
  }
  for (const auto& [name, text] : outcome.files)
    all += text;
  for (const auto& cycle : outcome.journal.cycles)
    for (const std::string& screen : cycle.screens)
      all += screen;
  return all;
}

TEST(NegativeZero, IsNowhereInWhatARunLeaves) {
  // A tool of exactly the length that is believed, measured twice into the wear: the second difference is a rounding
  // error below nothing. A preset set where it is.
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup(R"(seed = 1
[machine]
name = "lathe2c"
[control]
type = "840Dsl"
[tool_probe]
size = [20, 20]
thickness = 20
stem_diameter = 6
pose = { x = 150, y = 10, z = 300, a = -90 }
[[tool]]
number = 3
name = "FINISH"
kind = "turn"
length = 60
radius = 0.4
shank_direction = [1, 0, 0]
mount = [-20, 0, -40]
[tool.cutter.insert]
nose_radius = 0.4
edge_normals = [-85, -185]
orientation = 90
edge_length = 8
[parameters]
"$TC_DP12[3,1]" = 0.1
"$TC_DP13[3,1]" = -0.1
)",
                                       "lathe.toml", diagnostics);
  ASSERT_TRUE(setup) << format(diagnostics.front());
  const auto run = setup::runText("T.MPF",
                                  "G18 G90 G94 DIAMOF\nT=\"FINISH\" D1\nG0 Z340\nG0 X185\n"
                                  "CYCLE982(2,1,1,,,,5,1,,,,0,0.5)\nCYCLE982(2,1,1,,,,5,1,,,,0,0.5)\n"
                                  "R1=-0.0\nMSG(\"R1 \"<<R1<<\" \"<<-1.0*R2)\n"
                                  "$TC_DP12[3,1]=-0.000000001\n$TC_DP13[3,1]=-0.0\nM30\n",
                                  *setup, session::RunOptions());
  ASSERT_TRUE(run.outcome.diagnostics.empty()) << format(run.outcome.diagnostics.front());
  ASSERT_EQ(run.outcome.result.end, execution::RunEnd::Finished) << format(run.outcome.result.diagnostics.front());
  ASSERT_FALSE(run.outcome.journal.cycles.front().writes.empty());
  EXPECT_EQ(run.outcome.journal.cycles.front().writes.front().after, "0");
  EXPECT_THAT(allTexts(run.outcome), Not(ContainsRegex(negativeZero)));
}

TEST(NegativeZero, IsNoNumberOfJson) {
  control::Journal journal;
  control::CycleRecord cycle;
  cycle.name = "421";
  control::ResultRecord result;
  result.name = "Q151";
  result.unit = "mm";
  result.kind.role = control::Role::Actual;
  result.value = -0.0;
  result.nominal = result.deviation = -0.0;
  cycle.results.push_back(result);
  control::TouchRecord touch;
  touch.outcome = "touched";
  touch.surface = Vector3(-0.0, 1, -0.0);
  cycle.touches.push_back(touch);
  journal.cycles.push_back(cycle);
  session::RunOutcome outcome;
  outcome.journal = journal;
  EXPECT_THAT(allTexts(outcome), Not(ContainsRegex(negativeZero)));
}

/// Where an axis was not measured, Q141 to Q146 are -1. That is no length: an inch program has the same.
TEST(InchProgram, HasMinusOneWhereAnAxisWasNotMeasured) {
  Dice dice(4521);
  SphereWorld world(builds()[0]);
  world.plant(dice, 0.1, 0);
  const Build build = world.build;
  Build onlyC = build;
  onlyC.axes.erase('A');
  for (const int cycle : {451, 452}) {
    const auto words = [&](const char* unit) {
      Words all = words451(onlyC, 0);
      if (std::string(unit) == "INCH") all = with(all, {{407, sphereRadius / 25.4}, {253, 200}});
      if (cycle == 452) std::erase_if(all, [](const auto& word) { return word.first == 406 || word.first == 431; });
      return all;
    };
    const Ran plain = world.bench.run(probe(cycle, words("MM")));
    const Ran inches = world.bench.run(probe(cycle, words("INCH")), "INCH");
    ASSERT_TRUE(ended(plain)) << plain.why();
    ASSERT_TRUE(ended(inches)) << inches.why();
    SCOPED_TRACE(cycle);
    // A and B were not measured; with Q406 = 0 nothing is optimised either.
    for (const int number : {141, 142, 144, 145})
      EXPECT_EQ(inches.q(number), -1) << number;
    if (cycle == 451) {
      EXPECT_EQ(inches.q(146), -1);
    }
    EXPECT_NEAR(inches.q(143), plain.q(143), 1e-6);
    EXPECT_GT(inches.q(143), 1e-4);
    for (int number = 147; number <= 149; ++number)
      EXPECT_NEAR(inches.q(number), plain.q(number), 1e-6);
    const auto results = nlohmann::json::parse(records::resultsText(inches.outcome.journal, inches.outcome.info));
    int seen = 0;
    for (const auto& each : results["cycles"].back()["results"]) {
      const std::string name = each["name"];
      if (name != "Q141" && name != "Q142" && name != "Q144" && name != "Q145") continue;
      ++seen;
      EXPECT_EQ(each["value"], -1) << name;
      EXPECT_EQ(each["unit"], "") << name;
    }
    EXPECT_EQ(seen, 4);
    EXPECT_THAT(allTexts(inches.outcome), Not(HasSubstr("-0.039")));
    // What is not measured is no characteristic of an inspection.
    for (const exchange::Row& row : exchange::inspectionOf(inches.outcome.journal, inches.outcome.info).rows)
      EXPECT_NE(row.actual, -1) << row.result;
  }
}

}  // namespace
}  // namespace probewright
