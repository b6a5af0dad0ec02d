#include "support/sinumerik_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

TEST(Cycle997, BringsABallToItsSetPosition) {
  Planter plant(997);
  for (int world = 0; world < 40; ++world) {
    const double radius = plant.number(8, 20);
    const Vector3 set = plant.within(15);
    const Pose believed = translation({10, -20, table}) * rotation(Vector3::UnitZ(), plant.number(-180, 180));
    const Vector3 error = plant.within(1.5);
    simulation::Truth truth = perfectWorld();
    place(truth, simulation::SolidSphere(Vector3::Zero(), radius), believed * translation(set + error));
    SinumerikBench bench(truth);
    const Matrix3 turned = believed.linear();
    plantFrame(bench, "$P_UIFR", 1, {10, -20, table},
               {0, 0, degreesFromRadians(std::atan2(turned(1, 0), turned(0, 0)))});
    const bool round = world % 2 == 0;
    const double diameter = world % 4 < 2 ? 2 * radius - 0.1 : 2 * radius;
    const bool find = world % 4 < 2;
    bench.start(set + Vector3(0, 0, radius + 10));
    bench.run("CYCLE997",
              {{"S_MVAR", 119.0 + (round ? 1000 : 0) + (world % 3 == 0 ? 100000 : 0) + (find ? 1000000 : 0)},
               {"S_KNUM", world % 3 == 1 ? 3001.0 : 1.0},
               {"S_SETV", diameter},
               {"S_FA", 4},
               {"S_TSA", 2},
               {"S_STA1", plant.number(-90, 90)},
               {"S_INCA", plant.number(60, 90)},
               {"S_SETV0", set.x()},
               {"S_SETV1", set.y()},
               {"S_SETV2", set.z()}});
    const Vector3 found = inWorkpiece(bench, believed * (set + error));
    // The equator is met to the second order of what the first pass and the set diameter missed.
    EXPECT_NEAR((found - set).norm(), 0, find ? 3e-4 : 1e-6) << world;
    EXPECT_NEAR(bench.ovr(4), 2 * radius, find ? 4e-4 : 1e-6);
    EXPECT_NEAR(bench.ovr(9), error.x(), 1e-6);
    EXPECT_NEAR(bench.ovr(10), error.y(), 1e-6);
  }
}

TEST(Cycle997, LeavesTheFitOfTheEquatorAndOfTheWholeBall) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::SolidSphere(Vector3::Zero(), 15), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table}, {0, 0, 0});
  bench.start({0, 0, 25});
  bench.run("CYCLE997",
            {{"S_MVAR", 9}, {"S_SETV", 30}, {"S_FA", 4}, {"S_TSA", 2}, {"S_SETV0", 0}, {"S_SETV1", 0}, {"S_SETV2", 0}});
  const auto& fits = bench.control.journal.cycles.back().fits;
  ASSERT_EQ(fits.size(), 2U);
  EXPECT_EQ(fits[0].shape, "circle");
  EXPECT_EQ(fits[1].shape, "sphere");
  const std::size_t equator = fits[0].touches.size();
  // The pole comes after the equator; each touch of a perfect ball lies on it.
  ASSERT_EQ(fits[1].touches.size(), equator + 1);
  EXPECT_EQ(fits[1].degreesOfFreedom, static_cast<int>(equator) - 3);
  EXPECT_NEAR(fits[1].formDeviation, 0, 1e-9);
}

