#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"

namespace probewright::language::klartext::testing {
namespace {

using ::testing::HasSubstr;

std::string messageOf(const RunResult& result) {
  return result.diagnostics.empty() ? std::string("none") : result.diagnostics.front().message;
}

/// FN 25: the place with the first value gets the second one as its coordinate.
TEST(Shifts, Fn25SetsThePresetOfAnAxis) {
  World world;
  expectFinished(world.run("TOOL CALL 1 Z\nL X+10 Y+50 Z-100 R0 FMAX\nFN 25: PRESET = Y/+50/+100\nL Y+100 R0 FMAX\n"));
  EXPECT_NEAR(world.machine->position()[1], 50, 1e-9);
  EXPECT_NEAR(world.machine->position()[0], 10, 1e-9);
  expectFinished(world.run("FN 25: PRESET = X/+10/-2\nL X+0 Y+0 R0 FMAX\n"));
  EXPECT_NEAR(world.machine->position()[0], 12, 1e-9);
  EXPECT_NEAR(world.machine->position()[1], -50, 1e-9);
}

TEST(Shifts, OfRotaryAxesMoveTheirZero) {
  World world("mill5-table-table");
  expectFinished(
      world.run("TRANS DATUM AXIS C+30\nL C+5 FMAX\nFN 18: SYSREAD Q1 = ID270 NR1 IDX6\n"
                "FN 18: SYSREAD Q2 = ID220 NR2 IDX6\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 IC+10\n"
                "FN 18: SYSREAD Q3 = ID220 NR2 IDX6\nTRANS DATUM RESET\n"
                "FN 18: SYSREAD Q4 = ID270 NR1 IDX6\n"));
  EXPECT_NEAR(world.machine->position()[4], 35, 1e-9);
  EXPECT_NEAR(world.q(1), 5, 1e-9);
  EXPECT_NEAR(world.q(2), 30, 1e-9);
  EXPECT_NEAR(world.q(3), 40, 1e-9);
  EXPECT_NEAR(world.q(4), 35, 1e-9);
}

TEST(Shifts, OfRotaryAxesComeFromDatumTables) {
  World world("mill5-table-table");
  world.files["D.D"] =
      "BEGIN D.D MM\nD    X        Y        Z        A        B        C\n0    0        0        0        0        0   "
      "     0\n1    2        3        4        0        0        45\n[END]\n";
  expectFinished(world.run("SEL TABLE \"D.D\"\nCYCL DEF 7.0\nCYCL DEF 7.1 #1\nL X+1 C+0 FMAX\n"));
  EXPECT_NEAR(world.machine->position()[0], 3, 1e-9);
  EXPECT_NEAR(world.machine->position()[4], 45, 1e-9);
}

TEST(Shifts, OfAxesThatTheMachineLacks) {
  World world;
  expectFinished(world.run("CYCL DEF 7.0\nCYCL DEF 7.1 X+5\nCYCL DEF 7.2 C+0\n"));
  EXPECT_THAT(messageOf(world.run("TRANS DATUM AXIS C+5\n")), HasSubstr("no axis C"));
}

TEST(Shifts, EndWithThePreset) {
  World world("mill5-table-table");
  expectFinished(world.run("TRANS DATUM AXIS C+30\nPRESET SELECT #0\nL C+0 FMAX\n"));
  EXPECT_NEAR(world.machine->position()[4], 0, 1e-9);
}

TEST(Presets, AreSelectedByNumberOrTextAndKeepTransformations) {
  World world;
  ASSERT_TRUE(world.control->tables.presets.ensureRow("7"));
  ASSERT_TRUE(world.control->tables.presets.setText("7", "DOC", "VISE"));
  ASSERT_TRUE(world.control->tables.presets.setNumber("7", "X", 100));
  expectFinished(
      world.run("TRANS DATUM AXIS X+5\nPRESET SELECT \"VISE\" KEEP TRANS WP\nL X+1 FMAX\n"
                "PRESET SELECT #7\nL X+1 FMAX\n"));
  EXPECT_NEAR(world.machine->steps[0].axes[0], 106, 1e-9);
  EXPECT_NEAR(world.machine->steps[1].axes[0], 101, 1e-9);
  EXPECT_THAT(messageOf(world.run("PRESET SELECT \"NONE\"\n")), HasSubstr("NONE"));
  EXPECT_THAT(messageOf(world.run("PRESET SELECT #7 KEEP IT\n")), HasSubstr("TRANS is expected"));
  EXPECT_THAT(messageOf(world.run("PRESET SELECT #7 ALWAYS\n")), HasSubstr("block should end"));
}

TEST(Presets, AreCopiedWholeAndSelected) {
  World world("mill5-table-table");
  control::heidenhain::Control::PresetChange change;
  change.origin = {1, 2, 3};
  change.rotaryOffset[4] = 10;
  world.control->writePreset(1, change);
  expectFinished(world.run("PRESET COPY #1 TO #4 SELECT TARGET\nL X+0 C+5 FMAX\nPRESET CORR X+0.5\nL X+0 FMAX\n"));
  EXPECT_NEAR(world.machine->steps[0].axes[0], 1, 1e-9);
  EXPECT_NEAR(world.machine->steps[0].axes[4], 15, 1e-9);
  EXPECT_NEAR(world.machine->steps[1].axes[0], 1.5, 1e-9);
  EXPECT_EQ(world.control->coordinates.preset.row, 4);
}

TEST(Presets, AreCorrectedInAllThatTheyHold) {
  World world("mill5-table-table");
  control::heidenhain::Control::PresetChange change;
  change.origin = {1, 2, 3};
  change.spaceAngles[2] = 10;
  change.rotaryOffset[4] = 20;
  world.control->writePreset(1, change);
  expectFinished(world.run("PRESET SELECT #1\nPRESET CORR X+0.5 Z-1 SPC+45 C-4\nL C+0 FMAX\n"));
  const auto& row = world.control->coordinates.preset;
  EXPECT_TRUE(near(row.origin, {1.5, 2, 2}));
  EXPECT_NEAR(row.spaceAngles.z(), 55, 1e-9);
  EXPECT_NEAR(world.machine->steps.back().axes[4], 16, 1e-9);
  EXPECT_THAT(messageOf(world.run("PRESET CORR B+1\n")), HasSubstr("no axis B"));
}

/// Where the alarm of a run stands, and what it quotes.
std::string placeOf(const RunResult& result) {
  if (result.diagnostics.empty()) return "none";
  return std::to_string(result.diagnostics.front().place.line) + ": " + result.diagnostics.front().excerpt;
}

TEST(AlarmPlaces, NameTheElementOfTheContourThatWasUnderWay) {
  World world;
  world.machine->limitX = 50;
  const std::string contour = "TOOL CALL 5 Z\nL X-20 Y-20 FMAX\nL X+0 Y+0 RL F1000\n";
  EXPECT_EQ(placeOf(world.run(contour + "L X+100\nL Y+50\nL X+0\n")), "4: L X+100");
  EXPECT_EQ(placeOf(world.run(contour + "L Y+50\nL X+100\nL Y+80\nL X+0 R0\n")), "5: L X+100");
  // The corner's own block cuts the corner off.
  EXPECT_EQ(placeOf(world.run(contour + "L X+20\nRND R30\nL Y+10\nL X+0 R0\n")), "5: RND R30");
  EXPECT_EQ(placeOf(world.run("TOOL CALL 5 Z\nL X+0 Y+0 FMAX\nL X+100 R0 FMAX\nL Y+5 FMAX\n")), "3: L X+100 R0 FMAX");
}

TEST(AlarmPlaces, NameTheArcThatIsTooSmallForTheTool) {
  World world;
  EXPECT_EQ(
      placeOf(world.run("TOOL CALL 5 Z\nL X-20 Y-20 FMAX\nL X+0 Y+0 RL F1000\nL X+30\nCR X+30 Y+4 R2 DR+\nL X+0\n")),
      "5: CR X+30 Y+4 R2 DR+");
}

TEST(Collisions, StopTheProgramOrTheAxesAsTheTouchProbeTableSays) {
  const auto codeOf = [](const std::string& tool, const std::string& reaction) {
    World world;
    world.machine->limitX = 50;
    world.machine->beyondLimit = machine::MoveEnd::Collision;
    EXPECT_TRUE(world.control->tables.probes.setText("1", "REACTION", reaction));
    const RunResult result = world.run("TOOL CALL " + tool + " Z\nL X+100 FMAX\n");
    return result.diagnostics.empty() ? std::string("none") : result.diagnostics.front().code;
  };
  EXPECT_EQ(codeOf("1", "NCSTOP"), "Collision");
  EXPECT_EQ(codeOf("1", "EMERGSTOP"), "Emergency stop");
  EXPECT_EQ(codeOf("5", "EMERGSTOP"), "Collision");
}

}  // namespace
}  // namespace probewright::language::klartext::testing
