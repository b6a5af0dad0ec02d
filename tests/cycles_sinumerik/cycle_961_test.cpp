#include "support/sinumerik_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

/// A corner at the origin of `pose` with edges along +X and, `opening` degrees on, two arms of material beside them:
/// between the edges (outside corner) or behind them (inside corner).
void placeCorner(simulation::Truth& truth, const Pose& pose, double opening, bool inside) {
  const Pose second = pose * rotation(Vector3::UnitZ(), opening);
  if (inside) {
    place(truth, simulation::Box({-150, -60, -60}, {200, 0, 0}), pose, "first edge");
    place(truth, simulation::Box({-150, 0, -60}, {200, 60, 0}), second, "second edge");
  } else {
    place(truth, simulation::Box({0, 0, -60}, {200, 30, 0}), pose, "first edge");
    place(truth, simulation::Box({0, -30, -60}, {200, 0, 0}), second, "second edge");
  }
}

/// The manual: measurements run parallel to the axes of the active workpiece system.
void expectTouchesAlongTheAxes(const SinumerikBench& bench) {
  for (const control::TouchRecord& touch : bench.control.journal.cycles.back().touches)
    EXPECT_EQ(touch.direction.cwiseAbs().maxCoeff(), 1.0) << touch.direction.transpose();
}

struct Scene {
  Pose believed, part;
  double angle;
};

Scene plantedScene(Planter& plant, double approximate) {
  Scene scene;
  scene.angle = approximate + plant.number(-3, 3);
  scene.believed = translation({20, 30, table});
  scene.part = scene.believed * translation({plant.number(-2, 2), plant.number(-2, 2), 0}) *
               rotation(Vector3::UnitZ(), scene.angle);
  return scene;
}

void expectAligned(SinumerikBench& bench, const Scene& scene, const Vector2& set, double edgeAngle = 0) {
  const Vector3 corner = inWorkpiece(bench, scene.part.translation());
  EXPECT_NEAR(corner.x(), set.x(), 1e-9);
  EXPECT_NEAR(corner.y(), set.y(), 1e-9);
  const Vector3 edge =
      bench.control.machineFromWorkpiece().linear().inverse() * (scene.part.linear() * Vector3::UnitX());
  EXPECT_NEAR(degreesFromRadians(std::atan2(edge.y(), edge.x())), edgeAngle, 1e-9);
}

TEST(Cycle961, FindsRightAngledCornersByThreePoints) {
  Planter plant(961);
  for (int world = 0; world < 40; ++world) {
    const bool inside = world % 2 == 0;
    const double approximate = world % 4 < 2 ? 0 : plant.number(-80, 80);
    const Scene scene = plantedScene(plant, approximate);
    simulation::Truth truth = perfectWorld();
    placeCorner(truth, scene.part, 90, inside);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, scene.believed.translation());
    const double side = inside ? 15 : -15;
    const Vector3 pole = rotation(Vector3::UnitZ(), approximate) * Vector3(side, side, -10);
    bench.start(pole);
    bench.run("CYCLE961", {{"S_MVAR", inside ? 105.0 : 106.0},
                           {"S_KNUM", 1},
                           {"S_SETV0", inside ? 10.0 : 45.0},
                           {"S_SETV1", 90},
                           {"S_SETV2", 60},
                           {"S_SETV4", pole.x()},
                           {"S_SETV5", pole.y()},
                           {"S_SETV8", 5},
                           {"S_SETV9", -7},
                           {"S_STA1", approximate},
                           {"S_FA", 20},
                           {"S_TSA", 5}});
    EXPECT_NEAR(bench.ovr(4), scene.angle, 1e-9);
    const Vector3 corner = scene.believed.inverse() * scene.part.translation();
    EXPECT_NEAR(bench.ovr(5), corner.x(), 1e-9);
    EXPECT_NEAR(bench.ovr(6), corner.y(), 1e-9);
    EXPECT_NEAR(bench.ovr(21), scene.part.translation().x(), 1e-9);
    EXPECT_NEAR(bench.ovr(22), scene.part.translation().y(), 1e-9);
    expectTouchesAlongTheAxes(bench);
    expectAligned(bench, scene, {5, -7});
    EXPECT_NEAR((bench.machine.tipOnTable() - (scene.believed * pole + Vector3(0, 0, 2))).norm(), 0, 1e-6)
        << "the probe is back where it started, its ball's centre over its lowest point";
  }
}

