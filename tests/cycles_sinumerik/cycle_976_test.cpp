#include "support/sinumerik_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

/// What was never calibrated.
void forgetCalibration(SinumerikBench& bench) {
  bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 0);
  for (const char* axis : {"1", "2", "3"}) {
    bench.set((std::string("$SNS_MEA_WP_TRIG_MINUS_DIR_AX") + axis).c_str(), {0}, 0);
    bench.set((std::string("$SNS_MEA_WP_TRIG_PLUS_DIR_AX") + axis).c_str(), {0}, 0);
  }
}

void expectCalibrated(SinumerikBench& bench, const Vector2& deviation, double effective, double tolerance = 1e-9) {
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 2 * effective, tolerance);
  for (int axis = 0; axis < 2; ++axis) {
    const std::string name = "_DIR_AX" + std::to_string(axis + 1);
    EXPECT_NEAR(bench.data(("$SNS_MEA_WP_TRIG_PLUS" + name).c_str(), {0}), deviation[axis] + effective, tolerance);
    EXPECT_NEAR(bench.data(("$SNS_MEA_WP_TRIG_MINUS" + name).c_str(), {0}), deviation[axis] - effective, tolerance);
    EXPECT_NEAR(bench.data(("$SNS_MEA_WP_POS_DEV_AX" + std::to_string(axis + 1)).c_str(), {0}), deviation[axis],
                tolerance);
  }
}

TEST(Cycle976, CalibratesInARing) {
  Planter plant(976);
  for (int world = 0; world < 30; ++world) {
    const Vector2 deviation = {plant.number(-0.2, 0.2), plant.number(-0.2, 0.2)};
    const double pretravel = plant.number(0, 0.02), radius = plant.number(15, 30);
    const bool known = world % 2 == 0;
    const Vector3 error = known ? Vector3::Zero() : Vector3(plant.number(-1, 1), plant.number(-1, 1), 0);
    simulation::Truth truth = perfectWorld();
    truth.tools[0].probe.tipOffset = deviation;
    truth.tools[0].probe.pretravel = pretravel;
    place(truth, simulation::Ring(radius, 60, -40), translation(Vector3(0, 0, table) + error));
    SinumerikBench bench(truth);
    forgetCalibration(bench);
    bench.set("$TC_DP7", {1, 1}, 1.5);  // of L-shaped and star probes alone
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({0, 0, -10});
    bench.run("CYCLE976", {{"S_MVAR", (known ? 1.0 : 2.0) + (world % 3 == 0 ? 100000 : 0)},
                           {"S_SETV", 2 * radius},
                           {"S_FA", 8},
                           {"S_TSA", 3},
                           {"S_STA1", plant.number(0, 90)},
                           {"S_VMS", 200}});
    // Signals come late by the pretravel: the ball works like a smaller one.
    // Reversed, the probe touches beside the middle, where its way and the wall's normal differ a little.
    expectCalibrated(bench, deviation, 2 - pretravel, known ? 1e-9 : 2e-5);
    EXPECT_NEAR(bench.ovr(6), error.x(), 1e-9);
    EXPECT_NEAR(bench.ovr(7), error.y(), 1e-9);
    EXPECT_NEAR(bench.ovr(20), deviation.x(), 1e-9);
    EXPECT_NEAR(bench.data("$TC_DP6", {1, 1}), 2 - pretravel, known ? 1e-9 : 2e-5);
    EXPECT_EQ(bench.data("$SNS_MEA_WP_FEED", {0}), 200);
    EXPECT_NEAR((bench.control.channel.position() - ProgramPlace(error.x(), error.y(), -10)).norm(), 0, 1e-9);
  }
}

/// Where the spindle cannot be turned to an angle, the probe is calibrated as it stands.
TEST(Cycle976, CalibratesWithoutTurningASpindleThatDoesNotOrient) {
  for (const double variant : {1.0, 2.0}) {
    simulation::Truth truth = perfectWorld();
    truth.machine.spindleOrients = false;
    truth.tools[0].probe.pretravel = 0.01;
    place(truth, simulation::Ring(20, 60, -40), translation({0, 0, table}));
    SinumerikBench bench(truth);
    forgetCalibration(bench);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({0, 0, -10});
    bench.run("CYCLE976", {{"S_MVAR", variant}, {"S_SETV", 40}, {"S_FA", 8}, {"S_TSA", 3}, {"S_VMS", 200}});
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 2 * 1.99, 1e-9) << variant;
  }
}

