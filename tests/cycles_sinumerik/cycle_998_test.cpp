#include "support/sinumerik_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

/// The angle of a direction from the positive offset axis, counter-clockwise about the axis left over.
double angleOf(const Vector3& direction, int measuring, int offset) {
  const Vector3 o = Vector3::Unit(offset), about = Vector3::Unit(3 - measuring - offset);
  return degreesFromRadians(std::atan2(about.dot(o.cross(direction)), o.dot(direction)));
}

TEST(Cycle998, TurnsTheWorkpieceSystemAlongTheEdge) {
  Planter plant(998);
  const struct {
    int measuring, offset;
    Vector3 start;
  } cases[] = {{0, 1, {-10, -40, -20}},
               {1, 0, {-40, -10, -20}},
               {2, 0, {20, 30, 10}},
               {2, 1, {30, 20, 10}},
               {0, 2, {-10, 20, -45}}};
  for (int world = 0; world < 60; ++world) {
    const auto& [measuring, offset, start] = cases[world % 5];
    const bool alongAxes = world % 2 == 0;
    // A wall that leans over the probe cannot be touched at its foot.
    const double set = offset == 2 ? plant.number(2, 4) : plant.number(-4, 4);
    // Expected along the edge, the true angle may differ by the safe area; along the axes by what the path allows.
    const double angle = alongAxes ? plant.number(offset == 2 ? 0 : -6, 6) : set + plant.number(-2, 2);
    const double systemTurn = plant.number(-90, 90);
    const Vector3 about = Vector3::Unit(3 - measuring - offset);
    const Pose believed = translation({10, -5, table}) * rotation(Vector3::UnitZ(), systemTurn);
    const Pose part = believed * rotation(about, angle);
    simulation::Truth truth = perfectWorld();
    const double outX = measuring == 0 ? 0 : -100, outY = measuring == 1 ? 0 : -100;
    place(truth, simulation::Box({outX, outY, -80}, {200, 200, 0}), part);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_CHBFR", 0, {10, -5, table}, {0, 0, systemTurn / 2});
    plantFrame(bench, "$P_UIFR", 1, {0, 0, 0}, {0, 0, systemTurn / 2});
    bench.start(start);
    bench.run("CYCLE998", {{"S_MVAR", alongAxes ? 100105.0 : 105.0},
                           {"S_KNUM", world % 3 == 0 ? 1.0 : 9000.0},
                           {"S_STA1", set},
                           {"S_FA", 9},
                           {"S_TSA", 12},
                           {"S_MA", 100.0 * (offset + 1) + measuring + 1},
                           {"S_MD", measuring == 2 ? 2.0 : 1.0},
                           {"S_ID", offset == 2 ? 30.0 : 50.0}});
    EXPECT_NEAR(bench.ovr(4), angle, 1e-9) << world;
    EXPECT_NEAR(bench.ovr(16), angle - set, 1e-9);
    const Vector3 edge =
        bench.control.machineFromWorkpiece().linear().inverse() * (part.linear() * Vector3::Unit(offset));
    EXPECT_NEAR(angleOf(edge, measuring, offset), set, 1e-9);
    EXPECT_NEAR(bench.data("$P_UIFR", {1, "X", "TR"}) + bench.data("$P_UIFR", {1, "X", "FI"}), 0, 1e-12)
        << "translations stay";
  }
}

/// The zero offset is turned by as much as the part, but the other way.
TEST(Cycle998, ReplacesARotationByItsOpposite) {
  simulation::Truth truth = perfectWorld();
  const Vector3 origin(10, -5, table);
  place(truth, simulation::Box({0, -100, -80}, {200, 200, 0}), translation(origin) * rotation(Vector3::UnitZ(), 2.5));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin, {0, 0, -2.5});
  bench.start({-10, -40, -20});
  bench.run("CYCLE998", {{"S_MVAR", 100105},
                         {"S_KNUM", 9000},
                         {"S_STA1", 0},
                         {"S_FA", 9},
                         {"S_TSA", 12},
                         {"S_MA", 201},
                         {"S_MD", 1},
                         {"S_ID", 50}});
  EXPECT_NEAR(bench.ovr(4), 5, 1e-9);
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "Z", "RT"}), 2.5, 1e-9);
}

TEST(Cycle998, ShiftsTheRotaryTableInstead) {
  for (const double angle : {7.25, -3.5}) {
    simulation::Truth truth = perfectWorld("mill5-head-table");
    const Pose part = translation({10, -5, -450}) * rotation(Vector3::UnitZ(), angle);
    place(truth, simulation::Box({0, -100, -80}, {200, 200, 0}), part);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {10, -5, -450});
    const auto axis = truth.machine.axisIndex("C");
    ASSERT_TRUE(axis);
    const auto edgeAngle = [&] {
      const Vector3 edge =
          baseFromTable(truth.machine, bench.machine.position()).linear() * (part.linear() * Vector3::UnitY());
      return degreesFromRadians(std::atan2(-edge.x(), edge.y()));
    };
    EXPECT_NEAR(edgeAngle(), angle, 1e-9);
    bench.start({-12, -20, -10});
    const NamedNumbers call = {{"S_MVAR", 100105}, {"S_KNUM", 10001}, {"S_RA", static_cast<double>(*axis) + 1},
                               {"S_FA", 11},       {"S_TSA", 10},     {"S_MA", 201},
                               {"S_MD", 1},        {"S_ID", 40}};
    bench.run("CYCLE998", call);
    EXPECT_NEAR(std::abs(bench.data("$P_UIFR", {1, "C", "TR"})), std::abs(angle), 1e-9);
    // Positioning the table anew aligns the part; measured again, there is nothing left to correct.
    bench.start({-40, -20, -10});
    bench.run("CYCLE998", with(call, {{"S_FA", 45}}), {}, "G0 Z80\nG0 C0\nG0 Z-10\n");
    EXPECT_NEAR(edgeAngle(), 0, 1e-9);
    EXPECT_NEAR(bench.ovr(4), 0, 1e-9);
  }
}

