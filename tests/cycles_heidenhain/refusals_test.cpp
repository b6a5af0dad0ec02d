#include <algorithm>
#include <set>

#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// What the cycles refuse, what stops them, and what they leave behind when they stop.
namespace probewright::testing_support {
namespace {

namespace hh = control::heidenhain;

/// A hole of 30 mm at X50 Y40 of preset row 1, whose top is Z0; a mill is tool 5.
Bench holeBench(ControlKind kind = ControlKind::TNC640, const std::string& machine = "mill3", double diameter = 30) {
  Bench bench(kind, machine);
  bench.preset(1, {10, 20, -400});
  bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), pose({60, 60, -400}));
  bench.knows(5, "MILL", 50, 8);
  simulation::TrueTool mill;
  mill.number = 5;
  mill.name = "MILL";
  mill.kind = simulation::ToolKind::Cutter;
  mill.length = 50;
  mill.radius = 8;
  bench.setup.world.truth.tools.push_back(mill);
  return bench;
}

const Words preset412 = {{321, 50}, {322, 40}, {262, 30}, {325, 0}, {247, 90}, {261, -8}, {320, 0},
                         {260, 20}, {301, 0},  {305, 1},  {331, 0}, {332, 0},  {303, 1},  {381, 0}};
const Words inspect421 = {{273, 50}, {274, 40}, {262, 30}, {325, 0}, {247, 90}, {261, -8}, {320, 0}, {260, 20},
                          {301, 0},  {275, 0},  {276, 0},  {279, 0}, {280, 0},  {281, 0},  {309, 0}, {330, 0}};

/// The run stopped with this alarm at the cycle's first line, and no table was changed.
void expectRefused(const Ran& ran, const std::string& code, const std::string& part = {}) {
  EXPECT_EQ(ran.alarm(), code) << ran.why();
  EXPECT_NE(ran.why().find(part), std::string::npos) << ran.why();
  EXPECT_FALSE(ran.outcome.result.diagnostics.empty() ? true : ran.outcome.result.diagnostics.front().place.line == 0);
  EXPECT_EQ(ran.outcome.info.exit, records::ExitState::Stopped);
  for (const auto& cycle : ran.outcome.journal.cycles)
    EXPECT_TRUE(cycle.writes.empty());
}

TEST(Refusals, TheHoleIsFoundWhenNothingIsWrong) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    const Ran ran = holeBench(kind).run(probe(412, preset412));
    EXPECT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.seen({60, 60, -400}).norm(), 0, 1e-6);
  }
}

TEST(Refusals, NothingToTouch) {
  Bench bench = holeBench();
  bench.setup.world.truth.solids.clear();
  const Ran ran = bench.run(probe(412, preset412));
  expectRefused(ran, "Touch point inaccessible", "20.000 mm");
  EXPECT_EQ(ran.cycle().touches.back().outcome, "no contact");
  EXPECT_FALSE(ran.cycle().alarm.empty());
}

TEST(Refusals, NoToolCall) {
  expectRefused(holeBench().runBare(probe(412, preset412)), "Touch probe axis not defined", "TOOL CALL");
}

TEST(Refusals, NoTouchProbeInTheSpindle) {
  expectRefused(holeBench().runBare("TOOL CALL 5 Z\n" + probe(412, preset412)), "Touch probe not defined", "TP_NO");
  expectRefused(holeBench(ControlKind::iTNC530).runBare("TOOL CALL 5 Z\nL X+50 Y+40 R0 FMAX\n" + probe(412, preset412)),
                "Touch probe not ready");
}

TEST(Refusals, ProbeSwitchedOff) {
  Bench bench = holeBench();
  bench.trueProbe().switchedOn = false;
  expectRefused(bench.run(probe(412, preset412)), "Touch probe not ready");
}