TEST(Cycle976, WhatItCalibratesMeasuresRight) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.tipOffset = {0.1, -0.07};
  truth.tools[0].probe.pretravel = 0.012;
  truth.tools[0].probe.signalDelay = 0.001;
  place(truth, simulation::Ring(20, 60, -40), translation({0, 0, table}));
  place(truth, simulation::Ring(33.3, 100, -40), translation({200.5, 0.25, table}));
  SinumerikBench bench(truth);
  forgetCalibration(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({0, 0, -10});
  bench.run("CYCLE976", {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 8}, {"S_TSA", 3}});
  bench.start({200, 0, -10});
  bench.run("CYCLE977", {{"S_MVAR", 1}, {"S_SETV", 66}, {"S_FA", 8}, {"S_TSA", 3}});
  EXPECT_NEAR(bench.ovr(4), 66.6, 1e-6);
  EXPECT_NEAR(bench.ovr(5), 200.5, 1e-6);
  EXPECT_NEAR(bench.ovr(6), 0.25, 1e-6);
}

TEST(Cycle976, TurnsAProbeWithOneDirectionIntoEveryTouch) {
  // The ball lies 0.1 beside the spindle axis on the side that the probe switches to, turned by 30 degrees from X.
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.tipOffset = {0.1 * std::cos(radiansFromDegrees(-30)), 0.1 * std::sin(radiansFromDegrees(-30))};
  place(truth, simulation::Ring(20, 60, -40), translation({0.3, -0.2, table}));
  place(truth, simulation::Ring(33.3, 100, -40), translation({200.5, 0.25, table}));
  SinumerikBench bench(truth);
  forgetCalibration(bench);
  bench.set("$TC_DP1", {1, 1}, 712);
  bench.set("$TC_DP10", {1, 1}, 30);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({0, 0, -10});
  bench.run("CYCLE976", {{"S_MVAR", 2}, {"S_SETV", 40}, {"S_FA", 8}, {"S_TSA", 3}});
  expectCalibrated(bench, {0, 0}, 2.1);
  bench.start({200, 0, -10});
  bench.run("CYCLE977", {{"S_MVAR", 1}, {"S_SETV", 66}, {"S_FA", 8}, {"S_TSA", 3}, {"S_STA1", 20}});
  EXPECT_NEAR(bench.ovr(4), 66.6, 1e-9);
  EXPECT_NEAR(bench.ovr(5), 200.5, 1e-9);
}

TEST(Cycle976, CalibratesOneAxisOfARing) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.tipOffset = {0, 0.05};
  place(truth, simulation::Ring(20, 60, -40), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const NamedNumbers call = {{"S_SETV", 40}, {"S_FA", 8}, {"S_TSA", 1}, {"S_MA", 2}};
  bench.start({0, 0, -10});
  bench.run("CYCLE976", with(call, {{"S_MVAR", 1001}, {"S_MD", 1}}));
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", {0}), -1.95, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_PLUS_DIR_AX2", {0}), 2, 1e-12) << "not touched";
  bench.start({0, 0, -10});
  bench.run("CYCLE976", with(call, {{"S_MVAR", 2001}}));
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_PLUS_DIR_AX2", {0}), 2.05, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_POS_DEV_AX2", {0}), 0.05, 1e-9);
}

TEST(Cycle976, FindsTheLengthOnASurface) {
  for (const bool toCentre : {false, true}) {
    // The stylus is 0.35 longer than its data say.
    simulation::Truth truth = perfectWorld();
    truth.tools[0].length = 100.35;
    place(truth, simulation::Box({-50, -50, -40}, {50, 50, 0}), translation({0, 0, table}));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    if (toCentre) bench.set("$MNS_MEA_FUNCTION_MASK", {}, 9);
    bench.set("$TC_DP3", {1, 1}, toCentre ? 98 : 100);
    bench.start({0, 0, 12});
    bench.run("CYCLE976", {{"S_MVAR", 1001000}, {"S_SETV", 0}, {"S_MA", 3}, {"S_MD", 1}, {"S_FA", 10}, {"S_TSA", 3}});
    EXPECT_NEAR(bench.data("$TC_DP3", {1, 1}), toCentre ? 98.35 : 100.35, 1e-9);
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}), toCentre ? -2 : 0, 1e-9);
    EXPECT_NEAR(bench.ovr(22), bench.data("$TC_DP3", {1, 1}), 1e-12);
    bench.start({10, 10, 12});
    bench.run("CYCLE978", {{"S_SETV", 0.2}, {"S_FA", 10}, {"S_TSA", 1}, {"S_MA", 3}, {"S_MD", 2}});
    EXPECT_NEAR(bench.ovr(4), 0, 1e-9) << "measured with the new length";
  }
}

TEST(Cycle976, FindsTheLengthAgainstTheToolWithoutAWordOnTheDirection) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({-60, -60, -60}, {60, 60, 0.25}), translation({0, 0, -350}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  bench.set("$TC_DP3", {1, 1}, 99.6);
  bench.start({0, 0, 8});
  bench.run("CYCLE976", {{"S_MVAR", 1000000}, {"S_SETV", 0.25}, {"S_FA", 6}, {"S_TSA", 1}});
  EXPECT_NEAR(bench.data("$TC_DP3", {1, 1}), 100, 1e-9);
  EXPECT_NEAR(bench.ovr(22), 100, 1e-9);
}

