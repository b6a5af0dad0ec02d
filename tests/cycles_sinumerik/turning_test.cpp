#include "support/sinumerik_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

/// A probe for turned parts hangs along Z in the turning plane, its lengths to the ball's centre: length 2 in Z.
void useTurningProbe(SinumerikBench& bench) {
  bench.plane = "G18";
  bench.set("$TC_DP1", {1, 1}, 580);
  bench.set("$TC_DP2", {1, 1}, 7);
  bench.set("$TC_DP3", {1, 1}, 0);
  bench.set("$TC_DP4", {1, 1}, 98);
  bench.control.data.set("$TC_TP2", {7}, std::string("FINISH"));
  bench.set("$TC_DP1", {7, 1}, 510);
  bench.set("$TC_DP3", {7, 1}, 60);
}

simulation::Truth barAt(double radius, double x, double z) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::RoundBar(radius, -60, 0), translation({x, 0, table + z}));
  return truth;
}

const NamedNumbers outside = {{"S_MVAR", 2}, {"S_SETV", 40}, {"S_MA", 2}, {"S_FA", 5}, {"S_TSA", 1}};

TEST(Cycle974, MeasuresAnOutsideDiameterAtOnePoint) {
  SinumerikBench bench(barAt(20.1, 0, 0));
  useTurningProbe(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({32, 0, -10});
  bench.run("CYCLE974", outside, {}, "DIAMON\n");
  EXPECT_NEAR(bench.ovr(4), 40.2, 1e-9);
  EXPECT_NEAR(bench.ovr(6), 40.2, 1e-9);
  EXPECT_NEAR(bench.ovr(16), 0.2, 1e-9);
  bench.start({32, 0, -10});
  bench.run("CYCLE974", with(outside, {{"S_SETV", 20}}));
  EXPECT_NEAR(bench.ovr(4), 20.1, 1e-9) << "radius programming";
  bench.start({32, 0, -10});
  bench.run("CYCLE974", with(outside, {{"S_MVAR", 202}, {"S_KNUM1", 1}}), {{"S_TNAME", "FINISH"}}, "DIAMON\n");
  EXPECT_NEAR(bench.data("$TC_DP12", {7, 1}), -0.1, 1e-9) << "too large by 0.2: the tool is shorter by half of it";
  EXPECT_EQ(bench.ovi(0), 1);
}

TEST(Cycle974, ShiftsTheZeroOffset) {
  SinumerikBench bench(barAt(20, 0.3, 0.75));
  useTurningProbe(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({32, 0, -10});
  bench.run("CYCLE974", with(outside, {{"S_MVAR", 102}, {"S_KNUM", 1}}), {}, "DIAMON\n");
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "X", "FI"}), 0.3, 1e-9) << "half the difference of the diameter";
  bench.start({0, 0, 12});
  bench.run("CYCLE974", {{"S_MVAR", 100}, {"S_KNUM", 10001}, {"S_SETV", 0.5}, {"S_MA", 1}, {"S_FA", 12}, {"S_TSA", 1}});
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "Z", "TR"}), table + 0.25, 1e-9) << "the face has its set value 0.5 now";
}

TEST(Cycle974, MeasuresABoreFromWithin) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(25, 100, -40), translation({0, 0, table}));
  SinumerikBench bench(truth);
  useTurningProbe(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({10, 0, -10});
  bench.run("CYCLE974",
            {{"S_MVAR", 201}, {"S_KNUM1", 100001}, {"S_SETV", 49.9}, {"S_MA", 2}, {"S_FA", 6}, {"S_TSA", 1}},
            {{"S_TNAME", "FINISH"}}, "DIAMON\n");
  EXPECT_NEAR(bench.ovr(4), 50, 1e-9);
  EXPECT_NEAR(bench.data("$TC_DP12", {7, 1}), -0.05, 1e-9);
}

TEST(Cycle974, ReversalMakesTheCentreUnimportant) {
  simulation::Truth truth = perfectWorld("mill5-head-table");
  place(truth, simulation::RoundBar(20, -60, 0), translation({0.3, 0, -450}));
  SinumerikBench bench(truth);
  useTurningProbe(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -450});
  bench.start({32, 0, -10});
  bench.run("CYCLE974", outside, {}, "DIAMON\n");
  EXPECT_NEAR(bench.ovr(4), 40.6, 1e-9);
  bench.start({32, 0, -10});
  bench.run("CYCLE974", with(outside, {{"S_MVAR", 10002}}), {}, "DIAMON\n");
  EXPECT_NEAR(bench.ovr(4), 40, 1e-9);
}

