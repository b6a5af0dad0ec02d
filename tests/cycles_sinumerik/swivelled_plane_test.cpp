#include "support/sinumerik_bench.hpp"

/// The cycles in planes that CYCLE800 has swivelled and on tables that TRAORI follows, on machines of every build: what
/// they measure there lies where it was planted, and the corrected frame brings it to its set position.
namespace probewright {
namespace {

using namespace testing_support;

constexpr const char* builds[] = {"mill5-table-table", "mill5-head-table", "mill5-head-head"};

/// A settable frame, and a plane swivelled in it.
struct Plane {
  Vector3 origin, reference;
  double turn = 0, a = 0, b = 0;
  Pose pose;  ///< table from plane, as the control believes

  explicit Plane(Planter& plant)
      : origin(Vector3(15, -10, -400) + plant.within(10)),
        reference(plant.within(20)),
        turn(plant.number(-60, 60)),
        a(plant.number(-20, 20)),
        b(plant.number(-20, 20)),
        pose(translation(origin) * rotation(Vector3::UnitZ(), turn) * translation(reference) *
             rotation(Vector3::UnitX(), a) * rotation(Vector3::UnitY(), b)) {}

  void plantIn(SinumerikBench& bench) const { plantFrame(bench, "$P_UIFR", 1, origin, {0, 0, turn}); }