TEST(Cycle961, TouchesAlongTheAxesOfATurnedSystem) {
  // The part lies at 30 degrees, and so does G54: the probe travels along the edges of the part, not of the machine.
  // With G54 straight it travels along the machine's axes and meets the same edges askew.
  for (const bool turned : {true, false}) {
    const Pose part = translation({20.4, 30.3, table}) * rotation(Vector3::UnitZ(), 31);
    simulation::Truth truth = perfectWorld();
    placeCorner(truth, part, 90, false);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {20, 30, table}, {0, 0, turned ? 30.0 : 0.0});
    const Vector3 pole =
        turned ? Vector3(-15, -15, -10) : Vector3(rotation(Vector3::UnitZ(), 30) * Vector3(-15, -15, -10));
    bench.start(pole);
    bench.run("CYCLE961", {{"S_MVAR", 6},
                           {"S_SETV0", 45},
                           {"S_SETV1", 90},
                           {"S_SETV2", 60},
                           {"S_SETV4", pole.x()},
                           {"S_SETV5", pole.y()},
                           {"S_STA1", turned ? 0.0 : 30.0},
                           {"S_FA", 20},
                           {"S_TSA", 5}});
    EXPECT_NEAR(bench.ovr(20), 31, 1e-9);
    EXPECT_NEAR(bench.ovr(21), 20.4, 1e-9);
    EXPECT_NEAR(bench.ovr(22), 30.3, 1e-9);
    expectTouchesAlongTheAxes(bench);
    // Across an edge that lies askew the way is longer: the ball comes to rest beside the point, not in front of it.
    const auto& touches = bench.control.journal.cycles.back().touches;
    ASSERT_EQ(touches.size(), 3U);
    const Vector3 along =
        turned ? Vector3(Vector3::UnitX()) : Vector3(rotation(Vector3::UnitZ(), 30) * Vector3::UnitX());
    const double aside = (touches[0].ballCentre - pole).dot(along) - 45;
    if (turned) {
      EXPECT_NEAR(aside, 0, 1e-9);
    } else {
      EXPECT_GT(std::abs(aside), 5) << "15 mm tan 30 degrees and less the ball";
    }
  }
}

TEST(Cycle961, KnowsTheFourPositionsOfACorner) {
  for (int corner = 1; corner <= 4; ++corner) {
    const double signX = corner == 2 || corner == 3 ? -1 : 1, signY = corner >= 3 ? -1 : 1;
    simulation::Truth truth = perfectWorld();
    const Pose part = translation({20.5, 29.25, table}) * rotation(Vector3::UnitZ(), 1.5);
    place(truth,
          simulation::Box({signX > 0 ? 0.0 : -120.0, signY > 0 ? 0.0 : -120.0, -60},
                          {signX > 0 ? 120.0 : 0.0, signY > 0 ? 120.0 : 0.0, 0}),
          part);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {20, 30, table});
    bench.start({-15 * signX, -15 * signY, -10});
    bench.run("CYCLE961", {{"S_MVAR", 10000.0 * corner + 106},
                           {"S_KNUM", 1},
                           {"S_SETV0", 30 * signX},
                           {"S_SETV1", 90 * signX},
                           {"S_SETV2", 60 * signY},
                           {"S_SETV4", -15 * signX},
                           {"S_SETV5", -15 * signY},
                           {"S_FA", 20},
                           {"S_TSA", 5}});
    EXPECT_NEAR(bench.ovr(4), 1.5, 1e-9) << corner;
    expectAligned(bench, {{}, part, 1.5}, {0, 0});
    EXPECT_EQ(bench.control.journal.cycles.back().fits.size(), 1U) << "the edge with two points; the other has one";
  }
}

