#include "control/heidenhain/turning_tool_table.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"
#include "session/heidenhain/beliefs.hpp"

/// What a cycle cannot carry out is refused before anything is touched.
namespace probewright::testing_support {
namespace {

namespace hh = control::heidenhain;

const Words hole = {{321, 0},  {322, 0}, {262, 40}, {325, 0}, {247, 90}, {261, -8}, {320, 0},
                    {260, 30}, {301, 1}, {305, 1},  {331, 0}, {332, 0},  {303, 1},  {381, 0}};
const Words inspection = {{273, 0}, {274, 0}, {262, 40}, {325, 0}, {247, 90}, {261, -8}, {320, 0}, {260, 30},
                          {301, 1}, {275, 0}, {276, 0},  {279, 0}, {280, 0},  {281, 0},  {309, 0}, {330, 0}};
const Words edge = {{263, -20}, {264, -30}, {265, 20}, {266, -30}, {272, 2}, {267, 1}, {261, -8},
                    {320, 0},   {260, 30},  {301, 1},  {312, 6},   {337, 1}, {305, 0}, {303, 0}};
const Words alignedHole = {{321, 0},  {322, 50}, {262, 40}, {325, 0}, {247, 90},
                           {261, -8}, {320, 0},  {260, 30}, {301, 1}, {337, 4}};
const Words corner = {{263, -30}, {264, -40}, {326, 0}, {296, -50}, {297, -20}, {327, 40}, {261, -8}, {320, 1},
                      {260, 30},  {301, 1},   {304, 0}, {305, 1},   {331, 0},   {332, 0},  {303, 1},  {381, 0}};

void expectUntouched(const Ran& ran, const std::string& code, const std::string& part) {
  EXPECT_EQ(ran.alarm(), code) << ran.why();
  EXPECT_NE(ran.why().find(part), std::string::npos) << ran.why();
  EXPECT_EQ(ran.touches(), 0U);
}

Bench benchOf(ControlKind kind, const std::string& machine = "mill3") {
  Bench bench(kind, machine);
  bench.preset(1, {0, 0, -400});
  return bench;
}

TEST(EarlyRefusals, OfToolsInQ330) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    expectUntouched(benchOf(kind).run(probe(421, with(inspection, {{330, 77}}))), "Tool not defined", "77");
    const Words pocket = {{273, 0}, {274, 0}, {282, 60}, {283, 40}, {261, -8}, {320, 0}, {260, 30}, {301, 1}, {284, 0},
                          {285, 0}, {286, 0}, {287, 0},  {279, 0},  {280, 0},  {281, 0}, {309, 0},  {330, 77}};
    expectUntouched(benchOf(kind).run(probe(423, pocket)), "Tool not defined", "77");
  }
  Bench bench = benchOf(ControlKind::TNC640);
  const TableFolder folder(bench);
  hh::TypedTable tools = hh::defaultToolTable(ControlKind::TNC640);
  ASSERT_TRUE(tools.setText("7", "TYP", "TURN"));
  folder.put("TOOL.T", tools);
  expectUntouched(bench.run(probe(421, with(inspection, {{330, 7}}))), "Cycle parameter wrong", "Q498 or Q531");
  expectUntouched(bench.run(probe(421, with(inspection, {{330, 7}, {498, 0}, {531, 0}}))), "Tool not defined",
                  "TOOLTURN.TRN");
}

TEST(EarlyRefusals, OfLockedRowsAndMissingDatumTables) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench = benchOf(kind, "mill5-table-table");
    expectUntouched(bench.run(probe(403, edge)), "Datum table not selected", "Q337 = 1 with Q303 = 0");
    const Ran circle = bench.run(probe(405, alignedHole));
    expectUntouched(circle, "Datum table not selected", "Q337 = 4");
    EXPECT_EQ(circle.why().find("Q303"), std::string::npos) << "405 has no Q303";
  }
  Bench bench = benchOf(ControlKind::TNC640);
  const TableFolder folder(bench);
  hh::TypedTable presets = hh::defaultPresetTable(ControlKind::TNC640);
  ASSERT_TRUE(presets.ensureRow("1"));
  ASSERT_TRUE(presets.setNumber("1", "Z", -400));
  ASSERT_TRUE(presets.setText("1", "LOCKED", "1"));
  folder.put("PRESET.PR", presets);
  bench.setup.beliefs.presets.clear();
  const std::string active = "CYCL DEF 247 PRESET ~\n  Q339=1 ;NUMBER\n";
  expectUntouched(bench.run(active + probe(412, hole)), "Preset locked", "Row 1");
  expectUntouched(bench.run(active + probe(400, {{263, -20},
                                                 {264, -30},
                                                 {265, 20},
                                                 {266, -30},
                                                 {272, 2},
                                                 {267, 1},
                                                 {261, -8},
                                                 {320, 0},
                                                 {260, 30},
                                                 {301, 1},
                                                 {307, 0},
                                                 {305, 1}})),
                  "Preset locked", "Row 1");
}

TEST(EarlyRefusals, OfPointsThatTellNothing) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    expectUntouched(benchOf(kind).run(probe(414, corner)), "Corner not determined", "Q326");
    expectUntouched(benchOf(kind).run(probe(414, with(corner, {{326, 40}, {327, 0}}))), "Corner not determined",
                    "Q327");
    const Words holes = {{268, 0},  {269, 0},  {270, 50}, {271, 0}, {316, 0}, {317, 0}, {318, 0},
                         {319, 50}, {261, -8}, {260, 30}, {305, 1}, {331, 0}, {332, 0}, {303, 1}};
    expectUntouched(benchOf(kind).run(probe(418, holes)), "Intersection not determined", "1 and 3");
    expectUntouched(benchOf(kind).run(probe(418, with(holes, {{316, 50}, {318, 50}, {319, 0}}))),
                    "Intersection not determined", "Holes 2 and 4");
    expectUntouched(benchOf(kind).run(probe(418, with(holes, {{316, 50}, {318, 20}, {319, 0}}))),
                    "Intersection not determined", "parallel");
  }
}