  /// Swivels, and brings the probe to `start` from above.
  std::string approach(const Vector3& start) const {
    return fmt::format(
        "SUPA G0 Z0 D0\nD1\nCYCLE800(0,\"\",0,57,{:.12f},{:.12f},{:.12f},{:.12f},{:.12f},0,0,0,0,-1)\n"
        "G0 X{:.12f} Y{:.12f}\nG0 Z{:.12f}\n",
        reference.x(), reference.y(), reference.z(), a, b, start.x(), start.y(), start.z());
  }
};

struct Scene {
  Plane plane;
  simulation::Truth truth;
  Scene(Planter& plant, int world) : plane(plant), truth(perfectWorld(builds[world % 3])) {}
};

constexpr double targets[] = {9000, 10001, 1001, 1};

TEST(SwivelledPlane, Cycle978SetsFacesInEveryAxis) {
  Planter plant(8001);
  for (int world = 0; world < 30; ++world) {
    Scene scene(plant, world);
    const int axis = world % 3;
    const Vector3 error = plant.within(1.5);
    const double set = plant.number(-3, 3);
    place(scene.truth, simulation::Box({0, 0, -60}, {120, 100, 0}), scene.plane.pose * translation(error));
    SinumerikBench bench(scene.truth);
    scene.plane.plantIn(bench);
    Vector3 start(20, 20, -10);
    start[axis] = axis == 2 ? 12 : -12;
    bench.run("CYCLE978",
              {{"S_MVAR", 100},
               {"S_KNUM", targets[world % 4]},
               {"S_SETV", set},
               {"S_FA", 9},
               {"S_TSA", 9},
               {"S_MA", axis + 1.0},
               {"S_MD", axis == 2 ? 2.0 : 1.0}},
              {}, scene.plane.approach(start));
    const Vector3 onFace =
        scene.plane.pose * translation(error) * (Vector3(30, 30, 0) - 30 * Vector3::Unit(axis) * (axis < 2));
    EXPECT_NEAR(inWorkpiece(bench, onFace)[axis], set, 1e-7) << world;
    EXPECT_NEAR(bench.ovr(4), error[axis], 1e-7) << world;
  }
}

TEST(SwivelledPlane, Cycle977CentresHolesAndSpigots) {
  Planter plant(8002);
  for (int world = 0; world < 24; ++world) {
    Scene scene(plant, world);
    const bool hole = world % 2 == 0;
    const double radius = plant.number(15, 25);
    const Vector3 error(plant.number(-1, 1), plant.number(-1, 1), 0);
    const Pose part = scene.plane.pose * translation(error);
    if (hole) {
      place(scene.truth, simulation::Ring(radius, 80, -50), part);
    } else {
      place(scene.truth, simulation::RoundBar(radius, -50, 0), part);
    }
    SinumerikBench bench(scene.truth);
    scene.plane.plantIn(bench);
    bench.run("CYCLE977",
              {{"S_MVAR", hole ? 101.0 : 102.0},
               {"S_KNUM", targets[world % 4]},
               {"S_SETV", 2 * radius + 0.2},
               {"S_FA", 4},
               {"S_TSA", 2},
               {"S_STA1", plant.number(-90, 90)},
               {"S_ID", -15}},
              {}, scene.plane.approach({0, 0, hole ? -8.0 : 10.0}));
    EXPECT_NEAR(bench.ovr(4), 2 * radius, 1e-6) << world;
    EXPECT_NEAR(inWorkpiece(bench, part.translation()).head<2>().norm(), 0, 1e-6) << world;
  }
}

TEST(SwivelledPlane, Cycle979CentresSegments) {
  Planter plant(8003);
  for (int world = 0; world < 18; ++world) {
    Scene scene(plant, world);
    const double radius = plant.number(20, 30), startAngle = plant.number(-180, 180);
    const Vector3 error(plant.number(-0.8, 0.8), plant.number(-0.8, 0.8), 0);
    const Pose part = scene.plane.pose * translation(error);
    place(scene.truth, simulation::Ring(radius, 80, -50), part);
    SinumerikBench bench(scene.truth);
    scene.plane.plantIn(bench);
    const Vector3 start = Vector3(0, 0, -10) + (radius - 9) * probing::directionAt(startAngle).vector();
    bench.run("CYCLE979",
              {{"S_MVAR", world % 2 == 0 ? 101.0 : 1101.0},
               {"S_KNUM", targets[world % 4]},
               {"S_SETV", 2 * radius},
               {"S_FA", 5},
               {"S_TSA", 2},
               {"S_STA1", startAngle},
               {"S_INCA", plant.number(40, 90)}},
              {}, scene.plane.approach(start));
    EXPECT_NEAR(bench.ovr(4), 2 * radius, 1e-6) << world;
    EXPECT_NEAR(inWorkpiece(bench, part.translation()).head<2>().norm(), 0, 1e-6) << world;
  }
}

TEST(SwivelledPlane, Cycle998TurnsTheSystemAlongEdgesAndPlanes) {
  Planter plant(8004);
  for (int world = 0; world < 24; ++world) {
    Scene scene(plant, world);
    const bool edge = world % 2 == 0;
    const double first = plant.number(-3, 3), second = plant.number(-3, 3);
    const Pose part =
        scene.plane.pose * (edge ? rotation(Vector3::UnitZ(), first)
                                 : Pose(rotation(Vector3::UnitY(), second) * rotation(Vector3::UnitX(), first)));
    place(scene.truth, simulation::Box({edge ? 0.0 : -60.0, -60, -60}, {60, 60, 0}), part);
    SinumerikBench bench(scene.truth);
    scene.plane.plantIn(bench);
    const double target = world % 4 < 2 ? 1 : 1001;
    if (edge) {
      bench.run("CYCLE998",
                {{"S_MVAR", 100105},
                 {"S_KNUM", target},
                 {"S_FA", 9},
                 {"S_TSA", 12},
                 {"S_MA", 201},
                 {"S_MD", 1},
                 {"S_ID", 40}},
                {}, scene.plane.approach({-12, -20, -15}));
      EXPECT_NEAR(bench.ovr(4), first, 1e-6) << world;
    } else {
      bench.run("CYCLE998",
                {{"S_MVAR", 100106},
                 {"S_KNUM", target},
                 {"S_FA", 9},
                 {"S_TSA", 12},
                 {"S_SETV0", 40},
                 {"S_SETV2", 20},
                 {"S_SETV3", 40}},
                {}, scene.plane.approach({-20, -20, 12}));
      EXPECT_NEAR(bench.ovr(4), first, 1e-6) << world;
      EXPECT_NEAR(bench.ovr(5), second, 1e-6) << world;
    }
    const Matrix3 seen = bench.control.machineFromWorkpiece().linear().inverse() * part.linear();
    if (edge) {
      EXPECT_NEAR((seen - Matrix3::Identity()).norm(), 0, 1e-6) << world;
    } else {
      EXPECT_NEAR((seen.col(2) - Vector3::UnitZ()).norm(), 0, 1e-6) << world;
    }
  }
}

TEST(SwivelledPlane, Cycle961SetsCorners) {
  Planter plant(8005);
  for (int world = 0; world < 18; ++world) {
    Scene scene(plant, world);
    const double angle = plant.number(-2, 2);
    const Vector3 error(plant.number(-1, 1), plant.number(-1, 1), 0);
    const Pose part = scene.plane.pose * translation(error) * rotation(Vector3::UnitZ(), angle);
    place(scene.truth, simulation::Box({0, 0, -50}, {80, 80, 0}), part);
    SinumerikBench bench(scene.truth);
    scene.plane.plantIn(bench);
    bench.run("CYCLE961",
              {{"S_MVAR", 106},
               {"S_KNUM", world % 2 == 0 ? 9000.0 : 10001.0},
               {"S_SETV0", 20},
               {"S_SETV1", 50},
               {"S_SETV2", 30},
               {"S_SETV4", -12},
               {"S_SETV5", -12},
               {"S_FA", 10},
               {"S_TSA", 8}},
              {}, scene.plane.approach({-12, -12, -10}));
    EXPECT_NEAR(inWorkpiece(bench, part.translation()).head<2>().norm(), 0, 1e-6) << world;
    const Matrix3 seen = bench.control.machineFromWorkpiece().linear().inverse() * part.linear();
    EXPECT_NEAR((seen - Matrix3::Identity()).norm(), 0, 1e-6) << world;
  }
}

TEST(SwivelledPlane, Cycle997SetsBalls) {
  Planter plant(8006);
  for (int world = 0; world < 18; ++world) {
    Scene scene(plant, world);
    const Vector3 error = plant.within(1);
    place(scene.truth, simulation::SolidSphere(Vector3::Zero(), 12), scene.plane.pose * translation(error));
    SinumerikBench bench(scene.truth);
    scene.plane.plantIn(bench);
    bench.run("CYCLE997",
              {{"S_MVAR", world % 2 == 0 ? 101119.0 : 119.0},
               {"S_KNUM", targets[world % 4]},
               {"S_SETV", 24},
               {"S_FA", 5},
               {"S_TSA", 2},
               {"S_INCA", 90}},
              {}, scene.plane.approach({0, 0, 22}));
    EXPECT_NEAR(inWorkpiece(bench, scene.plane.pose * error).norm(), 0, 1e-6) << world;
  }
}

TEST(SwivelledPlane, TheSpindleTurnsTheProbeIntoDirectionsOfThePlane) {
  // A tip 0.2 beside the axis. A probe with one direction, one that is aligned, one that is reversed, and one whose
  // spindle follows the workpiece system: each knows only what its method needs.
  Planter plant(8008);
  enum Way { OneDirection, Aligned, Reversed, Following };
  for (int world = 0; world < 48; ++world) {
    Scene scene(plant, world);
    const Way way = static_cast<Way>(world / 3 % 4);
    const int axis = world / 12 % 2;
    const double angle = way == OneDirection ? plant.number(0, 300) : 0;
    scene.truth.tools[0].probe.tipOffset = {0.2 * std::cos(radiansFromDegrees(-angle)),
                                            0.2 * std::sin(radiansFromDegrees(-angle))};
    const Vector3 error = plant.within(1);
    place(scene.truth, simulation::Box({0, 0, -60}, {120, 100, 0}), scene.plane.pose * translation(error));
    SinumerikBench bench(scene.truth);
    scene.plane.plantIn(bench);
    if (way == OneDirection) {
      bench.set("$TC_DP1", {1, 1}, 712);
      bench.set("$TC_DP10", {1, 1}, angle);
      bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX2", {0}, 2.2);
    }
    if (way != Reversed) bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 2.2);
    if (way == Following) {
      bench.set("$SNS_MEA_WP_POS_DEV_AX1", {0}, 0.2);
      bench.set("$SCS_MEA_FUNCTION_MASK", {}, 3);
    }
    const Vector3 start = axis == 0 ? Vector3(-12, 20, -10) : Vector3(20, -12, -10);
    bench.run("CYCLE978",
              {{"S_MVAR", 100 + (way == Aligned    ? 20000.0
                                 : way == Reversed ? 10000.0
                                                   : 0)},
               {"S_KNUM", targets[world % 4]},
               {"S_FA", 7},
               {"S_TSA", 5},
               {"S_MA", axis + 1.0},
               {"S_MD", 1}},
              {}, scene.plane.approach(start));
    EXPECT_NEAR(bench.ovr(4), error[axis], 1e-7) << "world " << world << " way " << static_cast<int>(way);
  }
}

TEST(Traori, TurnsTheProbeWithTheTable) {
  Planter plant(8009);
  for (int world = 0; world < 12; ++world) {
    simulation::Truth truth = perfectWorld(world % 2 == 0 ? "mill5-table-table" : "mill5-head-table");
    const Vector3 origin(20, -15, -400);
    const Vector3 error(plant.number(-1, 1), plant.number(-1, 1), 0);
    truth.tools[0].probe.tipOffset = {0.2, 0};
    place(truth, simulation::Ring(20, 80, -50), translation(origin + error));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 2.2);
    bench.run("CYCLE977", {{"S_MVAR", 20001}, {"S_SETV", 40.1}, {"S_FA", 4}, {"S_TSA", 2}}, {},
              fmt::format("SUPA G0 Z0 D0\nD1\nTRAORI\nG0 C{:.6f}\nG0 X0 Y0\nG0 Z-8\n", plant.number(-170, 170)));
    EXPECT_NEAR(bench.ovr(4), 40, 1e-6) << world;
    EXPECT_NEAR(bench.ovr(5), error.x(), 1e-6) << world;
    EXPECT_NEAR(bench.ovr(6), error.y(), 1e-6) << world;
  }
}