TEST(Refusals, TheTouchBeginsWithADeflectedStylus) {
  Bench bench = holeBench();
  bench.part(simulation::HalfSpace({Vector3(0, 0, -400), Vector3::UnitZ()}));
  // Cycle 4 without retraction leaves the stylus in contact; cycle 0 begins where it stands.
  const Ran ran = bench.run(
      "L X-80 Y-80 R0 FMAX\nL Z+5 R0 FMAX\nTCH PROBE 4.0 M\nTCH PROBE 4.1 Q30\nTCH PROBE 4.2 IZ-1\n"
      "TCH PROBE 4.3 ABST+9 F100 MB0 REFERENCE SYSTEM:0\nTCH PROBE 0.0 REF. PLANE Q5 Z-\nTCH PROBE 0.1 IX+0 IY+0 IZ+0\n"
      "Q20 = 1\n");
  expectRefused(ran, "Stylus already in contact", "before probing begins");
  EXPECT_EQ(ran.cycle().touches.back().outcome, "deflected");
  EXPECT_EQ(ran.q(20), 0);
}

TEST(Refusals, ActiveTransformations) {
  const std::string shift = "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+5\n";
  const std::string turn = "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+15\n";
  const std::string scale = "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 1.5\n";
  const std::string mirror = "CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X\n";
  for (const std::string& transformation : {shift, scale, mirror}) {
    expectRefused(holeBench().run(transformation + probe(412, preset412)), "Coordinate transformation not permitted");
  }
  expectRefused(holeBench().run(turn + probe(421, inspect421)), "Coordinate transformation not permitted");
  // The iTNC 530 forbids none: the shifted hole is found where the shifted coordinates say.
  const Ran shifted = holeBench(ControlKind::iTNC530).run(shift + probe(421, with(inspect421, {{273, 45}})));
  EXPECT_TRUE(shifted.finished()) << shifted.why();
  EXPECT_NEAR(shifted.q(151), 45, 1e-6);
  // Presetting cycles run with cycle 10, and row 0 clears it.
  const Eigen::Rotation2Dd back(radians(-15));
  const Vector2 seen = back * Vector2(50, 40);
  const Ran turned = holeBench().run(
      turn + probe(412, with(preset412, {{321, written(seen.x())}, {322, written(seen.y())}, {305, 0}, {331, 7}})));
  EXPECT_TRUE(turned.finished()) << turned.why();
  EXPECT_NEAR(turned.q(151), seen.x(), 1e-6);
  EXPECT_NEAR(turned.q(152), seen.y(), 1e-6);
  EXPECT_NEAR((turned.seen({60, 60, -400}) - Vector3(7, 0, 0)).norm(), 0, 1e-6);
}

TEST(Refusals, TiltedPlaneAndTurningMode) {
  const Words edge = {{263, 0},  {264, 0}, {265, 20}, {266, 0}, {272, 2}, {267, 1},
                      {261, -5}, {320, 0}, {260, 20}, {301, 0}, {307, 0}, {305, 0}};
  expectRefused(holeBench(ControlKind::TNC640, "mill5-table-table")
                    .run("PLANE SPATIAL SPA+0 SPB+0 SPC+10 STAY\n" + probe(400, edge)),
                "Tilted working plane not permitted");
  expectRefused(holeBench().run("FUNCTION MODE TURN\n" + probe(412, preset412)), "Function not permitted");
}

TEST(Refusals, TransferToNowhere) {
  expectRefused(holeBench().run(probe(412, with(preset412, {{303, -1}, {305, 5}}))),
                "Measured value transfer not defined");
  expectRefused(holeBench().run(probe(412, with(preset412, {{303, 0}, {305, 5}}))), "Datum table not selected");
  // Programs of older controls: without a row the preset is set at once.
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    const Ran old = holeBench(kind).run(probe(412, with(preset412, {{303, -1}, {305, 0}})));
    EXPECT_TRUE(old.finished()) << old.why();
    EXPECT_NEAR(old.seen({60, 60, -400}).norm(), 0, 1e-6);
  }
}

/// The mistake is found before the first move, at the parameter's line.
void expectMistake(const Ran& ran, const std::string& part) {
  EXPECT_EQ(ran.outcome.info.exit, records::ExitState::InputMistake);
  EXPECT_NE(ran.why().find(part), std::string::npos) << ran.why();
  EXPECT_TRUE(ran.outcome.journal.cycles.empty());
  if (!ran.outcome.diagnostics.empty()) {
    EXPECT_GE(ran.outcome.diagnostics.front().place.line, 3U);
  }
}

