#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"
#include "language/klartext/m_functions.hpp"
#include "machine/machine_file.hpp"

namespace probewright::language::klartext::testing {

using namespace execution;
using namespace execution::klartext;
namespace {

using control::ControlKind;
using control::EventKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::array fiveAxes = {"mill5-table-table", "mill5-head-table", "mill5-head-head"};

Vector3 direction(double degrees) {
  const double angle = radiansFromDegrees(degrees);
  return {std::cos(angle), std::sin(angle), 0};
}

/// Where the tip is in the system of preset 0, which lies in the machine's origin.
Vector3 tipOf(const World& world) {
  return world.control->channel.machineFromAxes(world.control->channel.axes()).vector();
}

void turnPreset(World& world, double degrees) {
  control::heidenhain::Control::PresetChange change;
  change.origin = {0, 0, 0};
  change.spaceAngles[2] = degrees;
  world.control->writePreset(0, change);
  world.control->activatePreset(0);
}

/// MB is a length of the program and follows its scaling; the way leads from the workpiece to the spindle, mirrored or
/// not.
TEST(MFunctions, M140RetractsAlongTheToolUnderScalingAndMirrorImages) {
  struct Case {
    const char* before;
    double way;
  };
  for (const Case& each : {Case{"", 20},
                           {"CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL0.5\n", 10},
                           {"CYCL DEF 26.0 SCALING\nCYCL DEF 26.1 X0.5\n", 20},
                           {"CYCL DEF 26.0 SCALING\nCYCL DEF 26.1 Z0.5\n", 10},
                           {"CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X Y\n", 20},
                           {"TRANS MIRROR AXIS X Y Z\n", 20},
                           {"CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+35\n", 20}}) {
    World world;
    expectFinished(
        world.run("TOOL CALL 1 Z\nL X+10 Y+20 Z-30 R0 FMAX\n" + std::string(each.before) + "L M140 MB20 F500\n"));
    EXPECT_TRUE(near(tipOf(world), {10, 20, -30 + each.way})) << each.before << tipOf(world).transpose();
    EXPECT_EQ(world.machine->steps.back().feed.perMinute, 500);
  }
  // In the tilted plane along its normal; the machine's limit ends MB MAX.
  World tilted("mill5-head-head");
  expectFinished(
      tilted.run("TOOL CALL 1 Z\nPLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN FMAX\nL X+0 Y+0 Z-50 R0 FMAX\n"
                 "CYCL DEF 26.0 SCALING\nCYCL DEF 26.1 Y0.5\nM140 MB40 FMAX\n"));
  const double tilt = radiansFromDegrees(30);
  EXPECT_TRUE(near(tipOf(tilted), -10 * Vector3(0, -std::sin(tilt), std::cos(tilt)), 1e-6))
      << tipOf(tilted).transpose();
  World highest;
  expectFinished(highest.run("TOOL CALL 1 Z\nTRANS MIRROR AXIS X Y Z\nL Z+150 R0 FMAX\nM140 MB MAX\n"));
  EXPECT_NEAR(highest.machine->steps.back().axes[2], highest.machine->description().axes[2].maximum, 1e-5);
}

TEST(MFunctions, M143EndsTheBasicRotation) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    World world("mill3", kind);
    turnPreset(world, 10);
    expectFinished(world.run("L X+10 Y+0 Z+0 R0 FMAX\nM143\nL X+10 Y+0 R0 FMAX\n"));
    ASSERT_EQ(world.machine->steps.size(), 2U);
    const auto& steps = world.machine->steps;
    EXPECT_TRUE(near({steps[0].axes[0], steps[0].axes[1], 0}, 10 * direction(10)));
    EXPECT_TRUE(near({steps[1].axes[0], steps[1].axes[1], 0}, {10, 0, 0}));
    // The TNC 640 clears its preset as well.
    const auto& presets = world.control->tables.presets;
    const bool clears = kind == ControlKind::TNC640;
    EXPECT_EQ(clears ? presets.numberOr("0", "SPC", -1) : presets.numberOr("0", "ROT", -1), clears ? 0 : 10);
  }
}

