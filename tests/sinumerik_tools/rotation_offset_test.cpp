#include "cycles/sinumerik/rotation_offset.hpp"

#include <numbers>

#include "language/sinumerik/check.hpp"
#include "session/control_family.hpp"
#include "sinumerik_tools/tool_bench.hpp"

/// What a turning tool is measured too large or too small by, from SD 54690 to SD 54710.
namespace probewright {
namespace {

using namespace testing_support;
using cycles::sinumerik::rotationOffset;
using cycles::sinumerik::TurningDimension;

/// Rows and columns in any order: radii 5, 20 and speeds 10, 30 m/min, with the values r / 1000 + v / 10000.
template <class Set>
void enterTable(const std::string& table, const Set& set) {
  const auto put = [&](int row, int column, double value) {
    set(fmt::format("$SNS_MEA_RESULT_OFFSET_TAB_{}{}", table, row), column, value);
  };
  const double radii[] = {0, 20, 0, 5, 0}, speeds[] = {0, 0, 30, 0, 10, 0};
  for (int column = 1; column < 5; ++column)
    put(1, column, radii[column]);
  for (int row = 1; row < 6; ++row) {
    put(row + 1, 0, speeds[row]);
    for (int column = 1; column < 5; ++column)
      put(row + 1, column, radii[column] / 1000 + speeds[row] / 10000);
  }
}

TEST(RotationOffset, IsLinearWithinItsTableAndStaysAtTheBorder) {
  control::sinumerik::DataStore data;
  enterTable("RAD", [&](const std::string& name, int column, double value) { data.set(name, {column}, value); });
  const auto at = [&](double radius, double peripheral) {
    const double speed = peripheral * 1000 / (2 * std::numbers::pi * radius);
    return rotationOffset(data, TurningDimension::Radius, radius, speed);
  };
  EXPECT_NEAR(at(5, 10), 0.006, 1e-12);
  EXPECT_NEAR(at(20, 30), 0.023, 1e-12);
  EXPECT_NEAR(at(12, 17), 0.0137, 1e-12);
  EXPECT_NEAR(at(2, 5), 0.006, 1e-12);
  EXPECT_NEAR(at(40, 12), 0.0212, 1e-12);
  EXPECT_NEAR(at(10, 300), 0.013, 1e-12);
  EXPECT_EQ(rotationOffset(data, TurningDimension::Length, 10, 100), 0) << "that table is empty";
}

const NamedNumbers turning = {{"S_MVAR", 2}, {"S_PRNUM", 1}, {"S_FA", 3}, {"S_TSA", 2}};

ToolBench millBench() {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80, 8, 2);
  bench.believed(2).length = 79.9;
  bench.believed(2).radius = 8.05;
  return bench;
}

TEST(RotationOffset, IsAddedToWhatATurningToolMeasures) {
  for (const bool length : {true, false}) {
    ToolBench bench = millBench();
    const NamedNumbers call = with(turning, {{"S_MA", length ? 3 : 1}});
    const int actual = length ? 8 : 10;
    const double without = bench.measure(beside, call).ovr(actual);
    enterTable(length ? "LEN" : "RAD", [&](const std::string& name, int column, double value) {
      bench.datum(fmt::format("{}[{}]", name, column), value);
    });
    EXPECT_EQ(bench.measure(beside, call).ovr(actual), without) << "SD 54691 is 0";
    bench.datum("$SNS_MEA_T_PROBE_OFFSET", 2);
    const ToolRun ran = bench.measure(beside, call);
    // As delivered: 100 m/min, at most 1000 revolutions, the last touch at half the speed.
    const double added = ran.ovr(actual) - without, peripheral = 2 * std::numbers::pi * 8.05 * 500 / 1000;
    EXPECT_NEAR(added, 8.05 / 1000 + peripheral / 10000, 1e-9);
    EXPECT_NEAR(ran.written(length ? "$TC_DP3[2,1]" : "$TC_DP6[2,1]"), ran.ovr(actual), 1e-6);
    // A tool that stands is measured as it is.
    const NamedNumbers standing = with(call, {{"S_MVAR", 1}});
    ToolBench none = millBench();
    EXPECT_EQ(bench.measure(beside, standing).ovr(actual), none.measure(beside, standing).ovr(actual));
  }
}

TEST(RotationOffset, OfTheMakerIsNotKnown) {
  ToolBench bench = millBench();
  const NamedNumbers call = with(turning, {{"S_MA", 3}});
  const double without = bench.measure(beside, call).ovr(8);
  bench.datum("$SNS_MEA_T_PROBE_OFFSET", 1);
  const ToolRun ran = bench.measure(beside, call);
  EXPECT_EQ(ran.ovr(8), without);
  EXPECT_TRUE(ran.told("tables of the probe's maker (SD 54691 = 1) are not known here"));
  bench.datum("$SNS_MEA_T_PROBE_OFFSET", 3);
  EXPECT_TRUE(bench.measure(beside, call).told("= 3 is none of 0, 1 and 2"));
}

/// Known before the run, from the program and from the setup.
TEST(RotationOffset, ThatAddsNothingIsNamedByCheck) {
  const auto said = [](const std::string& value) {
    const auto program =
        language::sinumerik::SinumerikProgram::fromText("P.MPF", "$SNS_MEA_T_PROBE_OFFSET=" + value + "\nM30\n");
    const Diagnostics found = language::sinumerik::check(*program);
    EXPECT_TRUE(found.empty() || found.front().severity == Severity::Warning);
    return found.empty() ? std::string() : found.front().message;
  };
  EXPECT_EQ(said("0") + said("2") + said("R1"), "");
  EXPECT_NE(said("1").find("of the probe's maker"), std::string::npos);
  EXPECT_NE(said("3").find("none of 0, 1 and 2"), std::string::npos);
  ToolBench bench = millBench();
  const auto ofSetup = [&](double value) {
    bench.datum("$SNS_MEA_T_PROBE_OFFSET", value);
    Diagnostics found;
    const auto kind = control::ControlKind::Sinumerik840Dsl;
    session::knownFamilies().of(kind).inventory(bench.setup.beliefs, kind, found);
    EXPECT_FALSE(hasErrors(found));
    return found.size();
  };
  EXPECT_EQ(ofSetup(0) + ofSetup(2), 0U);
  EXPECT_EQ(ofSetup(1), 1U);
}

}  // namespace
}  // namespace probewright
