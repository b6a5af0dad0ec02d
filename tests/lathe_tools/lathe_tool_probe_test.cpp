#include "lathe_tools/tool_bench.hpp"

/// Tool touch probes of lathes: they stand on the bed, and the tools in the turret are driven by a spindle of their
/// own.
namespace probewright {
namespace {

using namespace testing_support;
using machine::MeasureEnd;
using machine::Rotation;
using machine::Sensor;

/// Moves the tip of tool 5 along Z or X against the probe and tells where it is at the signal.
machine::MeasureResult measure(LatheBench& bench, const Vector3& by) {
  machine::MeasureOrder order{bench.machine.position(), machine::Feed::at(300), Sensor::ToolTouchProbe};
  order.target[0] += by.x();
  order.target[1] += by.z();
  return bench.machine.measure(order);
}

TEST(LatheToolProbe, StaysWhereItIsWhenTheMainSpindleTurns) {
  for (const double angle : {0.0, 90.0, 217.0}) {
    setup::Setup setup = toolSetup();
    add(setup, turningTool(5, 3, {80, 40}, 0.4), "turn");
    LatheBench bench(setup);
    bench.run(measuring(5, startOf(3), fmt::format("SPOS={}\nG0 X150", angle)));
    const auto touched = measure(bench, {0, 0, -40});
    ASSERT_EQ(touched.end, MeasureEnd::Touched) << touched.detail;
    EXPECT_NEAR(touched.latched[1], probeMiddle.z() + half + 40, 1e-6) << angle;
  }
}

TEST(LatheToolProbe, StopsWhatRunsIntoItWhereverTheMainSpindleStands) {
  setup::Setup setup = toolSetup();
  add(setup, turningTool(5, 3, {80, 40}, 0.4), "turn");
  LatheBench bench(setup);
  const std::string code = bench.alarmOf(measuring(5, startOf(3), "SPOS=90\nG0 X150\nG1 Z395 F1000"));
  EXPECT_EQ(code, "61302");
  EXPECT_LT(bench.machine.position()[1], probeMiddle.z() + half + 40 + 1);
}

TEST(LatheToolProbe, FeelsTheToothThatTheToolSpindleHasTurnedToIt) {
  for (const double angle : {0.0, 180.0}) {
    setup::Setup setup = toolSetup();
    simulation::TrueTool mill = rotatedTool(5, false, {60, 90}, 8, 2);
    mill.cutter.teeth[1].radial = -0.2;  // at 180 degrees
    add(setup, mill, "mill");
    LatheBench bench(setup);
    // Tooth 1 points to +X at 0 degrees: the side at -X of the contact is touched in plus direction.
    bench.run(measuring(5, {440, 125}, fmt::format("SETMS(2)\nSPOS={}\nG0 Z400", angle)));
    const auto touched = measure(bench, {30, 0, 0});
    ASSERT_EQ(touched.end, MeasureEnd::Touched) << touched.detail;
    EXPECT_NEAR(touched.latched[0] - 60, probeMiddle.x() - half - (angle == 0 ? 8 : 7.8), 1e-6);
    EXPECT_EQ(bench.machine.position()[2], 0) << "the main spindle stands";
  }
}

TEST(LatheToolProbe, IsDamagedByAToolThatTurnsAsItCuts) {
  setup::Setup setup = toolSetup();
  add(setup, rotatedTool(5, false, {60, 90}, 8, 2), "mill");
  for (const Rotation direction : {Rotation::Clockwise, Rotation::CounterClockwise}) {
    LatheBench bench(setup);
    bench.run(measuring(5, {440, 125}, "G0 Z400"));
    bench.machine.turnTool(direction, 600);
    EXPECT_EQ(bench.machine.spindle().rotation, Rotation::None);
    EXPECT_EQ(measure(bench, {30, 0, 0}).end,
              direction == Rotation::Clockwise ? MeasureEnd::Collision : MeasureEnd::Touched);
  }
}

TEST(LatheToolProbe, MasterSpindleIsWhatSposMeans) {
  setup::Setup setup = toolSetup();
  add(setup, rotatedTool(5, false, {60, 90}, 8, 2), "mill");
  LatheBench bench(setup);
  bench.run("T5 D1\nSETMS(2)\nSPOS=30\nR1=$P_MSNUM\nSETMS\nSPOS=50\nR2=$P_MSNUM");
  EXPECT_EQ(bench.machine.toolSpindle().angle, 30);
  EXPECT_NEAR(bench.machine.position()[2], 50, 1e-9);
  EXPECT_EQ(bench.data("R", {1}), 2);
  EXPECT_EQ(bench.data("R", {2}), 1);
  bench.run("T5 D1\nS2=500 M2=3\nSPOS[2]=30\nSPOS[2]=IC(15)");
  EXPECT_EQ(bench.machine.toolSpindle().angle, 45);
  EXPECT_EQ(bench.machine.toolSpindle().rotation, Rotation::None);
}

TEST(LatheToolProbe, EndOfTheProgramStopsTheTool) {
  setup::Setup setup = toolSetup();
  add(setup, rotatedTool(5, false, {60, 90}, 8, 2), "mill");
  LatheBench bench(setup);
  bench.run("T5 D1\nS2=500 M2=3\nM30");
  EXPECT_EQ(bench.machine.toolSpindle().rotation, Rotation::None);
}

TEST(LatheToolProbe, SetupKnowsWhereTheTipOfATurningToolPoints) {
  for (int position = 1; position <= 8; ++position) {
    setup::Setup setup = toolSetup();
    add(setup, turningTool(5, position, {80, 40}, 0.8), "turn");
    LatheBench bench(setup);
    EXPECT_EQ(bench.data("$TC_DP2", {5, 1}), position);
    EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 80, 1e-9);
    EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 40, 1e-9);
  }
}

TEST(LatheToolProbe, CalibratingToolHasItsLengthsAtTheCircumference) {
  setup::Setup setup = toolSetup();
  add(setup, calibrationPin(9, {70, 30}, 5), "calibration");
  LatheBench bench(setup);
  EXPECT_EQ(bench.data("$TC_DP1", {9, 1}), 580);
  EXPECT_EQ(bench.data("$TC_DP2", {9, 1}), 3);
  EXPECT_EQ(bench.data("$TC_DP6", {9, 1}), 5);
  // The axis of the pin is a radius further than its corner.
  EXPECT_NEAR(bench.data("$TC_DP3", {9, 1}), 70, 1e-9);
  EXPECT_NEAR(bench.data("$TC_DP4", {9, 1}), 30, 1e-9);
}

}  // namespace
}  // namespace probewright