TEST(MFunctions, M130GoesToCoordinatesThatAreNotTilted) {
  for (const char* machine : fiveAxes) {
    World world(machine);
    expectFinished(
        world.run("TOOL CALL 1 Z\nCYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+3\nPLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN FMAX\n"
                  "L X+10 Y+15 Z+120 R0 FMAX M130\n"));
    EXPECT_TRUE(near(tipOf(world), {13, 15, 120}, 1e-6)) << machine;
    World next(machine);
    expectFinished(
        next.run("TOOL CALL 1 Z\nPLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN FMAX\n"
                 "L X+10 Y+15 Z+120 R0 FMAX M130\nL IZ+10 R0 FMAX\n"));
    // The next block is one of the tilted plane again: along the tool.
    const double tilt = radiansFromDegrees(20);
    EXPECT_TRUE(near(tipOf(next), {10 + 10 * std::sin(tilt), 15, 120 + 10 * std::cos(tilt)}, 1e-6)) << machine;
  }
}

/// M91, M92 and M130 act on straight lines: in other blocks they are refused or named, never passed over.
TEST(MFunctions, OfStraightLinesAreRefusedInOtherBlocks) {
  const std::string start = "L X+20 Y+0 Z+0 R0 F500\nCC X+0 Y+0\n";
  for (const char* block : {"C X+0 Y+20 DR+", "CT X+5 Y+5", "CP IPA+90 DR+", "CR X+0 Y+20 R+20 DR+", "CC X+5 Y+5",
                            "LP PR+10 PA+0", "APPR LT X+40 Y+20 LEN5 RR"}) {
    for (const char* function : {" M91\n", " M92\n"}) {
      World world;
      const RunResult refused = world.run(start + block + function);
      ASSERT_EQ(refused.end, RunEnd::Alarm) << block << function;
      EXPECT_EQ(refused.diagnostics.front().message, "M91 and M92 take axes in straight lines only");
    }
  }
  World world("mill5-head-table");
  expectFinished(world.run(start + "C X+0 Y+20 DR+ M130\nC X-20 Y+0 DR+ M130\n"));
  EXPECT_THAT(world.told(EventKind::Skipped),
              ElementsAre("M130 in a block other than a straight line is not simulated and was skipped"));
  // The same functions in straight lines of both languages' axes.
  World straight;
  expectFinished(straight.run("L X+5 R0 FMAX M91\nX+7 R0 FMAX M92\n"));
  EXPECT_EQ(straight.machine->steps.back().axes[0], 7 + straight.machine->description().toolChange[0]);
}

TEST(MFunctions, M92CountsFromWhereToolsAreChanged) {
  auto description = machine::readMachine("mill3");
  ASSERT_TRUE(description) << format(description.error());
  description->toolChange[0] = 40;
  description->toolChange[2] = -60;
  World world(*description);
  expectFinished(world.run("L X+7 Z-5 R0 FMAX M92\nL IX+1 R0 FMAX M92\n"));
  ASSERT_EQ(world.machine->steps.size(), 2U);
  EXPECT_EQ(world.machine->steps[0].axes[0], 47);
  EXPECT_EQ(world.machine->steps[0].axes[2], -65);
  EXPECT_EQ(world.machine->steps[1].axes[0], 48);
}

TEST(MFunctions, M144CountsTiltedAxesInAndMovesNothingByItself) {
  const std::string moves = "L X+0 Y+0 Z+200 R0 FMAX\nL A+30 R0 FMAX\nL X+5 Y+0 Z+100 R0 FMAX\n";
  World guided("mill5-head-head"), counted("mill5-head-head"), plain("mill5-head-head");
  expectFinished(guided.run("TOOL CALL 1 Z\nM128\n" + moves));
  expectFinished(counted.run("TOOL CALL 1 Z\nM144\n" + moves));
  expectFinished(plain.run("TOOL CALL 1 Z\nM144\nM145\n" + moves));
  EXPECT_EQ(counted.machine->steps.back().axes, guided.machine->steps.back().axes);
  EXPECT_TRUE(near(tipOf(counted), {5, 0, 100}, 1e-6));
  ASSERT_EQ(counted.machine->steps.size(), 3U);
  const auto &before = counted.machine->steps[0].axes, &turned = counted.machine->steps[1].axes;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(turned[i], before[i]);
  EXPECT_EQ(plain.machine->steps.back().axes[2], 200);
}

