#include <gmock/gmock.h>

#include "control/heidenhain/deflection_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// What calibrations, tool monitoring and single touches refuse by tables and tools, and what they take all the same.
namespace probewright::testing_support {
namespace {

namespace hh = control::heidenhain;
using ::testing::HasSubstr;

constexpr ControlKind newer = ControlKind::TNC640, older = ControlKind::iTNC530;

/// A ring of 20 mm radius at X0, a stud of 10 mm at X80, a sphere of 12.5 mm at X-80, a block of height 5 at Y80. A
/// mill is tool 5.
Bench standards(ControlKind kind = newer) {
  Bench bench(kind);
  bench.preset(1, {0, 0, -400});
  bench.believedProbe().maximumTravel = 40;
  bench.part(simulation::Ring(20, 30, -30), pose({0, 0, -400}));
  bench.part(simulation::RoundBar(10, -30, 0), pose({80, 0, -400}));
  bench.part(simulation::SolidSphere(Vector3::Zero(), 12.5), pose({-80, 0, -412.5}));
  bench.part(simulation::Box({-15, -15, -20}, {15, 15, 5}), pose({0, 80, -400}));
  bench.knows(5, "MILL", 100, 8);
  simulation::TrueTool mill;
  mill.number = 5;
  mill.name = "MILL";
  mill.kind = simulation::ToolKind::Cutter;
  mill.length = 100;
  mill.radius = 8;
  bench.setup.world.truth.tools.push_back(mill);
  return bench;
}

std::string above(double x, double y, double z) {
  return fmt::format("L Z+60 R0 FMAX\nL X{:+} Y{:+} R0 FMAX\nL Z{:+} R0 FMAX\n", x, y, z);
}
const Words ringWords = {{407, 20}, {320, 1}, {423, 4}, {380, 0}},
            studWords = {{407, 10}, {320, 1}, {301, 1}, {423, 4}, {380, 0}},
            sphereWords = {{407, 12.5}, {320, 1}, {301, 1}, {423, 4}, {380, 0}, {433, 0}, {434, -12.5}};
std::string ring(const Words& changes = {}) { return above(0, 0, -8) + probe(462, with(ringWords, changes)); }
std::string stud(const Words& changes = {}) { return above(80, 0, 4) + probe(463, with(studWords, changes)); }
std::string sphere(const Words& changes = {}) { return above(-80, 0, 4) + probe(460, with(sphereWords, changes)); }
std::string length() { return above(0, 80, 9) + probe(461, {{434, 5}}); }

void expectRefused(const Ran& ran, const std::string& code, const std::string& part) {
  EXPECT_EQ(ran.alarm(), code) << ran.why();
  EXPECT_THAT(ran.why(), HasSubstr(part));
  for (const auto& cycle : ran.outcome.journal.cycles)
    EXPECT_TRUE(cycle.writes.empty());
}

/// TOOL.T with the probe of standards(), which names this row of the touch probe table.
hh::TypedTable toolTable(const std::string& probeRow) {
  hh::TypedTable tools = hh::defaultToolTable(newer);
  EXPECT_TRUE(tools.setText("1", "NAME", "PROBE"));
  EXPECT_TRUE(tools.setNumber("1", "L", 100));
  EXPECT_TRUE(tools.setNumber("1", "R", 2));
  EXPECT_TRUE(tools.setText("1", "TP_NO", probeRow));
  return tools;
}

TEST(CalibrationRefusals, AStandardThatIsAnother) {
  // Felt from within, a ring that is said to be smaller leaves nothing for the ball; so does a larger stud or sphere.
  expectRefused(standards().run(ring({{407, 17.9}})), "Calibration not possible", "Q407");
  expectRefused(standards().run(stud({{407, 12.1}})), "Calibration not possible", "Q407");
  expectRefused(standards().run(sphere({{407, 14.6}})), "Calibration not possible", "Q407");
  expectRefused(standards(older).run(sphere({{407, 14.6}})), "Calibration not possible", "Q407");
}

TEST(CalibrationRefusals, AToolThatIsNoTouchProbe) {
  for (const std::string& cycle : {ring(), stud(), sphere(), length()}) {
    expectRefused(standards().runBare("TOOL CALL 5 Z\n" + cycle), "Touch probe not defined", "TP_NO");
  }
  // TP_NO of the tool table and the number in the touch probe table have to agree.
  Bench bench = standards();
  const TableFolder folder(bench);
  hh::TypedTable tools = toolTable("7");
  folder.put("TOOL.T", tools);
  for (const std::string& cycle : {ring(), stud(), sphere(), length()}) {
    expectRefused(bench.run(cycle), "Touch probe not defined", "row 7");
  }
}

TEST(TouchProbeRefusals, ARowThatNoProbeCanMoveBy) {
  struct Wrong {
    const char* column;
    double value;
    const char* shown;
  };
  for (const Wrong& wrong : {Wrong{"F", 0, "F of touch probe 1 cannot be 0"},
                             {"F", -300, "F of touch probe 1 cannot be -300"},
                             {"FMAX", 0, "FMAX of touch probe 1 cannot be 0"},
                             {"DIST", 0, "DIST of touch probe 1 cannot be 0"},
                             {"DIST", -1, "DIST of touch probe 1 cannot be -1"},
                             {"SET_UP", -5, "SET_UP of touch probe 1 cannot be -5"}}) {
    Bench bench = standards();
    const TableFolder folder(bench);
    hh::TypedTable probes = hh::defaultProbeTable(newer);
    EXPECT_TRUE(probes.setNumber("1", hh::NumberColumn::named(wrong.column), wrong.value));
    folder.put("TCHPROBE.TP", probes);
    const Ran ran = bench.run(ring());
    expectRefused(ran, "Touch probe not defined", wrong.shown);
    EXPECT_TRUE(ran.cycle().touches.empty());
  }
}

TEST(CalibrationRefusals, AToolTableWithoutRoomForDirections) {
  Bench bench = standards();
  const TableFolder folder(bench);
  hh::TypedTable tools = toolTable("1");
  std::string bytes = tools.table().bytes();
  const std::size_t column = bytes.find("DR2TABLE");
  ASSERT_NE(column, std::string::npos);
  bytes.replace(column, 8, "REMARK_1");
  folder.put("TOOL.T", bytes);
  const Ran ran = bench.run(sphere({{455, 5}}));
  expectRefused(ran, "Table write error", "DR2TABLE");
  EXPECT_TRUE(ran.cycle().touches.empty()) << "before the first touch";
  EXPECT_TRUE(bench.run(sphere()).finished());
}

/// DR2TABLE names the table, with or without folder and ending; a new one is named after the tool.
TEST(Cycle460, WritesTheTableThatTheToolNames) {
  for (const auto& [entry, file] : {std::pair("", "T1.3DTC"), std::pair("STAR", "STAR.3DTC"),
                                    std::pair("TNC:\\system\\3D-ToolComp\\ts.3dtc", "TS.3DTC")}) {
    SCOPED_TRACE(entry);
    Bench bench = standards();
    const TableFolder folder(bench);
    hh::TypedTable tools = hh::defaultToolTable(newer);
    ASSERT_TRUE(tools.setText("1", "NAME", "PROBE"));
    ASSERT_TRUE(tools.setNumber("1", "L", 100));
    ASSERT_TRUE(tools.setNumber("1", "R", 2));
    ASSERT_TRUE(tools.setText("1", "TP_NO", "1"));
    const bool fits = tools.setText("1", "DR2TABLE", entry).has_value();
    if (!fits) continue;
    folder.put("TOOL.T", tools);
    if (*entry != 0) {
      folder.put(file, *hh::deflectionTable(file, {{0, 0, 0}, {90, 0, 0.3}, {90, 120, 0.3}, {90, 240, 0.3}}));
    }
    const Ran ran = bench.run(sphere({{455, 2}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    ASSERT_TRUE(ran.outcome.files.contains(file));
    EXPECT_EQ(ran.outcome.files.contains("T1.3DTC"), *entry == 0);
    Diagnostics diagnostics;
    const auto table = hh::TypedTable::parse(ran.outcome.files.at(file), file, hh::deflectionColumns(), diagnostics);
    ASSERT_TRUE(table);
    const auto rows = hh::deflectionsOf(*table);
    EXPECT_EQ(rows.size(), 1U + 2 * 4);
    for (const auto& row : rows)
      EXPECT_NEAR(row.deviation, 0, 1e-6) << "the probe of this bench is the same in all directions";
  }
}

/// A new stylus: no radius yet. What measures refuses it, what calibrates finds it.
TEST(Calibrations, BeginWithoutARadius) {
  for (const std::string& cycle : {ring(), stud(), sphere()}) {
    Bench bench = standards();
    bench.believedProbe().radius = 0;
    const Words hole = {{273, 0}, {274, 0}, {262, 40}, {325, 0}, {247, 90}, {261, -8}, {320, 1}, {260, 20},
                        {301, 0}, {275, 0}, {276, 0},  {279, 0}, {280, 0},  {281, 0},  {309, 0}, {330, 0}};
    expectRefused(bench.run(probe(421, hole)), "Touch probe not calibrated", "column R");
    const Ran ran = bench.run(cycle + "L Z+60 R0 FMAX\n" + probe(421, hole));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), 2, 1e-6);
    EXPECT_NEAR(ran.q(153), 40, 1e-6);
  }
}

/// Effective at once: no TOOL CALL between calibration and measurement, DL is used up.
TEST(Cycle461, TakesADeltaLengthIntoTheLength) {
  Bench bench = standards();
  const TableFolder folder(bench);
  hh::TypedTable tools = hh::defaultToolTable(newer);
  ASSERT_TRUE(tools.setText("1", "NAME", "PROBE"));
  ASSERT_TRUE(tools.setNumber("1", "L", 99.7));
  ASSERT_TRUE(tools.setNumber("1", "DL", 0.2));
  ASSERT_TRUE(tools.setNumber("1", "R", 2));
  ASSERT_TRUE(tools.setText("1", "TP_NO", "1"));
  folder.put("TOOL.T", tools);
  const Words top = {{263, 5},  {264, 85}, {261, 5}, {320, 1}, {272, 3}, {267, -1},
                     {260, 20}, {281, 0},  {288, 0}, {289, 0}, {309, 0}, {330, 0}};
  const Ran before = bench.run(probe(427, top));
  EXPECT_NEAR(before.q(160), 5.1, 1e-6) << "the stylus is longer than L + DL say";
  const Ran ran = bench.run(length() + probe(427, top));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), 100, 1e-6);
  EXPECT_EQ(ran.cell("TOOL.T", "1", "DL"), 0);
  EXPECT_NEAR(ran.q(160), 5, 1e-6);
  EXPECT_THAT(ran.log("TCHPRAUTO.html"), HasSubstr("<td>DL</td><td>0.2000</td><td>0.0000</td>"));
}

TEST(SingleTouches, NameAnAxisThatTheMachineLacks) {
  for (const ControlKind kind : {newer, older}) {
    const Ran ran =
        standards(kind).run("L Z+60 R0 FMAX\nTCH PROBE 0.0 REF. PLANE Q5 X-\nTCH PROBE 0.1 X+20 Y+0 Z-5 A+10\n");
    expectRefused(ran, "Axis not available", "axis A");
    EXPECT_TRUE(ran.cycle().touches.empty());
  }
}

/// The older edition prints the limits of a stud with the numbers of a hole.
TEST(Mistakes, TheLimitsOfAHoleInAStud) {
  const Ran ran = standards(older).run(probe(422, {{273, 80},
                                                   {274, 0},
                                                   {262, 20},
                                                   {325, 90},
                                                   {247, 30},
                                                   {261, -5},
                                                   {320, 0},
                                                   {260, 10},
                                                   {301, 0},
                                                   {275, 20.1},
                                                   {276, 19.9},
                                                   {279, 0},
                                                   {280, 0},
                                                   {281, 0},
                                                   {309, 0},
                                                   {330, 0}}));
  EXPECT_EQ(ran.outcome.info.exit, records::ExitState::InputMistake);
  EXPECT_THAT(ran.why(), ::testing::AnyOf(HasSubstr("Q277"), HasSubstr("Q275")));
}

/// Q330 as programs write it: number, name in either parameter, name without its closing mark, number found by name.
TEST(MonitoredTool, IsFoundHoweverItIsWritten) {
  Bench bench = standards();
  const TableFolder folder(bench);
  hh::TypedTable tools = toolTable("1");
  ASSERT_TRUE(tools.setText("5", "NAME", "MILL"));
  ASSERT_TRUE(tools.setText("5.2", "NAME", "MILL_B"));
  folder.put("TOOL.T", tools);
  std::string block = probe(421, {{273, 0},
                                  {274, 0},
                                  {262, 39.9},
                                  {325, 0},
                                  {247, 90},
                                  {261, -8},
                                  {320, 1},
                                  {260, 20},
                                  {301, 0},
                                  {275, 0},
                                  {276, 0},
                                  {279, 0},
                                  {280, 0},
                                  {281, 0},
                                  {309, 0},
                                  {330, 0}});
  const auto corrected = [&](const std::string& before, const std::string& tool, const std::string& row) {
    std::string text = block;
    text.replace(text.find("Q330=+0.000000"), 14, tool);
    const Ran ran = bench.run(before + text);
    EXPECT_TRUE(ran.finished()) << tool << ": " << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", row, "DR"), 0.05, 1e-6) << tool;
    EXPECT_EQ(ran.cell("TOOL.T", row == "5" ? "5.2" : "5", "DR"), 0) << tool;
  };
  corrected("", "Q330=5", "5");
  corrected("", "Q330=+5.2", "5.2");
  corrected("", "Q330=\"MILL\"", "5");
  corrected("", "QS330=\"MILL_B\"", "5.2");
  corrected("", "Q330=\"MILL", "5");
  corrected("", "QS330=\"MILL_B ;TOOL", "5.2");
  corrected("Q7 = 5\n", "Q330=+Q7", "5");
  corrected("QS0 = \"MILL\"\nFN 18: SYSREAD Q0 = ID990 NR10 IDX0\nQ0 = Q0 + 0.2\n", "Q330=Q0", "5.2");
  std::string text = block;
  text.replace(text.find("Q330=+0.000000"), 14, "Q330=\"DRILL\"");
  expectRefused(bench.run(text), "Tool not defined", "DRILL");
  text.replace(text.find("Q330=\"DRILL\""), 12, "Q330=\"\"");
  EXPECT_TRUE(bench.run(text).finished()) << "no name: not monitored";
}

/// 0, 3, 4 and 444 in a program in inches that one in mm calls.
TEST(SingleTouches, AnswerInTheUnitOfTheMainProgram) {
  Bench bench = standards();
  const TableFolder folder(bench);
  bench.program = (bench.setup.beliefs.tables / "MAIN.H").string();
  const std::string go = "L Z+3 R0 FMAX\nL X+0 Y+3.149606 R0 FMAX\nL Z+0.5 R0 FMAX\n";
  const std::string touches =
      go + "TCH PROBE 0.0 REF. PLANE Q1 Z-\nTCH PROBE 0.1 X+0 Y+3.149606 Z+0.5\n" +
      "TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 Z ANGLE: +180\n"
      "TCH PROBE 3.3 DIST +1 F20 MB1 REFERENCE SYSTEM: 0\nTCH PROBE 4.0 M\nTCH PROBE 4.1 Q20\nTCH PROBE 4.2 IZ-1\n"
      "TCH PROBE 4.3 ABST+1 F20 MB1 REFERENCE SYSTEM:0\n" +
      probe(444, {{263, 0}, {264, 3.149606}, {294, 0.19}, {581, 0}, {582, 0}, {583, 1}, {320, 0}, {260, 1}, {309, 0}},
            " ~\n  QS400=\"0.01-0.01\" ;T");
  folder.put("SUB.H", "BEGIN PGM SUB INCH\n" + touches + "END PGM SUB INCH\n");
  const Ran ran = bench.run("CALL PGM SUB.H\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(1), 5, 1e-6);
  EXPECT_NEAR(ran.q(117), 5 + 100, 1e-6);
  EXPECT_NEAR(ran.q(12), 5 + 2, 1e-6);
  EXPECT_NEAR(ran.q(22), 5 + 2, 1e-6);
  EXPECT_NEAR(ran.q(153), 5, 1e-6);
  EXPECT_NEAR(ran.q(164), 5 - 0.19 * 25.4, 1e-6);
  // The tolerance is that of the program with the cycle: 0.254 mm.
  EXPECT_EQ(ran.q(183), 0);
  EXPECT_THAT(ran.log("TCHPR444.html"), HasSubstr("<td>4.5720</td><td>5.0800</td><td>5.0000</td>"));
}

/// A tool that broke is locked: the control does not take it into the spindle any more.
TEST(MonitoredTool, IsNotCalledOnceLocked) {
  Bench bench = standards();
  const TableFolder folder(bench);
  hh::TypedTable tools = hh::defaultToolTable(newer);
  ASSERT_TRUE(tools.setText("5", "NAME", "MILL"));
  ASSERT_TRUE(tools.setText("5", "TL", "L"));
  folder.put("TOOL.T", tools);
  const Ran ran = bench.runBare("TOOL CALL 5 Z\n");
  EXPECT_EQ(ran.alarm(), "Tool locked");
  EXPECT_THAT(ran.why(), HasSubstr("TL"));
}

/// maxTouchFeed is the highest feed of cycle 441, on the newer control; rapid traverse is no feed.
TEST(Cycle441, IsLimitedByTheMachineParameter) {
  const auto seconds = [](ControlKind kind, const std::string& feed, double limit, int warned) {
    Bench bench = standards(kind);
    if (kind == newer) bench.setup.beliefs.parameters["maxTouchFeed"] = {limit, {}};
    const Ran ran =
        bench.run(fmt::format("TCH PROBE 441 FAST PROBING ~\n Q396={} ~\n Q397=0 ~\n Q399=0 ~\n Q400=0\n", feed) +
                  probe(427, {{263, 70},
                              {264, 0},
                              {261, -8},
                              {320, 1},
                              {272, 1},
                              {267, 1},
                              {260, 20},
                              {281, 0},
                              {288, 0},
                              {289, 0},
                              {309, 0},
                              {330, 0}}));
    EXPECT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(160), 70, 1e-6);
    const auto& events = ran.outcome.journal.events;
    EXPECT_EQ(std::ranges::count_if(
                  events, [](const auto& event) { return event.text.find("maxTouchFeed") != std::string::npos; }),
              warned);
    return ran.cycle().endSeconds - ran.cycle().startSeconds;
  };
  EXPECT_NEAR(seconds(newer, "5000", 1000, 1), seconds(newer, "1000", 1000, 0), 1e-6);
  EXPECT_LT(seconds(newer, "1500", 3000, 0), seconds(newer, "1000", 3000, 0) - 1);
  EXPECT_LT(seconds(newer, "FMAX", 1000, 0), seconds(newer, "1000", 1000, 0) - 1);
  EXPECT_LT(seconds(older, "5000", 1000, 0), seconds(older, "1000", 1000, 0) - 1);
}

}  // namespace
}  // namespace probewright::testing_support