TEST(Refusals, Parameters) {
  const auto run = [](const Words& changes, ControlKind kind = ControlKind::TNC640) {
    return holeBench(kind).run(probe(412, with(preset412, changes)));
  };
  expectMistake(run({{247, 4}}), "Q247");
  expectMistake(run({{247, -4.9}}), "Q247");
  expectMistake(run({{247, 121}}), "Q247");
  expectMistake(run({{320, -1}}), "Q320");
  expectMistake(run({{301, 2}}), "Q301");
  expectMistake(run({{305, 1.5}}), "whole number");
  expectMistake(run({{305, 10000}}), "9999");
  expectMistake(run({{321, 100000}}), "99999.9999");
  expectMistake(run({{423, 5}}), "Q423");
  expectMistake(run({{999, 1}}), "Q999");
  Words missing = preset412;
  missing.erase(missing.begin() + 2);
  expectMistake(holeBench().run(probe(412, missing)), "Q262");
  // A value that only the run can know is refused when the cycle begins.
  std::string computed = probe(412, preset412);
  computed.replace(computed.find("Q301=+0.000000"), 14, "Q301=+Q50");
  EXPECT_TRUE(holeBench().run("Q50 = 1\n" + computed).finished());
  expectRefused(holeBench().run("Q50 = 2\n" + computed), "Cycle parameter wrong", "Q301");
}

TEST(Refusals, Geometry) {
  Bench bench = holeBench();
  bench.part(simulation::HalfSpace(Plane{{0, 0, -400}, Vector3::UnitZ()}));
  expectRefused(bench.run(probe(431, {{263, -20},
                                      {264, -20},
                                      {294, 0},
                                      {265, -10},
                                      {266, -20},
                                      {295, 0},
                                      {296, -30},
                                      {297, -20},
                                      {298, 0},
                                      {320, 0},
                                      {260, 20},
                                      {281, 0}})),
                "Plane wrongly defined", "straight line");
  Bench block;
  block.preset(1, {0, 0, -400});
  block.part(simulation::Box({0, 0, -40}, {50, 50, 0}), pose({0, 0, -400}));
  const Words edge = {{263, 10}, {264, 0},  {265, 10}, {266, 0},  {272, 2},
                      {267, 1},  {261, -5}, {320, 0},  {260, 20}, {301, 1}};
  expectRefused(block.run(probe(400, with(edge, {{307, 0}, {305, 0}}))), "Edge not determined");
  // Which corner it is follows from the third touch, which must lie beside the first in both axes.
  const Words corner = {{263, 10}, {264, 0}, {326, 20}, {296, 0}, {297, 10}, {327, 20}, {261, -5}, {320, 0},
                        {260, 20}, {301, 1}, {304, 0},  {305, 1}, {331, 0},  {332, 0},  {303, 1},  {381, 0}};
  EXPECT_TRUE(block.run(probe(414, corner)).finished());
  for (const Words& same : {Words{{296, 10}}, Words{{297, 0}}})
    expectRefused(block.run(probe(414, with(corner, same))), "Corner not determined", "third touch share a coordinate");
  const Words apart = with(edge, {{265, 30}, {312, 4}, {337, 0}});
  expectRefused(block.run(probe(403, apart)), "Rotary axis not permitted");
  expectRefused(block.run(probe(403, with(apart, {{312, 6}}))), "Rotary axis not available");
}

TEST(Refusals, LockedPresetRow) {
  Bench bench = holeBench();
  const TableFolder folder(bench);
  hh::TypedTable presets = hh::defaultPresetTable(ControlKind::TNC640);
  ASSERT_TRUE(presets.ensureRow("5"));
  ASSERT_TRUE(presets.setText("5", "LOCKED", "L"));
  ASSERT_TRUE(presets.ensureRow("1"));
  ASSERT_TRUE(presets.setNumber("1", "X", 10));
  ASSERT_TRUE(presets.setNumber("1", "Y", 20));
  ASSERT_TRUE(presets.setNumber("1", "Z", -400));
  folder.put("PRESET.PR", presets);
  expectRefused(bench.run(probe(412, with(preset412, {{305, 5}}))), "Preset locked", "Row 5");
  EXPECT_TRUE(bench.run(probe(412, preset412)).finished());
}