TEST(Cycle974, MeasuresOnALathe) {
  // The probe lies across the turning axis, its shank to the turret; the bar runs out of true by 0.2.
  simulation::Truth truth = perfectWorld("lathe2c");
  truth.tools[0].shankDirection = Vector3::UnitX();
  place(truth, simulation::RoundBar(25, 0, 120), translation({0.2, 0, 0}));
  SinumerikBench bench(truth);
  useTurningProbe(bench);
  bench.set("$TC_DP3", {1, 1}, 98);
  bench.set("$TC_DP4", {1, 1}, 0);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, 120});
  const std::string approach = "DIAMON\nG0 X200 Z-20\nG0 X70\n";
  bench.run("CYCLE974", with(outside, {{"S_SETV", 50}}), {}, approach);
  EXPECT_NEAR(bench.ovr(4), 50.4, 1e-9);
  bench.run("CYCLE974", with(outside, {{"S_SETV", 50}, {"S_MVAR", 10202}, {"S_KNUM1", 100001}}),
            {{"S_TNAME", "FINISH"}}, approach);
  EXPECT_NEAR(bench.ovr(4), 50, 1e-9) << "the part turned by 180 degrees in C";
  EXPECT_NEAR(bench.data("$TC_DP12", {7, 1}), 0, 1e-9);
}

TEST(Cycle994, MeasuresADiameterByTwoPoints) {
  SinumerikBench bench(barAt(20.1, 0.25, 0));
  useTurningProbe(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const NamedNumbers call = with(outside, {{"S_SZO", 30}});
  bench.start({32, 0, -10});
  bench.run("CYCLE994", call, {}, "DIAMON\n");
  EXPECT_NEAR(bench.ovr(4), 40.2, 1e-9) << "wherever the centre is";
  EXPECT_NEAR(bench.control.channel.position().x(), -20 - 5 - 2, 1e-9) << "the probe ends below the centre";
  bench.start({32, 0, -10});
  bench.run("CYCLE994", with(call, {{"S_MVAR", 1202}, {"S_KNUM1", 100001}, {"S_SZA", 80}, {"S_MA", 102}}),
            {{"S_TNAME", "FINISH"}}, "DIAMON\n");
  EXPECT_NEAR(bench.data("$TC_DP12", {7, 1}), -0.1, 1e-9);
}

TEST(Cycle994, MeasuresABoreStraightAcross) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(25, 100, -40), translation({0.4, 0, table}));
  SinumerikBench bench(truth);
  useTurningProbe(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({10, 0, -10});
  bench.run("CYCLE994", {{"S_MVAR", 1}, {"S_SETV", 50}, {"S_MA", 2}, {"S_FA", 6}, {"S_TSA", 1}}, {}, "DIAMON\n");
  EXPECT_NEAR(bench.ovr(4), 50, 1e-9);
}

TEST(Cycle973, CalibratesOnASurface) {
  simulation::Truth truth = barAt(20, 0, 0);
  truth.tools[0].probe.pretravel = 0.015;
  truth.tools[0].length = 100.4;
  SinumerikBench bench(truth);
  useTurningProbe(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({32, 0, -10});
  bench.run("CYCLE973", {{"S_MVAR", 1101}, {"S_SETV", 20}, {"S_MA", 2}, {"S_MD", 1}, {"S_FA", 5}, {"S_TSA", 1}});
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", {0}), -1.985, 1e-9) << "late by the pretravel";
  bench.start({0, 0, 12});
  bench.run("CYCLE973", {{"S_MVAR", 1001100}, {"S_SETV", 0}, {"S_MA", 1}, {"S_MD", 1}, {"S_FA", 8}, {"S_TSA", 1}});
  // With the ball radius that the first calibration left in the tool data.
  const double radius = bench.data("$TC_DP6", {1, 1});
  EXPECT_NEAR(bench.data("$TC_DP4", {1, 1}), 100.4 - radius, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0}), -radius, 1e-9);
  bench.start({0, 0, 12});
  bench.run("CYCLE974", {{"S_SETV", 0.1}, {"S_MA", 1}, {"S_FA", 8}, {"S_TSA", 1}});
  EXPECT_NEAR(bench.ovr(4), 0, 1e-9);
}

