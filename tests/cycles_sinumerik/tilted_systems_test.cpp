#include "cycles_sinumerik/milling_variants.hpp"

/// Workpiece systems that are tilted against the tool: the ball's centre lies along the tool, wherever its length ends.
namespace probewright {
namespace {

using namespace testing_support;

/// A calibrated probe whose length ends at the south pole of its ball, or at the ball's centre (bit 1 of MD 51740).
void enterLength(SinumerikBench& bench, bool toCentre) {
  if (!toCentre) return;
  bench.set("$MNS_MEA_FUNCTION_MASK", {}, 9);
  bench.set("$TC_DP3", {1, 1}, 98);
  bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}, -2);
}

/// Table from workpiece, and the same as a frame of G54.
struct Tilt {
  explicit Tilt(const Vector3& about) : angles(about) {
    pose = translation(origin) * rotation(Vector3::UnitZ(), angles.z()) * rotation(Vector3::UnitY(), angles.y()) *
           rotation(Vector3::UnitX(), angles.x());
  }
  Vector3 angles;
  Pose pose;
};

TEST(TiltedSystems, EachVariantPutsThePartInItsPlace) {
  constexpr double targets[] = {1, 10001, 9000, 1001, 2000};
  Planter plant(511);
  int world = 0;
  for (int round = 0; round < 4; ++round) {
    for (const Variant& variant : variants()) {
      ++world;
      SCOPED_TRACE(fmt::format("{} in world {}", variant.name, world));
      const Tilt tilt({plant.number(-4, 4), plant.number(-4, 4), plant.number(-40, 40)});
      const Pose part = displaced(variant, tilt.pose, plant, 0.7, 1);
      simulation::Truth truth = perfectWorld();
      truth.tools[0].probe.stylusRadius = 0.5;
      variant.part(truth, part);
      SinumerikBench bench(truth);
      enterLength(bench, round % 2 == 1);
      plantFrame(bench, "$P_UIFR", 1, origin, tilt.angles);
      // Walls are parallel to the tilted axes: whatever height the ball touches them at.
      bench.start(variant.start);
      bench.run(variant.cycle, with(variant.call, {{"S_KNUM", targets[world % 5]}}));
      expectInPlace(bench, variant, part);
    }
  }
}

/// Calibrated on an edge, the ball's centre ends S_FA in front of it, wherever the tool's tip is then.
TEST(TiltedSystems, ACalibrationOnAnEdgeEndsInFrontOfIt) {
  for (const double about : {4.0, -4.0}) {
    const Tilt tilt({0, about, 0});
    simulation::Truth truth = perfectWorld();
    truth.tools[0].probe.stylusRadius = 0.5;
    place(truth, simulation::Box({15, -50, -40}, {80, 50, 0}), tilt.pose);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin, tilt.angles);
    bench.start({5, 0, -10});
    bench.run("CYCLE976", {{"S_MVAR", 11004}, {"S_SETV", 15}, {"S_MA", 1}, {"S_MD", 0}, {"S_FA", 5}, {"S_TSA", 1}});
    const Vector3 tip = bench.control.channel.position().vector();
    const Vector3 ball = tip + 2 * (tilt.pose.linear().inverse() * Vector3::UnitZ());
    EXPECT_NEAR(ball.x(), 15 - 5, 1e-6) << about;
  }
}

TEST(TiltedSystems, ThreeBallsAreFoundFromAnApproximateRotation) {
  // As the workpiece lies, by some degrees; the rotation that was entered before the cycle, by some tenths more or
  // less.
  Planter plant(512);
  const Vector3 set[] = {{-80, -60, 0}, {90, -50, 8}, {10, 70, -6}};
  for (int world = 0; world < 16; ++world) {
    const Vector3 angles = plant.within(4), believed = angles + plant.within(0.6);
    const Tilt truePose(angles), believedPose(believed);
    simulation::Truth truth = perfectWorld();
    for (const Vector3& centre : set)
      place(truth, simulation::SolidSphere(Vector3::Zero(), 12.5), truePose.pose * translation(centre));
    SinumerikBench bench(truth);
    enterLength(bench, world % 2 == 1);
    plantFrame(bench, "$P_UIFR", 1, origin, believed);
    const NamedNumbers call = {{"S_MVAR", world % 4 < 2 ? 10119.0 : 111119.0},
                               {"S_KNUM", 10001},
                               {"S_SETV", 25},
                               {"S_FA", 8},
                               {"S_TSA", 5},
                               {"S_INCA", 80},
                               {"S_SETV0", -80},
                               {"S_SETV1", -60},
                               {"S_SETV3", 90},
                               {"S_SETV4", -50},
                               {"S_SETV5", 8},
                               {"S_SETV6", 10},
                               {"S_SETV7", 70},
                               {"S_SETV8", -6},
                               {"S_TNVL", 0.01}};
    // A second measurement begins where the first has put the system, and changes nothing any more.
    for (int pass = 0; pass < 2; ++pass) {
      bench.start({-80, -60, 34});
      bench.run("CYCLE997", call);
      for (const Vector3& centre : set)
        EXPECT_NEAR((inWorkpiece(bench, truePose.pose * centre) - centre).norm(), 0, 1e-6) << world << " pass " << pass;
    }
  }
}

TEST(TiltedSystems, WhatIsCalibratedThereMeasuresRightWithoutTilt) {
  // Trigger points count from the ball's centre: where they were found does not matter.
  Planter plant(513);
  for (int world = 0; world < 12; ++world) {
    const Tilt tilt({plant.number(-4, 4), plant.number(-4, 4), 0});
    simulation::Truth truth = perfectWorld();
    truth.tools[0].probe.stylusRadius = 0.5;
    const int units = world % 3;  // length, ring, ball
    if (units == 0) place(truth, simulation::Box({-60, -60, -40}, {60, 60, 0}), tilt.pose);
    if (units == 1) place(truth, simulation::Ring(20, 60, -40), tilt.pose);
    if (units == 2) place(truth, simulation::SolidSphere({0, 0, -12}, 12), tilt.pose);
    place(truth, simulation::Box({120, -50, -40}, {200, 50, 0}), translation(origin));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin, tilt.angles);
    plantFrame(bench, "$P_UIFR", 2, origin);
    bench.set("$TC_DP3", {1, 1}, 100.4);
    const NamedNumbers path = {{"S_FA", 5}, {"S_TSA", 3}};
    bench.start({0, 0, units == 1 ? -12.0 : 9.0});
    if (units == 0) bench.run("CYCLE976", with(path, {{"S_MVAR", 1001000}, {"S_MA", 3}, {"S_MD", 1}}));
    if (units == 1) bench.run("CYCLE976", with(path, {{"S_MVAR", 2}, {"S_SETV", 40}}));
    if (units == 2) bench.run("CYCLE976", with(path, {{"S_MVAR", 1000003}, {"S_SETV", 24}, {"S_SETV0", 0}}));
    if (units != 1) {
      EXPECT_NEAR(bench.data("$TC_DP3", {1, 1}), 100, 1e-5) << world;
    }
    if (units == 0) continue;
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 4, 1e-5) << world;
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}), 2, 1e-5) << world;
    bench.start({108, 0, -10}, 2);
    bench.run("CYCLE978", with(path, {{"S_SETV", 120}, {"S_MA", 1}, {"S_MD", 1}}));
    EXPECT_NEAR(bench.ovr(4), 120, 1e-5) << world;
  }
}

}  // namespace
}  // namespace probewright