TEST(DatumTable, TakesTheFeatureSeenFromThePreset) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench = holeBench(kind);
    bench.setup.beliefs.presets.front().rotation = {0, 0, 30};
    const TableFolder folder(bench);
    folder.put("ZERO.D", hh::defaultDatumTable(kind, "ZERO.D"));
    const Vector3 seen = pose({10, 20, -400}, {0, 0, 30}).inverse() * Vector3(60, 60, -400);
    const Words words = with(preset412, {{321, written(seen.x() + 0.4)},
                                         {322, written(seen.y() - 0.3)},
                                         {303, 0},
                                         {305, 3},
                                         {331, 1},
                                         {332, -2},
                                         {381, 1},
                                         {382, written(seen.x() + 30)},
                                         {383, written(seen.y())},
                                         {384, 0},
                                         {333, 4}});
    const Ran ran = bench.run("SEL TABLE \"ZERO.D\"\n" + probe(412, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("ZERO.D", "3", "X"), seen.x() - 1, 6e-5);
    EXPECT_NEAR(ran.cell("ZERO.D", "3", "Y"), seen.y() + 2, 6e-5);
    EXPECT_NEAR(ran.cell("ZERO.D", "3", "Z"), -4, 6e-5);
    // Nothing is activated.
    EXPECT_TRUE(ran.preset().isApprox(pose({10, 20, -400}, {0, 0, 30}), 1e-12));
  }
}

/// Y does not fit into its column: X, which would, stays as it was, and there is no row 3.
TEST(DatumTable, TakesAllOfAFeatureOrNothing) {
  Bench bench = holeBench();
  const TableFolder folder(bench);
  const Words words = with(preset412, {{303, 0}, {305, 3}, {331, 1}, {332, -2}, {381, 0}});
  const auto runWith = [&](std::string_view row) {
    folder.put("ZERO.D", fmt::format("BEGIN ZERO .D MM\nNR X         Y    Z         \n{}[END]\n", row));
    return bench.run("SEL TABLE \"ZERO.D\"\n" + probe(412, words));
  };
  const Ran known = runWith("3  +7        +8   +9        \n");
  expectRefused(known, "Table write error", "column Y");
  EXPECT_EQ(known.cell("ZERO.D", "3", "X"), 7);
  EXPECT_EQ(known.cell("ZERO.D", "3", "Y"), 8);
  const Ran added = runWith("1  +7        +8   +9        \n");
  expectRefused(added, "Table write error", "column Y");
  EXPECT_FALSE(added.table("ZERO.D").hasRow("3"));
}

TEST(Inspection, StopsOutOfToleranceWithEverythingWritten) {
  const Words words = with(inspect421, {{275, 29.95}, {276, 29.9}, {281, 1}, {309, 1}, {330, 5}});
  const Ran ran = holeBench().run(probe(421, words));
  EXPECT_EQ(ran.alarm(), "Tolerance exceeded");
  EXPECT_NE(ran.why().find("Scrap"), std::string::npos) << ran.why();
  EXPECT_NE(ran.why().find("Diameter"), std::string::npos) << ran.why();
  EXPECT_EQ(ran.q(182), 1);
  EXPECT_NEAR(ran.q(153), 30, 1e-6);
  EXPECT_NE(ran.log("TCHPR421.TXT"), "");
  EXPECT_EQ(ran.cycle().verdict, control::Verdict::Scrap);
  // Good parts do not stop; without Q309 nothing does, but the run is known as out of tolerance.
  EXPECT_TRUE(holeBench().run(probe(421, with(words, {{275, 30.1}}))).finished());
  const Ran going = holeBench().run(probe(421, with(words, {{309, 0}})));
  EXPECT_TRUE(going.finished());
  EXPECT_EQ(going.outcome.info.exit, records::ExitState::OutOfTolerance);
}