TEST(Cycle998, LaysTheWorkpieceSystemOnAPlane) {
  Planter plant(9986);
  for (int world = 0; world < 40; ++world) {
    const double set1 = world % 3 == 0 ? plant.number(-5, 5) : 0, set2 = world % 3 == 0 ? plant.number(-5, 5) : 0;
    const double first = set1 + plant.number(-4, 4), second = set2 + plant.number(-4, 4);
    const Pose believed = translation({10, -5, table}) * rotation(Vector3::UnitZ(), plant.number(-90, 90));
    const Pose part = believed * rotation(Vector3::UnitY(), second) * rotation(Vector3::UnitX(), first);
    simulation::Truth truth = perfectWorld();
    place(truth, simulation::HalfSpace({part * Vector3::Zero(), part.linear() * Vector3::UnitZ()}));
    SinumerikBench bench(truth);
    const double turn = degreesFromRadians(std::atan2(believed.linear()(1, 0), believed.linear()(0, 0)));
    plantFrame(bench, "$P_UIFR", 1, {10, -5, table}, {0, 0, turn});
    bench.start({0, 0, 9});
    bench.run("CYCLE998", {{"S_MVAR", world % 2 == 0 ? 100106.0 : 106.0},
                           {"S_KNUM", 1},
                           {"S_STA1", set1},
                           {"S_INCA", set2},
                           {"S_FA", 10},
                           {"S_TSA", 6},
                           {"S_MA", 103},
                           {"S_SETV0", 40},
                           {"S_SETV2", 15},
                           {"S_SETV3", 35}});
    EXPECT_NEAR(bench.ovr(4), first, 1e-9);
    EXPECT_NEAR(bench.ovr(5), second, 1e-9);
    // The normal has in the new system the direction that the set angles give it.
    const Vector3 normal = bench.control.machineFromWorkpiece().linear().inverse() * (part.linear() * Vector3::UnitZ());
    const Vector3 wanted =
        (rotation(Vector3::UnitY(), set2) * rotation(Vector3::UnitX(), set1)).linear() * Vector3::UnitZ();
    EXPECT_NEAR((normal - wanted).norm(), 0, 1e-11);
  }
}

TEST(Cycle998, StepsOverAnObstacle) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, -100, -60}, {100, 100, 0}),
        translation({0, 0, table}) * rotation(Vector3::UnitZ(), 1));
  place(truth, simulation::Box({-18, -5, -60}, {-6, 5, 0}), translation({0, 0, table}), "clamp");
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const NamedNumbers call = {{"S_MVAR", 101005}, {"S_SETV", 25}, {"S_FA", 6},
                             {"S_TSA", 5},       {"S_MA", 201},  {"S_ID", 60}};
  bench.start({-33, -30, -10});
  bench.run("CYCLE998", call);
  EXPECT_NEAR(bench.ovr(4), 1, 1e-9);
  bench.start({-8, -30, -10});
  EXPECT_EQ(bench.alarmOf("CYCLE998", with(call, {{"S_MVAR", 100005}, {"S_SETV", 0}, {"S_MD", 1}})), "61302");
}

TEST(Cycle998, RefusesWithTheControlsAlarms) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, -100, -60}, {100, 100, 0}),
        translation({0, 0, table}) * rotation(Vector3::UnitZ(), 2));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const auto alarm = [&](const NamedNumbers& changed) {
    bench.start({-10, -20, -10});
    return bench.alarmOf(
        "CYCLE998",
        with({{"S_MVAR", 100105}, {"S_KNUM", 1}, {"S_FA", 9}, {"S_TSA", 5}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 40}},
             changed));
  };
  EXPECT_EQ(alarm({{"S_MVAR", 4}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 205}}), "61307") << "there is no tool correction";
  EXPECT_EQ(alarm({{"S_MVAR", 120105}}), "61307");
  for (const double axes : {101.0, 200.0, 204.0, 2.0, 402.0, 211.0})
    EXPECT_EQ(alarm({{"S_MA", axes}}), "61325") << axes;
  EXPECT_EQ(alarm({{"S_MD", 3}}), "61326");
  EXPECT_EQ(alarm({{"S_MD", 0}, {"S_SETV", -10}}), "61326") << "the probe is already at the set value";
  EXPECT_EQ(alarm({{"S_ID", 0}}), "61319");
  EXPECT_EQ(alarm({{"S_STA1", 46}}), "61319");
  EXPECT_EQ(alarm({{"S_KNUM", 3001}}), "61322");
  EXPECT_EQ(alarm({{"S_TSA", 1}}), "61303");
  EXPECT_EQ(alarm({{"S_RA", 1}}), "61329");
  EXPECT_EQ(bench.data("$P_UIFR", {1, "Z", "RT"}), 0) << "an alarm writes nothing";
  EXPECT_EQ(alarm({}), "");
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "Z", "RT"}), 2, 1e-9);
}

}  // namespace
}  // namespace probewright
