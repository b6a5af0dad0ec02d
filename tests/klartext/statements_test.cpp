#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"

namespace probewright::language::klartext::testing {
namespace {

using control::ControlKind;
using control::EventKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string alarmOf(World& world, const std::string& program) {
  const RunResult result = world.run(program);
  if (result.end != RunEnd::Alarm) return "no alarm";
  return result.diagnostics.front().code + ": " + result.diagnostics.front().message;
}

// ---- parameters ----

TEST(Statements, ParametersThatNobodySetAreUndefined) {
  World world;
  world.library.texts["SUB.H"] =
      "0 BEGIN PGM SUB MM\n1 FN 9: IF +QL7 IS UNDEFINED GOTO LBL 1\n2 Q90 = 1\n3 LBL 1\n"
      "4 END PGM SUB MM\n";
  expectFinished(world.run(
      "FN 9: IF +Q1500 IS DEFINED GOTO LBL 9\nQ1 = 1\nFN 9: IF +QL7 IS DEFINED GOTO LBL 9\nQ2 = 1\n"
      "FN 9: IF +QR7 IS DEFINED GOTO LBL 9\nQ3 = 1\nQL7 = 5\nQR7 = 0\nFN 9: IF +QL7 IS UNDEFINED GOTO LBL 9\n"
      "FN 9: IF +QR7 IS UNDEFINED GOTO LBL 9\nCALL PGM SUB.H\nQ4 = 1\nFN 0: QL7 SET UNDEFINED\nFN 0: Q4 SET UNDEFINED\n"
      "FN 9: IF +QL7 IS DEFINED GOTO LBL 9\nFN 9: IF +Q4 IS DEFINED GOTO LBL 9\nQ5 = 1\nLBL 9\n"));
  for (const int number : {1, 2, 3, 5})
    EXPECT_EQ(world.q(number), 1) << number;
  EXPECT_EQ(world.q(90), 0);
}

TEST(Statements, TheLengthOfATextThatNobodySetIsMinusOne) {
  World world;
  expectFinished(
      world.run("Q1 = STRLEN( SRC_QS7 )\nQS7 = \"\"\nQ2 = STRLEN( SRC_QS7 )\nQS7 = \"ABC\"\n"
                "Q3 = STRLEN( SRC_QS7 )\nFN 0: QS7 SET UNDEFINED\nQ4 = STRLEN( SRC_QS7 )\n"));
  EXPECT_EQ(world.q(1), -1);
  EXPECT_EQ(world.q(2), 0);
  EXPECT_EQ(world.q(3), 3);
  EXPECT_EQ(world.q(4), -1);
}

// ---- calls ----

TEST(Statements, ALabelThatIsRepeatedZeroTimesIsCalled) {
  World world;
  expectFinished(world.run("CALL LBL 1 REP0\nCALL LBL 1 REP 0/0\nM30\nLBL 1\nQ1 = Q1 + 1\nLBL 0\n"));
  EXPECT_EQ(world.q(1), 2);
}

TEST(Statements, SelCycleIsCalledLikeCycle12) {
  World world;
  world.library.texts["HOLE.H"] = "0 BEGIN PGM HOLE MM\n1 Q1 = Q1 + 1\n2 END PGM HOLE MM\n";
  expectFinished(
      world.run("SEL CYCLE \"HOLE.H\"\nCYCL CALL\nL X+1 R0 FMAX M99\nQS1 = \"HOLE.H\"\nSEL CYCLE QS1\n"
                "PATTERN DEF POS1 (X+5 Y+0 Z+0) POS2 (X+9 Y+0 Z+0)\nCYCL CALL PAT FMAX\n"));
  EXPECT_EQ(world.q(1), 4);
}

// ---- tables ----

TEST(Statements, TabdataReadsAndWritesTheTablesOfTheControl) {
  World world;
  expectFinished(
      world.run("TOOL CALL 5 Z\nTABDATA READ Q1 = TOOL COLUMN \"L\" KEY \"5\"\n"
                "TABDATA WRITE TOOL COLUMN \"DL\" KEY \"5\" = +0.25\nL Z+0 R0 FMAX\n"
                "TABDATA ADD TOOL COLUMN \"DL\" KEY \"5\" = +0.5\nL Z+0 R0 FMAX\n"
                "TABDATA READ QS1 = TOOL COLUMN \"NAME\" KEY \"5\"\n"
                "TABDATA WRITE PRESET COLUMN \"X\" KEY \"0\" = +12\nL X+1 R0 FMAX\n"
                "QS2 = \"0\"\nTABDATA READ Q2 = PRESET COLUMN \"X\" KEY QS2\nOPEN FILE \"PART.H\"\n"));
  EXPECT_EQ(world.q(1), 50);
  EXPECT_EQ(world.q(2), 12);
  EXPECT_EQ(world.control->q.qs(1), "MILL");
  ASSERT_EQ(world.machine->steps.size(), 3U);
  EXPECT_NEAR(world.machine->steps[0].axes[2], 50.25, 1e-9);
  EXPECT_NEAR(world.machine->steps[1].axes[2], 50.75, 1e-9);
  EXPECT_NEAR(world.machine->steps[2].axes[0], 13, 1e-9);
  EXPECT_EQ(world.control->tables.tools.numberOr("5", "DL", 0), 0.75);
  // A rotation of the active preset is in effect at once.
  expectFinished(
      world.run("TABDATA WRITE PRESET COLUMN \"X\" KEY \"0\" = +0\nTABDATA WRITE PRESET COLUMN \"SPC\" KEY \"0\" = "
                "+90\nL X+10 Y+0 R0 FMAX\n"));
  EXPECT_NEAR(world.machine->steps.back().axes[0], 0, 1e-9);
  EXPECT_NEAR(world.machine->steps.back().axes[1], 10, 1e-9);
  EXPECT_EQ(alarmOf(world, "TABDATA READ Q1 = TOOL COLUMN \"LENGTH\" KEY \"5\"\n"),
            "Table entry missing: TOOL.T has no column LENGTH");
  EXPECT_EQ(alarmOf(world, "TABDATA WRITE PRESET COLUMN \"X\" KEY \"77\" = +1\n"),
            "Table entry missing: PRESET.PR has no row 77");
}

// ---- the older control ----

TEST(Statements, Fn15OfTheOlderControlPrintsValues) {
  World world("mill3", ControlKind::iTNC530);
  expectFinished(world.run("Q5 = -12.5\nQ6 = 1 / 3\nQS3 = \"HOLE\"\nFN 15: PRINT 20/Q5/QS3\nFN15: PRINT +Q6/Q7\n"));
  EXPECT_EQ(world.control->panel.files().at("%FN15RUN.A"), "+20  -12,5  HOLE\n+0,3333  +0\n");
}

TEST(Statements, Fn15NamesWhatItCannotPrint) {
  World world("mill3", control::ControlKind::iTNC530);
  const RunResult refused = world.run("FN 15: PRINT TNC:\\DIR\\MASK.A\n");
  ASSERT_EQ(refused.end, RunEnd::Alarm);
  EXPECT_EQ(refused.diagnostics.front().code, "FN 15: value wrong");
  EXPECT_EQ(refused.diagnostics.front().message, "TNC:\\DIR\\MASK.A is neither a number nor a Q parameter");
}

TEST(Statements, SystemDataOfTheOlderControl) {
  World world("mill5-head-table", ControlKind::iTNC530);
  expectFinished(
      world.run("TOOL CALL 1 Z\nFN 17: SYSWRITE ID503 NR4 IDX1 = +17.5\nFN 17: SYSWRITE ID503 NR4 IDX6 = +3\n"
                "FN 18: SYSREAD Q1 = ID503 NR4 IDX1\nFN 18: SYSREAD Q2 = ID50 NR1 IDX0\n"
                "FN 18: SYSREAD Q3 = ID50 NR1 IDX1\nFN 18: SYSREAD Q4 = ID50 NR1\n"
                "FN 17: SYSWRITE ID50 NR36 IDX5 = +21\n"));
  EXPECT_EQ(world.q(1), 17.5);
  EXPECT_EQ(world.control->tables.presets.numberOr("4", "C", -1), 3);
  EXPECT_EQ(world.q(2), 0);  // tool 0
  EXPECT_EQ(world.q(3), 100);
  EXPECT_EQ(world.q(4), 100);
  EXPECT_THAT(world.told(EventKind::Skipped),
              ElementsAre("The type of a tool, for which TOOL.T has no column TYP, is not simulated and was skipped"));
  World newer;
  expectFinished(newer.run("FN 17: SYSWRITE ID50 NR36 IDX5 = +21\nFN 18: SYSREAD Q5 = ID50 NR36 IDX5\n"));
  EXPECT_EQ(newer.q(5), 21);
  EXPECT_EQ(newer.control->tables.tools.text("5", "TYP"), "TCHP");
  const RunResult unknown = newer.run("FN 17: SYSWRITE ID50 NR36 IDX5 = +77\n");
  ASSERT_EQ(unknown.end, RunEnd::Alarm);
  EXPECT_EQ(unknown.diagnostics.front().message,
            "FN 17 writes the type of a tool (ID50 NR36) as 0, a mill, or 21, a touch probe, not as 77");
  EXPECT_EQ(unknown.diagnostics.front().advice, "enter other types in the column TYP of TOOL.T");
}

// ---- moves ----

TEST(Statements, ArcsLieInThePlaneOfTheirCentre) {
  World world;
  world.control->channel.pathTolerance = 1e-6;
  // In Z/X angles count from +Z towards +X: DR+ from X20 to Z20 is three quarters of a turn.
  expectFinished(world.run("TOOL CALL 1 Z\nL X+20 Y+7 Z+100 R0 F1000\nCC X+0 Z+100\nC X+0 Z+120 DR+\n"));
  double length = 0;
  const std::vector<Vector3> path = world.path();
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += (path[i] - path[i - 1]).norm();
    EXPECT_NEAR(std::hypot(path[i].x(), path[i].z() - 100), 20, 1e-5);
    EXPECT_NEAR(path[i].y(), 7, 1e-12);
  }
  EXPECT_TRUE(near(path.back(), {0, 7, 120}));
  EXPECT_NEAR(length, 1.5 * std::numbers::pi * 20, 1e-4);
  World polar;
  expectFinished(polar.run("TOOL CALL 1 Z\nCC Y+10 Z+100\nLP PR+5 PA+0 R0 FMAX\nCP PA+90 DR+ F1000\n"));
  EXPECT_TRUE(near(polar.path().front(), {0, 15, 100}));
  EXPECT_TRUE(near(polar.path().back(), {0, 10, 105}));
  World compensated;
  EXPECT_EQ(alarmOf(compensated, "TOOL CALL 1 Z\nL X+20 Z+0 R0 F1000\nCC X+0 Z+0\nC X+0 Z+20 DR- RL\n"),
            "Radius compensation not permitted: An arc that does not lie in the plane of the tool axis takes no radius "
            "compensation");
}

TEST(Statements, ALabelMayStandBetweenACentreAndItsCircle) {
  World world;
  expectFinished(world.run("TOOL CALL 1 Z\nL X+10 Y+0 R0 F500\nCC X+0 Y+0\nLBL 3\nCP IPA+90 DR+\nCALL LBL 3 REP2\n"));
  EXPECT_NEAR(world.path().back().x(), 0, 1e-9);
  EXPECT_NEAR(world.path().back().y(), -10, 1e-9);
}

TEST(Statements, MirroredRotaryAxesTurnTheOtherWay) {
  World world("mill5-head-table");
  const auto axis = world.machine->description().axisIndex("C");
  ASSERT_TRUE(axis);
  expectFinished(
      world.run("TRANS DATUM AXIS C+10\nTRANS MIRROR AXIS C\nL C+30 R0 FMAX\nL IC+5 R0 FMAX\n"
                "FN 18: SYSREAD Q1 = ID270 NR1 IDX6\nTRANS MIRROR RESET\nL C+30 R0 FMAX\n"));
  ASSERT_EQ(world.machine->steps.size(), 3U);
  EXPECT_NEAR(world.machine->steps[0].axes[*axis], 10 - 30, 1e-9);
  EXPECT_NEAR(world.machine->steps[1].axes[*axis], 10 - 35, 1e-9);
  EXPECT_NEAR(world.q(1), 35, 1e-9);
  EXPECT_NEAR(world.machine->steps[2].axes[*axis], 40, 1e-9);
}

TEST(Statements, AMirrorImageBeforeThePlaneIsTilted) {
  for (const char* machine : {"mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    for (const char* plane :
         {"PLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN FMAX", "PLANE SPATIAL SPA+15 SPB-10 SPC+5 TURN FMAX",
          "CYCL DEF 10.0 ROT\nCYCL DEF 10.1 ROT+30\nPLANE SPATIAL SPA+10 SPB+0 SPC+0 TURN FMAX"}) {
      World world(machine);
      expectFinished(world.run("TOOL CALL 1 Z\nCYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\n" + std::string(plane) + "\n"));
      // The plane's tool axis is the tool's.
      EXPECT_TRUE(near(world.control->channel.toolAxis().vector(), Vector3::UnitZ(), 1e-9)) << machine << " " << plane;
    }
  }
  World tilted("mill5-table-table");
  expectFinished(
      tilted.run("TOOL CALL 1 Z\nCYCL DEF 10.0 ROT\nCYCL DEF 10.1 ROT+30\nPLANE AXIAL A+20 C+0 TURN FMAX\n"));
  EXPECT_TRUE(near(tilted.control->channel.toolAxis().vector(), Vector3::UnitZ(), 1e-9));
  World refused("mill5-table-table");
  EXPECT_THAT(
      alarmOf(refused, "TOOL CALL 1 Z\nCYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 Z\nPLANE SPATIAL SPA+0 SPB+20 SPC+0 STAY\n"),
      HasSubstr("The tool axis is mirrored"));
  EXPECT_THAT(refused.told(EventKind::Warning),
              ElementsAre("The tool axis Z is mirrored here, which the control does not permit"));
}

TEST(Statements, ToolVectorsOfLinearBlocksTurnTheTool) {
  for (const char* machine : {"mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    World world(machine);
    expectFinished(
        world.run("TOOL CALL 1 Z\nL X+0 Y+0 Z+100 R0 FMAX\nM128\n"
                  "LN X+5 Y+2 Z+50 NX+0 NY+0 NZ+1 TX+0.2 TY-0.1 TZ+1 F1000\n"));
    EXPECT_TRUE(near(world.control->channel.toolAxis().vector(), Vector3(0.2, -0.1, 1).normalized(), 1e-9)) << machine;
    EXPECT_TRUE(near(world.control->channel.position().vector(), {5, 2, 50}, 1e-6)) << machine;
  }
  // The shortest way: from A-30 C+170 on to A-40, not back to A+40.
  World shortest("mill5-head-head");
  expectFinished(
      shortest.run("TOOL CALL 1 Z\nL X+0 Y+0 Z+100 R0 FMAX\nL A-30 C+170 R0 FMAX\nM128\n"
                   "LN X+5 Y+2 Z+50 NX+0 NY+0 NZ+1 TX+0 TY-0.6427876 TZ+0.7660444 F1000\n"));
  const auto& axes = shortest.control->channel.description();
  const auto turned = shortest.control->channel.axes();
  EXPECT_LT(std::abs(turned[*axes.axisIndex("A")] + 30) + std::abs(turned[*axes.axisIndex("C")] - 170), 21);
  World world("mill5-head-table");
  expectFinished(world.run("TOOL CALL 1 Z DL+0.1\nLN X+5 Y+2 Z+50 NX+0 NY+0 NZ+1 TX+0 TY+0 TZ+1 F1000\nX+9 R+\n"));
  EXPECT_THAT(
      world.told(EventKind::Skipped),
      ElementsAre("The 3-D compensation of tool oversizes in LN blocks is not simulated and was skipped",
                  "The tool direction TX, TY, TZ of LN blocks without M128 or FUNCTION TCPM is not simulated and "
                  "was skipped",
                  "The paraxial radius compensation R+ is not simulated and was skipped"));
}

TEST(Statements, FunctionTcpmTakesAFeedLimit) {
  World world("mill5-head-head");
  expectFinished(
      world.run("TOOL CALL 1 Z\nFUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT TIP-TIP F1000\n"
                "L X+0 Y+0 Z+100 R0 FMAX\nL A+20 R0 FMAX\nFUNCTION TCPM F CONT AXIS SPAT PATHCTRL VECTOR FMAX\n"));
  EXPECT_TRUE(near(world.control->channel.position().vector(), {0, 0, 100}, 1e-6));
}

// ---- FN 16 ----

TEST(Statements, TargetsOfFn16MayNameParameters) {
  World world;
  world.files["M.A"] = "\"X\";\n";
  world.files["MASK7.A"] = "\"Y\";\n";
  expectFinished(
      world.run("QS3 = \"LOG.TXT\"\nQL3 = 7\nQ4 = 12\nFN 16: F-PRINT M.A / :'QS3'\n"
                "FN 16: F-PRINT M.A / P:'QL3'.TXT\nFN 16: F-PRINT MASK:'QL3'.A / TNC:\\OUT\\:'Q4':_:'QS3'\n"));
  const auto& files = world.control->panel.files();
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files.at("LOG.TXT"), "X\n");
  EXPECT_EQ(files.at("P7.TXT"), "X\n");
  EXPECT_EQ(files.at("12_LOG.TXT"), "Y\n");
}

TEST(Statements, SignsOfFn16BehindABackslashAreThemselves) {
  World world;
  world.files["M.A"] = "\"new\\nline\\ttab \\\"x\\\" 5 %%\";\n";
  expectFinished(world.run("FN 16: F-PRINT M.A / L.TXT\n"));
  EXPECT_EQ(world.control->panel.files().at("L.TXT"), "new\nline\ttab \"x\" 5 %\n");
}

TEST(Statements, Fn16RefusesNamesThatAreNoLogOfItsOwn) {
  World world;
  world.files["M.A"] = "\"X\";\n";
  world.options.isInput = [](const std::string& name) { return name == "main.h"; };
  const auto refused = [&](const std::string& target) {
    return alarmOf(world, "FN 16: F-PRINT M.A / " + target + "\n");
  };
  EXPECT_EQ(refused("."), "FN 16: file wrong: . is a folder, not a file");
  EXPECT_EQ(refused("TNC:\\LOG\\.."), "FN 16: file wrong: .. is a folder, not a file");
  EXPECT_EQ(refused("tool.t"), "FN 16: file wrong: The run writes tool.t itself");
  EXPECT_EQ(refused("PRESET.PR"), "FN 16: file wrong: The run writes PRESET.PR itself");
  EXPECT_EQ(refused("OUT/results.json"), "FN 16: file wrong: The run writes results.json itself");
  EXPECT_EQ(refused("main.h"), "FN 16: file wrong: main.h is read by this run");
  EXPECT_THAT(refused(std::string(249, 'A')), HasSubstr("has 249 bytes; a name has at most 248"));
  EXPECT_EQ(refused(std::string(248, 'A')), "no alarm");
}

TEST(Statements, MasksThatAreWrongAreQuotedInShort) {
  World world;
  const auto said = [&](const std::string& mask) {
    world.files["M.A"] = mask;
    return alarmOf(world, "Q1 = 5\nFN 16: F-PRINT M.A / L.TXT\n");
  };
  EXPECT_EQ(said("\"A %F\", Q1, Q2;\n"),
            "FN 16: mask wrong: the format line \"A %F\", Q1, Q2 has more parameters than %");
  EXPECT_EQ(said("\"A\"\n\"B\";\n"), "FN 16: mask wrong: the format line \"A\" does not end with ;");
  EXPECT_EQ(said(std::string(500, 'X') + "\n"),
            "FN 16: mask wrong: " + std::string(80, 'X') + "... is neither a format line nor a keyword");
  EXPECT_EQ(said("\"A %F\",\n  Q1;\n"), "no alarm");
}

}  // namespace
}  // namespace probewright::language::klartext::testing
