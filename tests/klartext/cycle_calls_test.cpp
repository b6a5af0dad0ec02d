#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"

namespace probewright::language::klartext::testing {
namespace {

using ::testing::HasSubstr;

std::string messageOf(const RunResult& result) {
  return result.diagnostics.empty() ? std::string("none") : result.diagnostics.front().message;
}

TEST(CycleCalls, MachiningCyclesAreSkippedOrRefused) {
  const std::string program = "CYCL DEF 200 DRILLING ~\n Q200=2 ~\n Q201=-20\nL X+1 Y+1 FMAX M99\nCYCL CALL\n";
  World world;
  expectFinished(world.run(program));
  EXPECT_EQ(std::ranges::count(world.control->journal.events, control::EventKind::Skipped, &control::EventRecord::kind),
            1);
  world.options.strict = true;
  EXPECT_EQ(world.run(program).end, RunEnd::Alarm);
}

/// A program that counts its calls in Q1 and adds where it stood to Q2.
World counting() {
  World world;
  world.library.texts["COUNT.H"] =
      "BEGIN PGM COUNT MM\nQ1 = Q1 + 1\nFN 18: SYSREAD Q3 = ID270 NR1 IDX1\nQ2 = Q2 + Q3\nEND PGM COUNT MM\n";
  return world;
}

const std::string count = "CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM COUNT.H\n";

TEST(CycleCalls, CycleTwelveCallsItsProgramByCyclCallAndM99) {
  World world = counting();
  expectFinished(world.run(count + "L X+0 Y+0 FMAX\nL X+5 FMAX M99\nL X+7 FMAX\nCYCL CALL\nQ10 = 1\n"));
  EXPECT_EQ(world.q(1), 2);
  EXPECT_EQ(world.q(2), 12);
  EXPECT_EQ(world.q(10), 1);
}

TEST(CycleCalls, M89CallsBehindEveryMoveUntilM99OrTheNextCycle) {
  World world = counting();
  expectFinished(world.run(count + "L X+1 FMAX M89\nL X+2 FMAX\nCC X+50 Y+50\nL F500\nL X+3 FMAX M99\nL X+4 FMAX\n"));
  EXPECT_EQ(world.q(1), 3);
  EXPECT_EQ(world.q(2), 6);
  World other = counting();
  expectFinished(other.run(count + "L X+1 FMAX M89\n" + count + "L X+2 FMAX\n"));
  EXPECT_EQ(other.q(1), 1);
}

TEST(CycleCalls, CyclCallPosGoesToThePositionFirst) {
  World world = counting();
  expectFinished(world.run("TOOL CALL 1 Z\nL X+0 Y+0 Z+20 FMAX\n" + count + "CYCL CALL POS X+30 Y+40 Z+5 FMAX\n"));
  expectPath(world, {{0, 0, 20}, {30, 40, 20}, {30, 40, 5}});
  EXPECT_EQ(world.q(2), 30);
}

TEST(CycleCalls, SkippedCyclesStayAboveTheirPosition) {
  World world;
  expectFinished(
      world.run("TOOL CALL 1 Z\nL X+0 Y+0 Z+20 FMAX\nCYCL DEF 200 DRILLING ~\n Q200=2\n"
                "CYCL CALL POS X+30 Y+40 Z+5 FMAX\n"));
  expectPath(world, {{0, 0, 20}, {30, 40, 20}});
}

TEST(CycleCalls, RadiusCompensationEndsInFrontOfTheProgram) {
  World world = counting();
  expectFinished(world.run("TOOL CALL 5 Z\nL X-20 Y-20 FMAX\n" + count + "L X+0 Y+0 RL F500\nL X+10 M99\n"));
  EXPECT_EQ(world.q(1), 1);
  EXPECT_EQ(world.q(3), 10);
}

TEST(CycleCalls, AProgramThatCallsItselfByItsCycleIsStopped) {
  World world;
  world.library.texts["SELF.H"] = "BEGIN PGM SELF MM\nCYCL CALL\nEND PGM SELF MM\n";
  const RunResult result = world.run("CYCL DEF 12.0\nCYCL DEF 12.1 PGM SELF.H\nCYCL CALL\n");
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_THAT(messageOf(result), HasSubstr("call each other"));
}

TEST(CycleCalls, MistakesOfCycleTwelve) {
  World world;
  EXPECT_THAT(messageOf(world.run("CYCL DEF 12.0\nCYCL DEF 12.1 PGM NONE.H\nCYCL CALL\n")), HasSubstr("NONE.H"));
  EXPECT_THAT(messageOf(world.run("CYCL DEF 12.0 PGM CALL\nCYCL CALL\n")), HasSubstr("12.1"));
  EXPECT_THAT(messageOf(world.run("CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM\n")), HasSubstr("name of a program"));
  EXPECT_THAT(messageOf(world.run("CYCL CALL\n")), HasSubstr("no cycle defined"));
}

TEST(CycleCalls, FeedsOfCyclesPerRevolutionAndTooth) {
  World world;
  ASSERT_TRUE(world.control->tables.tools.setNumber("5", "CUT", 4));
  // GLOBAL DEF keeps what a cycle's feed comes to.
  expectFinished(world.run("TOOL CALL 5 Z S1000\nGLOBAL DEF 105 MILLING ~\n Q207=FZ0.1 ~\n Q206=FU0.2\n"));
  EXPECT_DOUBLE_EQ(world.control->globalDefinitions.at(207).value, 400);
  EXPECT_DOUBLE_EQ(world.control->globalDefinitions.at(206).value, 200);
}

}  // namespace
}  // namespace probewright::language::klartext::testing
