#include "support/sinumerik_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

TEST(Cycle979, FindsCentreAndDiameterOfASegment) {
  Planter plant(979);
  for (int world = 0; world < 60; ++world) {
    const bool inside = world % 2 == 0, four = world % 4 < 2;
    const double radius = plant.number(25, 50), startAngle = plant.number(-180, 180);
    const double step = plant.number(20, four ? 90 : 120) * (world % 3 == 0 ? -1 : 1);
    const Vector2 set = {plant.number(-10, 10), plant.number(-10, 10)};
    const Vector3 error = {plant.number(-0.8, 0.8), plant.number(-0.8, 0.8), 0};
    const Vector3 centre = Vector3(set.x(), set.y(), table) + error;
    simulation::Truth truth = perfectWorld();
    if (inside) {
      place(truth, simulation::Ring(radius, 300, -60), translation(centre));
    } else {
      place(truth, simulation::RoundBar(radius, -60, 0), translation(centre));
    }
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    const Vector3 radial = probing::directionAt(startAngle).vector();
    bench.start(Vector3(set.x(), set.y(), -10) + radial * (radius + (inside ? -8 : 8)));
    bench.run("CYCLE979", {{"S_MVAR", (four ? 1000.0 : 0.0) + (inside ? 101 : 102)},
                           {"S_KNUM", 1},
                           {"S_SETV", 2 * radius - 0.3},
                           {"S_FA", 5},
                           {"S_TSA", 2},
                           {"S_CPA", set.x()},
                           {"S_CPO", set.y()},
                           {"S_STA1", startAngle},
                           {"S_INCA", step}});
    EXPECT_NEAR(bench.ovr(4), 2 * radius, 1e-7) << world;
    EXPECT_NEAR(bench.ovr(5), centre.x(), 1e-7);
    EXPECT_NEAR(bench.ovr(6), centre.y(), 1e-7);
    EXPECT_NEAR(bench.ovr(16), 0.3, 1e-7);
    EXPECT_NEAR(bench.ovr(17), error.x(), 1e-7);
    EXPECT_NEAR(bench.ovr(18), error.y(), 1e-7);
    EXPECT_NEAR((inWorkpiece(bench, centre).head<2>() - set).norm(), 0, 1e-7);
  }
}

TEST(Cycle979, CorrectsTheToolByHalfTheDifference) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::RoundBar(30.02, -60, 0), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  bench.set("$TC_DP1", {7, 1}, 120);
  bench.start({40, 0, -10});
  bench.run("CYCLE979", {{"S_MVAR", 202}, {"S_KNUM1", 1}, {"S_SETV", 60}, {"S_FA", 5}, {"S_TSA", 1}, {"S_INCA", 60}},
            {{"S_TNAME", "MILL"}});
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 1}), -0.02, 1e-7) << "a spigot too large was made by a tool too small";
}

TEST(Cycle979, RefusesWithTheControlsAlarms) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(30, 300, -60), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const auto alarm = [&](const NamedNumbers& changed) {
    bench.start({20, 0, -10});
    return bench.alarmOf("CYCLE979",
                         with({{"S_MVAR", 1}, {"S_SETV", 60}, {"S_FA", 5}, {"S_TSA", 1}, {"S_INCA", 60}}, changed));
  };
  EXPECT_EQ(alarm({{"S_MVAR", 3}}), "61307");
  EXPECT_EQ(alarm({{"S_INCA", 0}}), "61319");
  EXPECT_EQ(alarm({{"S_INCA", 121}}), "61319");
  EXPECT_EQ(alarm({{"S_MVAR", 1001}, {"S_INCA", 91}}), "61319");
  EXPECT_EQ(alarm({{"S_SETV", 0}}), "61319");
  EXPECT_EQ(alarm({{"S_SETV", 57}}), "61303");
  EXPECT_EQ(alarm({}), "");
}

}  // namespace
}  // namespace probewright