TEST(MFunctions, M114OfTheOlderControlHoldsTheTip) {
  World older("mill5-head-head", ControlKind::iTNC530), newer("mill5-head-head");
  const std::string program = "TOOL CALL 1 Z\nM114\nL X+0 Y+0 Z+100 R0 FMAX\nL A+30 R0 FMAX\n";
  expectFinished(older.run(program));
  EXPECT_TRUE(near(tipOf(older), {0, 0, 100}, 1e-6));
  expectFinished(newer.run(program));
  EXPECT_THAT(newer.told(EventKind::Skipped),
              ElementsAre("M114, which the TNC640 does not have, is not simulated and was skipped"));
}

TEST(MFunctions, M136CountsTheFeedPerRevolution) {
  World world;
  expectFinished(world.run("TOOL CALL 1 Z S1000\nL X+100 R0 F0.5 M136\nL X+0 F0.2\nL X+10 FU0.3\nL X+20 F700 M137\n"));
  std::vector<double> feeds;
  for (const TraceMachine::Step& step : world.machine->steps)
    feeds.push_back(step.feed.perMinute);
  EXPECT_THAT(feeds, ElementsAre(500, 200, 300, 700));
}

TEST(MFunctions, M94TakesWholeTurnsFromTheReading) {
  World world("mill5-head-table");
  expectFinished(
      world.run("L C+730 R0 FMAX\nM94 C\nFN 18: SYSREAD Q1 = ID270 NR1 IDX6\nL C+15 R0 FMAX\n"
                "L C+20 R0 FMAX M91\n"));
  EXPECT_NEAR(world.q(1), 10, 1e-9);
  const auto axis = world.machine->description().axisIndex("C");
  ASSERT_TRUE(axis);
  EXPECT_NEAR(world.machine->steps[1].axes[*axis], 735, 1e-9);
  EXPECT_NEAR(world.machine->steps[2].axes[*axis], 740, 1e-9);
}

/// Cycle 13 only says where to.
TEST(MFunctions, M19AndM20OrientTheSpindleToTheAngleOfCycle13) {
  const std::string cycle = "CYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE 75\n";
  World still;
  expectFinished(still.run("TOOL CALL 1 Z S500\n" + cycle + "L X+5 R0 FMAX\n"));
  EXPECT_EQ(still.control->channel.spindleAngle(), 0) << "the cycle alone turns nothing";
  for (const std::string function : {"M19", "M20"}) {
    World world, without;
    expectFinished(world.run("TOOL CALL 1 Z S500\nM3\n" + cycle + "L X+5 R0 FMAX " + function + "\n"));
    EXPECT_EQ(world.control->channel.spindleAngle(), 75);
    EXPECT_TRUE(world.told(EventKind::Skipped).empty());
    without.machine->orientSpindle(33);
    expectFinished(without.run("TOOL CALL 1 Z\n" + function + "\n"));
    EXPECT_EQ(without.control->channel.spindleAngle(), 0) << "as the builder has fixed it";
  }
  // As the manuals print it, in the words of two editions, and in each mode that they name.
  for (const std::string printed : {"93 CYCL DEF 13.0 ORIENT.OSTAN.SPIND\n94 CYCL DEF 13.1 UGOL 180\n",
                                    "93 CYCL DEF 13.0 ORIENTERING\n94 CYCL DEF 13.1 VINKEL 180\n"}) {
    for (const std::string mode : {"MILL", "TURN", "DRESS"}) {
      World turned;
      expectFinished(turned.run("FUNCTION MODE " + mode + "\nTOOL CALL 1 Z\n" + printed + "M19\n"));
      EXPECT_EQ(turned.control->channel.spindleAngle(), 180) << mode;
    }
  }
  World world;
  EXPECT_EQ(world.run("Q1 = -1\nCYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE Q1\n").end, RunEnd::Alarm);
  const RunResult beyond = world.run("Q1 = 361\nCYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE Q1\n");
  EXPECT_EQ(beyond.end, RunEnd::Alarm);
  // The manual's range is 0 to 360 degrees, with both of its ends.
  for (const int end : {0, 360}) {
    World turned;
    expectFinished(turned.run("TOOL CALL 1 Z\nQ1 = " + std::to_string(end) +
                              "\nCYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE Q1\nM19\n"));
    EXPECT_EQ(std::fmod(turned.control->channel.spindleAngle(), 360), 0) << end;
  }
}