TEST(Cycle973, CalibratesInTheGrooveOfTheMachine) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.tipOffset = {0.03, 0};
  place(truth, simulation::Box({-60, -40, -60}, {-15, 40, 0}), translation({100, 0, table}), "minus wall");
  place(truth, simulation::Box({15, -40, -60}, {60, 40, 0}), translation({100, 0, table}), "plus wall");
  place(truth, simulation::Box({-60, -40, -80}, {60, 40, -20}), translation({100, 0, table}), "base");
  SinumerikBench bench(truth);
  useTurningProbe(bench);
  for (const char* axis : {"1", "2"}) {
    bench.set((std::string("$SNS_MEA_WP_TRIG_MINUS_DIR_AX") + axis).c_str(), {0}, 0);
    bench.set((std::string("$SNS_MEA_WP_TRIG_PLUS_DIR_AX") + axis).c_str(), {0}, 0);
  }
  bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 0);
  bench.set("$SNS_MEA_CAL_EDGE_PLUS_DIR_AX2", {1}, 115);
  bench.set("$SNS_MEA_CAL_EDGE_MINUS_DIR_AX2", {1}, 85);
  bench.set("$SNS_MEA_CAL_EDGE_BASE_AX1", {1}, table - 20);
  plantFrame(bench, "$P_UIFR", 1, {30, 0, table});
  const NamedNumbers call = {{"S_CALNUM", 2}, {"S_MA", 2}, {"S_FA", 6}, {"S_TSA", 3}};
  bench.start({60, 0, 30});
  bench.run("CYCLE973", with(call, {{"S_MVAR", 2103}}));
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_PLUS_DIR_AX2", {0}), 2.03, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", {0}), -1.97, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 4, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_POS_DEV_AX2", {0}), 0.03, 1e-9);
  EXPECT_NEAR(inWorkpiece(bench, {30, 0, table}).norm(), 0, 1e-9) << "the workpiece system is in effect again";
  bench.start({60, 0, 30});
  bench.run("CYCLE973", with(call, {{"S_MVAR", 102}}));
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0}), -2, 1e-9);
  bench.start({60, 0, 30});
  EXPECT_EQ(bench.alarmOf("CYCLE973", with(call, {{"S_MVAR", 2103}, {"S_CALNUM", 4}})), "61333");
  EXPECT_EQ(bench.alarmOf("CYCLE973", with(call, {{"S_MVAR", 2103}, {"S_MA", 1}})), "61325");
  EXPECT_EQ(bench.alarmOf("CYCLE973", with(call, {{"S_MVAR", 2003}})), "61307");
  bench.set("$TC_DP2", {1, 1}, 3);
  EXPECT_EQ(bench.alarmOf("CYCLE973", with(call, {{"S_MVAR", 2103}})), "61315");
}

TEST(TurningCycles, RefuseWithTheControlsAlarms) {
  SinumerikBench bench(barAt(20, 0, 0));
  useTurningProbe(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const auto alarm = [&](const char* name, const NamedNumbers& changed) {
    bench.start({32, 0, -10});
    return bench.alarmOf(name, with(with(outside, {{"S_SETV", 20}}), changed));
  };
  EXPECT_EQ(alarm("CYCLE974", {{"S_MVAR", 3}}), "61307");
  EXPECT_EQ(alarm("CYCLE974", {{"S_MVAR", 10102}, {"S_KNUM", 1}}), "61307");
  EXPECT_EQ(alarm("CYCLE974", {{"S_MA", 4}}), "61325");
  EXPECT_EQ(alarm("CYCLE974", {{"S_SETV", 22}}), "61303");
  EXPECT_EQ(alarm("CYCLE994", {{"S_MVAR", 102}}), "61307");
  EXPECT_EQ(alarm("CYCLE994", {{"S_MA", 202}}), "61325");
  bench.set("$TC_DP1", {1, 1}, 710);
  bench.plane = "G17";
  EXPECT_EQ(alarm("CYCLE974", {}), "61309");
}

}  // namespace
}  // namespace probewright