TEST(Traori, MeasuresOnATableThatHasTurned) {
  Planter plant(8007);
  for (int world = 0; world < 20; ++world) {
    simulation::Truth truth = perfectWorld(world % 2 == 0 ? "mill5-table-table" : "mill5-head-table");
    const Vector3 origin = Vector3(20, -15, -400) + plant.within(10);
    const Vector3 error(plant.number(-1, 1), plant.number(-1, 1), 0);
    const Pose part = translation(origin + error);
    place(truth, simulation::Ring(20, 80, -50), part);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.run("CYCLE977",
              {{"S_MVAR", 101}, {"S_KNUM", targets[world % 4]}, {"S_SETV", 40.1}, {"S_FA", 4}, {"S_TSA", 2}}, {},
              fmt::format("SUPA G0 Z0 D0\nD1\nTRAORI\nG0 C{:.6f}\nG0 X0 Y0\nG0 Z-8\n", plant.number(-170, 170)));
    EXPECT_NEAR(bench.ovr(4), 40, 1e-6) << world;
    EXPECT_NEAR(bench.ovr(17), error.x(), 1e-6) << world;
    EXPECT_NEAR(bench.ovr(18), error.y(), 1e-6) << world;
    EXPECT_NEAR(inWorkpiece(bench, part.translation()).head<2>().norm(), 0, 1e-6) << world;
  }
}

}  // namespace
}  // namespace probewright