/// A table that turns about Z, but not where A stands now.
TEST(EarlyRefusals, NameTheAxisThatStandsAskew) {
  Bench bench = benchOf(ControlKind::TNC640, "mill5-table-table");
  const Ran ran = bench.run("L A+10 R0 FMAX\n" + probe(403, with(edge, {{337, 0}})));
  expectUntouched(ran, "Rotary axis not available", "A at 10.000");
}

/// Later software of the iTNC 530 has parameters that its manual does not print.
TEST(SoftwareVersion, BringsParametersToTheOlderControl) {
  Bench bench = benchOf(ControlKind::iTNC530);
  bench.part(simulation::Ring(20, 35, -40), pose({0.25, 0, -400}));
  const std::string block = probe(412, with(hole, {{423, 3}, {365, 0}}));
  const Ran later = bench.run(block);
  ASSERT_TRUE(later.finished()) << later.why();
  EXPECT_EQ(later.touches(), 3U);
  EXPECT_NEAR(later.q(151), 0.25, 1e-6);
  bench.setup.beliefs.parameters["softwareVersion"] = {3.0, {}};
  const Ran earlier = bench.run(block);
  EXPECT_EQ(earlier.alarm(), "Cycle parameter wrong");
  EXPECT_NE(earlier.why().find("340 49x-05"), std::string::npos) << earlier.why();
}

/// TOOL CALL 0 with an axis is the probe that the operator has put in; without one it empties the spindle.
TEST(ToolCall0, DefinesTheProbeAxisOfTheOlderControl) {
  Bench bench = benchOf(ControlKind::iTNC530);
  bench.part(simulation::Ring(20, 35, -40), pose({0.25, 0, -400}));
  for (const double mp7411 : {0.0, 1.0}) {
    bench.setup.beliefs.parameters["MP7411"] = {mp7411, {}};
    const Ran ran = bench.runBare("TOOL CALL 0 Z\n" + probe(412, hole));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), 0.25, 1e-6);
    EXPECT_NEAR(ran.q(153), 40, 1e-6);
  }
  EXPECT_EQ(bench.runBare("TOOL CALL 1 Z\nTOOL CALL 0\n" + probe(412, hole)).alarm(), "Touch probe not ready");
  const Ran newer = benchOf(ControlKind::TNC640).runBare("TOOL CALL 0 Z\n" + probe(412, hole));
  EXPECT_EQ(newer.alarm(), "Touch probe not defined");
  EXPECT_NE(newer.why().find("TOOL CALL 0 has emptied it"), std::string::npos) << newer.why();
  EXPECT_EQ(newer.why().find("calibrate"), std::string::npos) << newer.why();
}

/// One angle is all that the preset table of the iTNC 530 keeps.
TEST(Beliefs, OfTheOlderControlHaveOneAngle) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench = benchOf(kind);
    bench.setup.beliefs.presets.front().rotation = {1, 2, 3};
    Diagnostics diagnostics;
    session::heidenhain::heidenhainTables(bench.setup.beliefs, kind, diagnostics);
    EXPECT_EQ(hasErrors(diagnostics), kind == ControlKind::iTNC530);
    if (kind == ControlKind::iTNC530) {
      EXPECT_NE(diagnostics.front().message.find("preset 1"), std::string::npos);
    }
  }
}

/// `rotary` of a preset is the offset of the axis: the one column that cycles change.
TEST(Beliefs, EnterTheOffsetOfARotaryAxisWhereCyclesDo) {
  Bench bench = benchOf(ControlKind::TNC640, "mill5-table-table");
  bench.setup.beliefs.presets.front().rotary["C"] = 10;
  Diagnostics diagnostics;
  const auto tables = session::heidenhain::heidenhainTables(bench.setup.beliefs, ControlKind::TNC640, diagnostics);
  EXPECT_EQ(tables.presets.numberOr("1", "C_OFFS", 0), 10);
  EXPECT_EQ(tables.presets.numberOr("1", "C", 0), 0);
}

/// A setup may write MP6180.0 with or without quotes.
TEST(Beliefs, ReadParametersWithADot) {
  for (const char* name : {"MP6180.0", "\"MP6180.0\""}) {
    Diagnostics diagnostics;
    const auto setup = setup::parseSetup(fmt::format("[control]\ntype = \"iTNC530\"\n[parameters]\n{} = 123.5\n"
                                                     "MP6360 = 250\nMP6361 = 2500\nMP6166 = 1\n",
                                                     name),
                                         "s.toml", diagnostics);
    ASSERT_TRUE(setup) << format(diagnostics.front());
    const auto parameters = session::heidenhain::machineParameters(setup->beliefs, ControlKind::iTNC530, diagnostics);
    EXPECT_TRUE(diagnostics.empty());
    EXPECT_EQ(parameters.mp6180x, 123.5);
  }
  hh::MachineParameters parameters;
  for (const char* number : {"204600", "204601"}) {
    parameters.checkTiltingAxes = false;
    EXPECT_TRUE(hh::setMachineParameter(parameters, ControlKind::TNC640, number, 1));
    EXPECT_TRUE(parameters.checkTiltingAxes) << number;
  }
  EXPECT_TRUE(hh::setMachineParameter(parameters, ControlKind::TNC640, "122604", 1));
}

}  // namespace
}  // namespace probewright::testing_support
