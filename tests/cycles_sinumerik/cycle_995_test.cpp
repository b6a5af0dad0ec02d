#include "support/sinumerik_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

/// A machine whose spindle leans, with a ball on its table and a probe that runs out.
simulation::Truth leaningWorld(const Vector3& tilt, const Vector3& ball, double radius) {
  simulation::Truth truth = perfectWorld();
  truth.errors.spindleTilt = tilt;
  place(truth, simulation::SolidSphere(ball, radius), Pose::Identity(), "ball", simulation::SolidRole::Sphere);
  truth.tools[0].length = 160;
  truth.tools[0].probe.stylusLength = 100;
  return truth;
}

NamedNumbers callOf(double diameter, double distance) {
  return {{"S_MVAR", 102015}, {"S_SETV", diameter}, {"S_FA", 5}, {"S_TSA", 3}, {"S_DZ", distance}};
}

/// How far the tool axis (from the tip to the spindle) leans towards the axes of the plane, degrees.
Vector2 leaning(const Vector3& tilt) {
  const double angle = tilt.norm();
  const Vector3 axis =
      angle > 0 ? Vector3(rotation(tilt / angle, angle).linear() * Vector3::UnitZ()) : Vector3::UnitZ();
  return {degreesFromRadians(std::atan2(axis.x(), axis.z())), degreesFromRadians(std::atan2(axis.y(), axis.z()))};
}

TEST(Cycle995, FindsHowTheSpindleLeans) {
  Planter plant(995);
  for (int world = 0; world < 25; ++world) {
    const Vector3 tilt(plant.number(-0.1, 0.1), plant.number(-0.1, 0.1), plant.number(-0.1, 0.1));
    const double radius = plant.number(8, 13), distance = plant.number(30, 60);
    const Vector3 origin(20, -10, table), ball = origin + plant.within(1);
    simulation::Truth truth = leaningWorld(tilt, ball, radius);
    simulation::TrueProbe& probe = truth.tools[0].probe;
    if (world % 3 != 0) probe.tipOffset = {plant.number(-0.05, 0.05), plant.number(-0.05, 0.05)};
    probe.stylusRadius = plant.number(0.8, 1.8);
    probe.pretravel = plant.number(0, 0.02);
    SinumerikBench bench(truth);
    bench.set("$TC_DP3", {1, 1}, 160);
    // Calibrated for the direction that every touch is aligned to.
    bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, probe.ballRadius + probe.tipOffset.x() - probe.pretravel);
    bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 2 * (probe.ballRadius - probe.pretravel));
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.start({0, 0, radius + 5});
    const bool find = world % 2 == 0;
    bench.run("CYCLE995", with(callOf(2 * radius - (find ? 0.05 : 0), distance),
                               {{"S_MVAR", find ? 1102015.0 : 102015.0}, {"S_STA1", plant.number(-360, 360)}}));
    const Vector2 leans = leaning(tilt);
    // The shaft is touched about the centre of the ball: a run-out tip meets the equator beside it by as much, and
    // pretravel runs along the path, not along the normal there.
    const Vector2 deviation(distance * std::tan(radiansFromDegrees(leans.x())),
                            distance * std::tan(radiansFromDegrees(leans.y())));
    const double bound = 1e-6 + (1.5 * probe.tipOffset.norm() + probe.pretravel) * deviation.norm() / radius;
    EXPECT_NEAR(bench.ovr(2), leans.x(), degreesFromRadians(bound / distance)) << world;
    EXPECT_NEAR(bench.ovr(3), leans.y(), degreesFromRadians(bound / distance)) << world;
    EXPECT_NEAR(bench.ovr(7), deviation.x(), bound);
    EXPECT_NEAR(bench.ovr(8), deviation.y(), bound);
    EXPECT_NEAR(bench.ovr(4), distance, 1e-12);
    EXPECT_NEAR(bench.ovr(14), 2 * radius, 4e-4);
    EXPECT_EQ(bench.ovi(2), 995);
    EXPECT_EQ(bench.ovi(5), 1);
    // Back over the ball, the measuring path above its pole.
    EXPECT_NEAR(bench.control.channel.position().x(), 0, 1e-6);
    EXPECT_NEAR(bench.control.channel.position().y(), 0, 1e-6);
    const double nominal = 2 * radius - (find ? 0.05 : 0);
    EXPECT_NEAR(bench.control.channel.position().z(), ball.z() - table + nominal / 2 + 5, 0.02) << world;
    EXPECT_NEAR(bench.ovr(15), bench.ovr(11) + bench.ovr(19), 1e-9);
    // The shaft, where the ball of the first measurement is expected.
    EXPECT_NEAR(bench.ovr(22), bench.ovr(14), 1e-9);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(bench.ovr(23 + axis), bench.ovr(15 + axis), 1e-9);
      EXPECT_NEAR(bench.ovr(25 + axis), bench.ovr(15 + axis) - deviation[axis], bound);
      EXPECT_NEAR(bench.ovr(27 + axis), -deviation[axis], bound);
    }
  }
}