TEST(Cycle997, LaysTheWorkpieceSystemOnThreeBalls) {
  Planter plant(9973);
  for (int world = 0; world < 20; ++world) {
    const Vector3 set[] = {{0, 0, 0}, {90, 5, 10}, {20, 70, -5}};
    const Pose believed = translation({-30, -20, table}) * rotation(Vector3::UnitZ(), plant.number(-30, 30));
    const Pose error = translation(plant.within(0.5)) * rotation(Vector3::UnitZ(), plant.number(-0.5, 0.5)) *
                       rotation(Vector3::UnitX(), plant.number(-0.5, 0.5)) *
                       rotation(Vector3::UnitY(), plant.number(-0.5, 0.5));
    simulation::Truth truth = perfectWorld();
    for (const Vector3& centre : set)
      place(truth, simulation::SolidSphere(Vector3::Zero(), 10), believed * error * translation(centre));
    SinumerikBench bench(truth);
    const Matrix3 turned = believed.linear();
    plantFrame(bench, "$P_UIFR", 1, {-30, -20, table},
               {0, 0, degreesFromRadians(std::atan2(turned(1, 0), turned(0, 0)))});
    bench.start({0, 0, 30});
    const NamedNumbers call = {{"S_MVAR", 1111119}, {"S_KNUM", 10001}, {"S_SETV", 20},  {"S_FA", 5},
                               {"S_TSA", 3},        {"S_INCA", 90},    {"S_SETV3", 90}, {"S_SETV4", 5},
                               {"S_SETV5", 10},     {"S_SETV6", 20},   {"S_SETV7", 70}, {"S_SETV8", -5},
                               {"S_TNVL", 0.01}};
    bench.run("CYCLE997", call);
    for (const Vector3& centre : set)
      EXPECT_NEAR((inWorkpiece(bench, believed * error * centre) - centre).norm(), 0, 1e-6);
    EXPECT_NEAR(bench.ovr(20), 20, 1e-6);
    if (world > 0) continue;
    bench.start({0, 0, 30});
    const execution::RunResult distorted = bench.tryRun("CYCLE997", with(call, {{"S_SETV3", 90.5}}));
    ASSERT_FALSE(distorted.diagnostics.empty());
    EXPECT_NE(distorted.diagnostics[0].message.find("triangle"), std::string::npos);
    EXPECT_EQ(distorted.diagnostics[0].code, "61414");
    EXPECT_EQ(bench.ovi(9), 61414);
    EXPECT_EQ(bench.ovi(12), 0) << "no single ball is at fault";
    // The second ball is where none lies: what was being measured is told with the alarm.
    bench.start({0, 0, 30});
    EXPECT_EQ(bench.alarmOf("CYCLE997", with(call, {{"S_SETV4", 60}})), "61301");
    EXPECT_EQ(bench.ovi(12), 2);
    // Left out, the limit is 1.2: half a millimetre on one side passes, that of two sides together not.
    NamedNumbers open = with(call, {{"S_SETV3", 90.5}});
    std::erase_if(open, [](const auto& each) { return each.first == "S_TNVL"; });
    bench.start({0, 0, 30});
    EXPECT_EQ(bench.tryRun("CYCLE997", open).diagnostics.size(), 0U);
    bench.start({0, 0, 30});
    EXPECT_EQ(bench.tryRun("CYCLE997", with(open, {{"S_SETV3", 92}})).diagnostics.size(), 1U);
  }
}

TEST(Cycle997, RefusesWithTheControlsAlarms) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::SolidSphere({0, 0, table}, 10));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const auto alarm = [&](const NamedNumbers& changed) {
    bench.start({0, 0, 20});
    return bench.alarmOf(
        "CYCLE997",
        with({{"S_MVAR", 101109}, {"S_KNUM", 1}, {"S_SETV", 20}, {"S_FA", 5}, {"S_TSA", 1}, {"S_INCA", 90}}, changed));
  };
  EXPECT_EQ(alarm({{"S_MVAR", 8}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 209}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 111109}, {"S_KNUM", 3001}}), "61322");
  EXPECT_EQ(alarm({{"S_SETV", 0}}), "61319");
  EXPECT_EQ(alarm({{"S_INCA", 91}}), "61319");
  EXPECT_EQ(alarm({{"S_STA1", 91}}), "61319") << "the last point lies beyond 360 degrees";
  EXPECT_EQ(alarm({{"S_STA1", -361}}), "61319");
  EXPECT_EQ(alarm({{"S_STA1", 90}}), "");
  EXPECT_EQ(alarm({{"S_STA1", -360}}), "");
  EXPECT_EQ(alarm({{"S_SETV0", 1.5}}), "61303");
  EXPECT_EQ(alarm({}), "");
  bench.set("$TC_DP1", {1, 1}, 712);
  EXPECT_EQ(alarm({}), "61309");
}

}  // namespace
}  // namespace probewright