/// What the message says counts in the unit of the program, as its parameters do.
TEST(Inspection, SaysInInchesWhatIsOutOfTolerance) {
  Words inches = with(inspect421, {{275, 29.95}, {276, 29.9}, {309, 1}});
  const std::set<int> lengths = {273, 274, 262, 261, 320, 260, 275, 276, 279, 280};
  for (auto& [number, value] : inches) {
    if (lengths.contains(number)) value /= 25.4;
  }
  const Ran ran = holeBench().run(probe(421, inches), "INCH");
  EXPECT_EQ(ran.alarm(), "Tolerance exceeded");
  EXPECT_NE(ran.why().find("Diameter 1.18110 ("), std::string::npos) << ran.why();
}

/// Cycle 441 can make every inspection wait, also those that write a file: it is there whatever the operator decides.
TEST(Inspection, WritesTheLogBeforeItWaits) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench = holeBench(kind);
    bench.onStop = control::OnStop::Abort;
    const std::string wait = "TCH PROBE 441 FAST PROBING ~\n Q396=3000 ~\n Q397=0 ~\n Q399=0 ~\n Q400=1\n";
    const Ran ran = bench.run(wait + probe(421, with(inspect421, {{281, 1}})));
    EXPECT_EQ(ran.outcome.result.end, execution::RunEnd::Cancelled);
    EXPECT_NE(ran.log("TCHPR421.TXT").find("30.0000"), std::string::npos);
    ASSERT_EQ(ran.screens().size(), 1U);
    EXPECT_EQ(ran.screens().front(), ran.log("TCHPR421.TXT"));
  }
}

TEST(Inspection, ShowsTheLogAndWaits) {
  const Words words = with(inspect421, {{281, 2}});
  const Ran going = holeBench().run(probe(421, words));
  EXPECT_TRUE(going.finished());
  EXPECT_EQ(going.log("TCHPR421.TXT"), "");
  const auto& events = going.outcome.journal.events;
  EXPECT_TRUE(std::ranges::any_of(events, [](const control::EventRecord& event) {
    return event.kind == control::EventKind::Stop && event.text.find("Measuring Log") != std::string::npos;
  }));
  Bench aborted = holeBench();
  aborted.onStop = control::OnStop::Abort;
  EXPECT_EQ(aborted.run(probe(421, words)).outcome.result.end, execution::RunEnd::Cancelled);
}

TEST(Inspection, LocksABrokenTool) {
  Bench bench = holeBench();
  const TableFolder folder(bench);
  hh::TypedTable tools = hh::defaultToolTable(ControlKind::TNC640);
  ASSERT_TRUE(tools.ensureRow("5"));
  ASSERT_TRUE(tools.setText("5", "NAME", "MILL"));
  ASSERT_TRUE(tools.setNumber("5", "L", 50));
  ASSERT_TRUE(tools.setNumber("5", "R", 8));
  ASSERT_TRUE(tools.setNumber("5", "DR", 0.02));
  ASSERT_TRUE(tools.setNumber("5", "RBREAK", 0.25));
  folder.put("TOOL.T", tools);
  // 0.2 mm too large: the tool is corrected by half of it. 0.3 mm: broken.
  const Ran worn = bench.run(probe(421, with(inspect421, {{262, 29.8}, {330, 5}})));
  EXPECT_TRUE(worn.finished()) << worn.why();
  EXPECT_NEAR(worn.cell("TOOL.T", "5", "DR"), 0.02 + 0.1, 6e-5);
  const Ran broken = bench.run(probe(421, with(inspect421, {{262, 29.7}, {330, 5}})));
  EXPECT_EQ(broken.alarm(), "Tool breakage");
  EXPECT_EQ(broken.table("TOOL.T").text("5", "TL"), "L");
  EXPECT_NEAR(broken.cell("TOOL.T", "5", "DR"), 0.02, 1e-9);
  // By name, twice: corrections add up.
  const std::string byName = probe(421, with(inspect421, {{262, 29.9}}));
  std::string named = byName;
  named.replace(named.find("Q330=+0.000000"), 14, "Q330=\"MILL\"");
  const Ran twice = bench.run(named + named);
  EXPECT_TRUE(twice.finished()) << twice.why();
  EXPECT_NEAR(twice.cell("TOOL.T", "5", "DR"), 0.02 + 0.1, 1.1e-4);
  expectRefused(bench.run(probe(421, with(inspect421, {{330, 77}}))), "Tool not defined", "77");
}

}  // namespace
}  // namespace probewright::testing_support