TEST(Cycle976, TakesTheTriggerPointInsteadOfTheLength) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].length = 100.35;
  place(truth, simulation::Box({-50, -50, -40}, {50, 50, 0}), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({0, 0, 12});
  bench.run("CYCLE976", {{"S_MVAR", 1000}, {"S_SETV", 0}, {"S_MA", 3}, {"S_MD", 1}, {"S_FA", 10}, {"S_TSA", 3}});
  EXPECT_EQ(bench.data("$TC_DP3", {1, 1}), 100);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}), -0.35, 1e-9);
  bench.start({10, 10, 12});
  bench.run("CYCLE978", {{"S_SETV", 0.2}, {"S_FA", 10}, {"S_TSA", 1}, {"S_MA", 3}, {"S_MD", 2}});
  EXPECT_NEAR(bench.ovr(4), 0, 1e-9);
}

TEST(Cycle976, CalibratesOnEdges) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.tipOffset = {0.06, 0};
  place(truth, simulation::Box({15, -50, -40}, {80, 50, 0}), translation({0.4, 0, table}), "right");
  place(truth, simulation::Box({-80, -50, -40}, {-15, 50, 0}), translation({0.4, 0, table}), "left");
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({5, 0, -10});
  bench.run("CYCLE976", {{"S_MVAR", 11004}, {"S_SETV", 15.4}, {"S_MA", 1}, {"S_MD", 0}, {"S_FA", 5}, {"S_TSA", 1}});
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}), 2.06, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 4.06, 1e-9);
  bench.start({0, 0, -10});
  bench.run("CYCLE976", {{"S_MVAR", 2004}, {"S_SETV", 30}, {"S_MA", 1}, {"S_FA", 5}, {"S_TSA", 1}});
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}), 2.06, 1e-9) << "found by reversing the spindle";
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0}), -1.94, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_POS_DEV_AX1", {0}), 0.06, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 4, 1e-9);
}

TEST(Cycle976, CalibratesOnABall) {
  Planter plant(9763);
  for (int world = 0; world < 24; ++world) {
    const Vector2 deviation = {plant.number(-0.1, 0.1), plant.number(-0.1, 0.1)};
    const double radius = plant.number(10, 20), length = plant.number(99.5, 100.5);
    const Vector3 centre = Vector3(plant.number(-0.5, 0.5), plant.number(-0.5, 0.5), table);
    const bool round = world % 2 == 0, toCentre = world % 4 < 2;
    simulation::Truth truth = perfectWorld();
    truth.tools[0].length = length;
    truth.tools[0].probe.tipOffset = deviation;
    place(truth, simulation::SolidSphere(centre, radius));
    SinumerikBench bench(truth);
    forgetCalibration(bench);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    if (toCentre) bench.set("$MNS_MEA_FUNCTION_MASK", {}, 9);
    bench.set("$TC_DP3", {1, 1}, toCentre ? 98 : 100);
    bench.start({0, 0, radius + (toCentre ? 8.0 : 6.0)});
    bench.run("CYCLE976", {{"S_MVAR", 1000003.0 + (round ? 100000 : 0)},
                           {"S_SETV", 2 * radius},
                           {"S_SETV0", radius},
                           {"S_FA", toCentre ? 3 : 5},
                           {"S_TSA", 3},
                           {"S_STA1", plant.number(-45, 45)}});
    // The top is touched beside the axis by at most the start error: its height errs by the square of what is left.
    expectCalibrated(bench, deviation, 2, 1e-8);
    EXPECT_NEAR(bench.data("$TC_DP3", {1, 1}), length - (toCentre ? 2 : 0), 1e-8);
    EXPECT_NEAR(bench.ovr(6), centre.x(), 1e-8);
    EXPECT_NEAR(bench.ovr(7), centre.y(), 1e-8);
  }
}

TEST(Cycle976, RefusesWithTheControlsAlarms) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 60, -40), translation({0, 0, table}));
  SinumerikBench bench(truth);
  forgetCalibration(bench);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const auto alarm = [&](const NamedNumbers& changed) {
    bench.start({0, 0, -10});
    return bench.alarmOf("CYCLE976", with({{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 8}, {"S_TSA", 3}}, changed));
  };
  EXPECT_EQ(alarm({{"S_MVAR", 5}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 4}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 1001}, {"S_MA", 3}}), "61325");
  EXPECT_EQ(alarm({{"S_MVAR", 1001}, {"S_MD", 2}}), "61326");
  EXPECT_EQ(alarm({{"S_SETV", 0}}), "61319");
  EXPECT_EQ(alarm({{"S_TSA", 1.9}}), "61303") << "a first calibration starts from 0";
  EXPECT_EQ(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 0) << "an alarm writes nothing";
  EXPECT_EQ(alarm({}), "");
}

}  // namespace
}  // namespace probewright