TEST(MFunctions, WhatIsNotCarriedOutIsNamedOnce) {
  World world;
  expectFinished(
      world.run("LBL 1\nM25\nM138 A C\nL X+1 R0 FMAX M8\nM116\nM118 X1\nM103 F0.5\nM10 M11\nCALL LBL 1 REP2\n"));
  EXPECT_THAT(world.told(EventKind::Skipped),
              ElementsAre("M25, which is a function of the machine tool builder, is not simulated and was skipped",
                          "M138 is not simulated and was skipped",
                          "M10, which is a function of the machine tool builder, is not simulated and was skipped",
                          "M11, which is a function of the machine tool builder, is not simulated and was skipped"));
  EXPECT_EQ(world.q(111), 1);
  world.options.strict = true;
  const RunResult refused = world.run("L X+1 R0 FMAX\nM138 A C\n");
  ASSERT_EQ(refused.end, RunEnd::Alarm);
  EXPECT_EQ(refused.diagnostics.front().message, "M138 is not simulated");
  EXPECT_EQ(refused.diagnostics.front().place.line, 2U);
}

/// No M function is ignored in silence: what is neither carried out nor without an effect on positions is named.
TEST(MFunctions, EachOneIsCarriedOutOrHarmlessOrNamed) {
  for (int number = 0; number < 1000; ++number) {
    const FunctionEffect effect = effectOf(number, ControlKind::TNC640);
    if (effect == FunctionEffect::CarriedOut) continue;
    World world("mill5-head-table");
    expectFinished(world.run("M" + std::to_string(number) + "\n"));
    EXPECT_EQ(world.told(EventKind::Skipped).size(), effect == FunctionEffect::Harmless ? 0U : 1U) << number;
  }
}

TEST(MFunctions, FunctionBlocksThatMoveNothingAreQuiet) {
  World world;
  expectFinished(
      world.run("FUNCTION DWELL TIME2.5\nFUNCTION FEED DWELL D-TIME0.5 F-TIME2\nFUNCTION COUNT INC\n"
                "FUNCTION DCM OFF\n"));
  EXPECT_THAT(world.told(EventKind::Skipped), IsEmpty());
  EXPECT_EQ(world.machine->seconds(), 2.5);
  expectFinished(world.run("TOOL CALL 1 Z S120\nM3\nFUNCTION DWELL REV5\nFUNCTION TURNDATA SPIN VCONST:ON VC:100\n"));
  EXPECT_THAT(world.told(EventKind::Skipped), IsEmpty());
  EXPECT_EQ(world.machine->seconds(), 5);
  expectFinished(world.run("LBL 1\nFUNCTION PARAXCOMP DISPLAY W\nFUNCTION PARAXCOMP DISPLAY W\n"));
  EXPECT_THAT(world.told(EventKind::Skipped),
              ElementsAre("FUNCTION PARAXCOMP DISPLAY W is not simulated and was skipped"));
}

TEST(MFunctions, M30InACalledProgramIsNamed) {
  World world;
  world.library.texts["SUB.H"] = "0 BEGIN PGM SUB MM\n1 Q1 = 5\n2 M30\n3 END PGM SUB MM\n";
  expectFinished(world.run("CALL PGM SUB.H\nCALL PGM SUB.H\nQ2 = Q1\n"));
  EXPECT_EQ(world.q(2), 5);
  EXPECT_THAT(world.told(EventKind::Warning),
              ElementsAre("M2 or M30 in a called program ends only that program; the calling program continues"));
}

}  // namespace
}  // namespace probewright::language::klartext::testing