TEST(Cycle961, FindsAnyCornerByFourPoints) {
  Planter plant(9617);
  for (int world = 0; world < 40; ++world) {
    const bool inside = world % 2 == 0, byCoordinates = world % 4 >= 2;
    const double opening = plant.number(inside ? 65 : 90, 115);
    const Scene scene = plantedScene(plant, 0);
    simulation::Truth truth = perfectWorld();
    placeCorner(truth, scene.part, opening, inside);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, scene.believed.translation());
    const Vector3 first = Vector3::UnitX(), second = rotation(Vector3::UnitZ(), opening) * Vector3::UnitX();
    const Vector3 pole = (first + second).normalized() * (inside ? 25 : -25);
    const Vector3 points[] = {pole + first * (inside ? 5 : 35), pole + first * 100, pole + second * (inside ? 5 : 35),
                              pole + second * 100};
    bench.start({pole.x(), pole.y(), -10});
    NamedNumbers call = {{"S_KNUM", 1}, {"S_FA", 5}, {"S_TSA", 5}, {"S_STA1", 0}, {"S_INCA", opening}};
    if (byCoordinates) {
      for (std::size_t i = 0; i < 4; ++i) {
        call.emplace_back("S_SETV" + std::to_string(2 * i), points[i].x());
        call.emplace_back("S_SETV" + std::to_string(2 * i + 1), points[i].y());
      }
      call.emplace_back("S_MVAR", inside ? 117 : 118);
    } else {
      call = with(call, {{"S_MVAR", inside ? 107 : 108},
                         {"S_SETV0", inside ? 5 : 35},
                         {"S_SETV1", 100},
                         {"S_SETV2", inside ? 5 : 35},
                         {"S_SETV3", 100},
                         {"S_SETV4", pole.x()},
                         {"S_SETV5", pole.y()}});
    }
    bench.run("CYCLE961", call);
    expectTouchesAlongTheAxes(bench);
    EXPECT_NEAR(bench.ovr(4), scene.angle, 1e-9);
    expectAligned(bench, scene, {0, 0});
  }
}

TEST(Cycle961, StepsOverTheCornerWithAProtectionZone) {
  simulation::Truth truth = perfectWorld();
  const Pose part = translation({20.5, 29.25, table}) * rotation(Vector3::UnitZ(), -2);
  placeCorner(truth, part, 90, false);
  place(truth, simulation::Box({-40, -40, -60}, {-8, -8, 5}), translation({20, 30, table}), "clamp");
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {20, 30, table});
  bench.start({-15, -15, 20});
  bench.run("CYCLE961", {{"S_MVAR", 1106},
                         {"S_KNUM", 1},
                         {"S_SETV0", 40},
                         {"S_SETV1", 90},
                         {"S_SETV2", 70},
                         {"S_SETV4", -15},
                         {"S_SETV5", -15},
                         {"S_ID", -30},
                         {"S_FA", 20},
                         {"S_TSA", 5}});
  expectAligned(bench, {{}, part, -2}, {0, 0});
}

TEST(Cycle961, RefusesWithTheControlsAlarms) {
  simulation::Truth truth = perfectWorld();
  placeCorner(truth, translation({20, 30, table}) * rotation(Vector3::UnitZ(), 2), 90, false);
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {20, 30, table});
  const auto alarm = [&](const NamedNumbers& changed) {
    bench.start({-15, -15, -10});
    return bench.alarmOf("CYCLE961", with({{"S_MVAR", 106},
                                           {"S_KNUM", 1},
                                           {"S_SETV0", 30},
                                           {"S_SETV1", 80},
                                           {"S_SETV2", 60},
                                           {"S_SETV4", -15},
                                           {"S_SETV5", -15},
                                           {"S_FA", 20},
                                           {"S_TSA", 5}},
                                          changed));
  };
  EXPECT_EQ(alarm({{"S_MVAR", 104}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 50106}}), "61307");
  EXPECT_EQ(alarm({{"S_KNUM", 3001}}), "61322");
  EXPECT_EQ(alarm({{"S_SETV1", 30}}), "61319");
  EXPECT_EQ(alarm({{"S_FA", 0}}), "61308");
  EXPECT_EQ(alarm({{"S_TSA", 1}}), "61303");
  EXPECT_EQ(alarm({{"S_MVAR", 108}, {"S_SETV3", 90}, {"S_INCA", 180}}), "61319");
  EXPECT_EQ(alarm({{"S_SETV1", 400}}), "61301") << "beyond the end of the edge";
  EXPECT_EQ(alarm({}), "");
  // By coordinates: points 1 and 2 lie at (30, -15) and (80, -15).
  const auto alarmFor = [&](double x, double y) {
    return alarm(
        {{"S_MVAR", 116}, {"S_SETV1", -15}, {"S_SETV2", 80}, {"S_SETV3", -15}, {"S_SETV4", x}, {"S_SETV5", y}});
  };
  EXPECT_EQ(alarmFor(-15, 60), "");
  EXPECT_EQ(alarmFor(-15, -15), "61319") << "point 3 on the first edge";
  EXPECT_EQ(alarmFor(55, 60), "61319") << "the corner midway between points 1 and 2";
}

}  // namespace
}  // namespace probewright