TEST(Cycle995, MeasuresEachPlaceSoManyTimes) {
  // Scatter of the signal: the mean of nine measurements has a third of it.
  double sums[2] = {0, 0};
  for (const int count : {1, 9}) {
    for (int world = 0; world < 60; ++world) {
      simulation::Truth truth = leaningWorld({0.02, 0.03, 0}, {0, 0, table}, 10);
      truth.seed = static_cast<std::uint64_t>(1000 + world);
      truth.tools[0].probe.repeatability = 0.002;
      SinumerikBench bench(truth);
      bench.set("$TC_DP3", {1, 1}, 160);
      plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
      bench.start({0, 0, 15});
      bench.run("CYCLE995", with(callOf(20, 50), {{"S_NMSP", count}}));
      const double expected = leaning({0.02, 0.03, 0}).x();
      sums[count / 9] += std::pow(bench.ovr(2) - expected, 2);
      const auto& touches = bench.machine.path().touches;
      // Twice four points and the pole, then four of the shaft.
      EXPECT_EQ(std::ranges::count(touches, simulation::PathKind::Measure, &simulation::PathTouch::kind), 14 * count);
    }
  }
  EXPECT_NEAR(std::sqrt(sums[0] / sums[1]), 3, 0.8);
}

TEST(Cycle995, ComparesWithToleranceAndZeroRange) {
  const Vector3 tilt(-0.02, 0.05, 0);  // leans by 0.05 towards X and 0.02 towards Y
  SinumerikBench bench(leaningWorld(tilt, {0, 0, table}, 10));
  bench.set("$TC_DP3", {1, 1}, 160);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const auto run = [&](const NamedNumbers& changed) {
    bench.start({0, 0, 15});
    bench.run("CYCLE995", with(callOf(20, 50), changed));
  };
  run({{"_AMODE", 1}, {"S_TUL", 0.03}, {"S_TZL", 0.025}});
  EXPECT_NEAR(bench.ovr(2), 0.05, 1e-4);
  EXPECT_NEAR(bench.ovr(5), 0.02, 1e-4);
  EXPECT_EQ(bench.ovr(3), 0);
  EXPECT_EQ(bench.ovr(8), 0);
  EXPECT_EQ(bench.ovr(6), 0);
  EXPECT_EQ(bench.ovr(9), 0.03);
  EXPECT_EQ(bench.messages(), "61304 ");
  run({{"S_TUL", 0.03}, {"S_TZL", 0.025}});  // no tolerance: neither counts
  EXPECT_NEAR(bench.ovr(3), 0.02, 1e-4);
  EXPECT_EQ(bench.ovr(9), 0);
  EXPECT_EQ(bench.messages(), "61304 ");
}

TEST(Cycle995, RefusesWithTheControlsAlarms) {
  SinumerikBench bench(leaningWorld(Vector3::Zero(), {0, 0, table}, 10));
  bench.set("$TC_DP3", {1, 1}, 160);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const auto alarm = [&](const NamedNumbers& changed) {
    bench.start({0, 0, 15});
    return bench.alarmOf("CYCLE995", with(callOf(20, 50), changed));
  };
  EXPECT_EQ(alarm({{"S_MVAR", 5}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 102115}}), "61307");
  EXPECT_EQ(alarm({{"S_KNUM", 1}}), "61321");
  EXPECT_EQ(alarm({{"S_DZ", 0}}), "61319");
  EXPECT_EQ(alarm({{"S_STA1", 361}}), "61319");
  EXPECT_EQ(alarm({{"S_SETV", 0}}), "61319");
  EXPECT_EQ(alarm({{"S_FA", 0}}), "61308");
  EXPECT_EQ(alarm({{"S_PRNUM", 13}}), "61313");
  EXPECT_EQ(alarm({{"S_PRNUM", 2}}), "61341");
  EXPECT_EQ(alarm({{"S_MVAR", 1102015}, {"S_SETV", 23.5}}), "61303");
  EXPECT_EQ(alarm({}), "");
  bench.set("$TC_DP1", {1, 1}, 712);
  EXPECT_EQ(alarm({}), "61309");
}

TEST(Cycle995, ElsewhereATouchOfTheShaftIsACollision) {
  SinumerikBench bench(leaningWorld(Vector3::Zero(), {0, 0, table}, 10));
  bench.set("$TC_DP3", {1, 1}, 160);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({30, 0, -40});
  EXPECT_EQ(bench.alarmOf("CYCLE978", {{"S_SETV", 10}, {"S_FA", 8}, {"S_TSA", 3}, {"S_MA", 1}, {"S_MD", 2}}),
            bench.control.channel.alarms.collision);
}

}  // namespace
}  // namespace probewright
