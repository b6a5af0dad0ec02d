#include "control/heidenhain/deflection_table.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// Cycles 1410, 1411 and 1420 take the data of a 3-D calibration into account, direction by direction.
namespace probewright::testing_support {
namespace {

namespace hh = control::heidenhain;

/// What the table adds to the ball radius at the pole and at azimuths 0, 90, 180 and 270.
constexpr double pole = 0.011, east = 0.03, north = -0.02, west = 0.01, south = 0.04;
constexpr double near = 2e-6;

/// A perfect probe whose table says otherwise: every surface seems deeper by the value of its direction.
struct World {
  Bench bench;
  TableFolder folder{bench};
  World() {
    bench.preset(1, {0, 0, -400});
    bench.believedProbe().maximumTravel = 30;
    std::vector<hh::Deflection> rows = {{.polar = 0, .azimuth = 0, .deviation = pole}};
    const double values[] = {east, north, west, south};
    for (int i = 0; i < 4; ++i)
      rows.push_back({.polar = 90, .azimuth = 90.0 * i, .deviation = values[i]});
    folder.put("T1.3DTC", *hh::deflectionTable("T1.3DTC", rows));
    auto tools = hh::defaultToolTable(ControlKind::TNC640);
    EXPECT_TRUE(tools.ensureRow("1"));
    EXPECT_TRUE(tools.setText("1", "NAME", "PROBE"));
    EXPECT_TRUE(tools.setNumber("1", "L", 100));
    EXPECT_TRUE(tools.setNumber("1", "R", 2));
    EXPECT_TRUE(tools.setText("1", "TP_NO", "1"));
    EXPECT_TRUE(tools.setText("1", "DR2TABLE", "T1.3DTC"));
    folder.put("TOOL.T", tools);
  }
};
const Words travel = {{320, 0}, {260, 20}, {1125, 1}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 0}};

TEST(RotationProbeData, CountInTheDirectionOfEveryTouch) {
  World world;
  world.bench.part(simulation::Box({-50, -40, -40}, {50, 40, 0}), pose({0, 0, -400}));
  struct Side {
    int direction;
    Vector2 first, second;
    double place;  ///< what the touches find along their axis
  };
  const Side sides[] = {{1, {-50, -20}, {-50, 20}, -50 + east},
                        {-1, {50, -20}, {50, 20}, 50 - west},
                        {2, {-30, -40}, {30, -40}, -40 + north},
                        {-2, {-30, 40}, {30, 40}, 40 - south}};
  for (const Side& side : sides) {
    SCOPED_TRACE(side.direction);
    const Ran ran = world.bench.run(probe(1410, with(travel, {{1100, side.first.x()},
                                                              {1101, side.first.y()},
                                                              {1102, -8},
                                                              {1103, side.second.x()},
                                                              {1104, side.second.y()},
                                                              {1105, -8},
                                                              {372, side.direction}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const int axis = std::abs(side.direction) - 1;
    EXPECT_NEAR(ran.q(950 + axis), side.place, near);
    EXPECT_NEAR(ran.q(953 + axis), side.place, near);
  }
  const Ran top = world.bench.run(probe(1420, with(travel, {{1100, -30},
                                                            {1101, -20},
                                                            {1102, 0},
                                                            {1103, 30},
                                                            {1104, -20},
                                                            {1105, 0},
                                                            {1106, 0},
                                                            {1107, 20},
                                                            {1108, 0},
                                                            {372, -3}})));
  ASSERT_TRUE(top.finished()) << top.why();
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(top.q(952 + 3 * i), -pole, near);
}

TEST(RotationProbeData, CountOnCircles) {
  World world;
  world.bench.part(simulation::Ring(20, 28, -30), pose({-40, 0, -400}));
  world.bench.part(simulation::RoundBar(20, -30, 0), pose({40, 0, -400}));
  const Ran ran = world.bench.run(probe(1411, with(travel, {{1100, -40},
                                                            {1101, 0},
                                                            {1102, -8},
                                                            {1116, 40},
                                                            {1103, 40},
                                                            {1104, 0},
                                                            {1105, -8},
                                                            {1117, 40},
                                                            {1115, 2},
                                                            {423, 4},
                                                            {325, 0},
                                                            {1119, 360}})));
  ASSERT_TRUE(ran.finished()) << ran.why();
  // Four touches: in the hole outwards, at the stud inwards. Squares of the values are left out.
  const double squared = 5e-5, mean = (east + north + west + south) / 2;
  EXPECT_NEAR(ran.q(950), -40 + (east - west) / 2, squared);
  EXPECT_NEAR(ran.q(951), (north - south) / 2, squared);
  EXPECT_NEAR(ran.q(966), 40 + mean, squared);
  EXPECT_NEAR(ran.q(953), 40 + (east - west) / 2, squared);
  EXPECT_NEAR(ran.q(954), (north - south) / 2, squared);
  EXPECT_NEAR(ran.q(967), 40 - mean, squared);
}

}  // namespace
}  // namespace probewright::testing_support
