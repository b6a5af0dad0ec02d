#include "cycles_sinumerik/milling_variants.hpp"
#include "machine/description.hpp"

/// Every milling cycle where the workpiece system has turned: on a table that TRAORI follows, in planes of CYCLE800, in
/// frames of the program; on machines of every build.
namespace probewright {
namespace {

using namespace testing_support;

constexpr const char* builds[] = {"mill5-table-table", "mill5-head-table", "mill5-head-head"};
constexpr double targets[] = {1, 10001, 9000, 1001, 11001, 2000, 12000};

/// How the system has turned; the parts lie where G54 and the turn put them.
struct Turned {
  std::string build;
  Pose pose;         ///< table from workpiece, as the control believes
  std::string turn;  ///< program text
  double c = 0;      ///< of G54, degrees

  /// Under TRAORI with the table turned to any angle, as often with a frame that is turned as well.
  static Turned traori(Planter& plant, int world) {
    Turned turned;
    turned.build = builds[world % 2];
    turned.c = world % 4 < 2 ? 0 : plant.number(-170, 170);
    turned.pose = translation(origin) * rotation(Vector3::UnitZ(), turned.c);
    turned.turn = fmt::format("SUPA G0 Z0 D0\nD1\nTRAORI\nG0 C{:.6f}\n", plant.number(-170, 170));
    return turned;
  }
  /// A plane of CYCLE800 in a system that is turned, too.
  static Turned swivelled(Planter& plant, int world) {
    Turned turned;
    turned.build = builds[world % 3];
    turned.c = plant.number(-60, 60);
    const Vector3 reference = plant.within(20);
    const double a = plant.number(-20, 20), b = plant.number(-20, 20);
    turned.pose = translation(origin) * rotation(Vector3::UnitZ(), turned.c) * translation(reference) *
                  rotation(Vector3::UnitX(), a) * rotation(Vector3::UnitY(), b);
    turned.turn =
        fmt::format("SUPA G0 Z0 D0\nD1\nCYCLE800(0,\"\",0,57,{:.12f},{:.12f},{:.12f},{:.12f},{:.12f},0,0,0,0,-1)\n",
                    reference.x(), reference.y(), reference.z(), a, b);
    return turned;
  }

  void plantIn(SinumerikBench& bench) const { plantFrame(bench, "$P_UIFR", 1, origin, {0, 0, c}); }
  std::string approach(const Vector3& start) const {
    return turn + fmt::format("G0 X{:.12f} Y{:.12f}\nG0 Z{:.12f}\n", start.x(), start.y(), start.z());
  }
};

void correctEachVariant(Turned (*turn)(Planter&, int), std::uint64_t seed, int rounds) {
  Planter plant(seed);
  int world = 0;
  for (int round = 0; round < rounds; ++round) {
    for (const Variant& variant : variants()) {
      const double target = targets[++world % 7];
      SCOPED_TRACE(fmt::format("{} into {} in world {}", variant.name, target, world));
      const Turned turned = turn(plant, world + round);
      const Pose part = displaced(variant, turned.pose, plant);
      simulation::Truth truth = perfectWorld(turned.build);
      variant.part(truth, part);
      SinumerikBench bench(truth);
      turned.plantIn(bench);
      bench.run(variant.cycle, with(variant.call, {{"S_KNUM", target}}), {}, turned.approach(variant.start));
      expectInPlace(bench, variant, part);
      EXPECT_EQ(bench.ovi(11), 1);
    }
  }
}

TEST(TurnedSystems, EachVariantUnderTraori) { correctEachVariant(Turned::traori, 401, 6); }
TEST(TurnedSystems, EachVariantInASwivelledPlane) { correctEachVariant(Turned::swivelled, 402, 6); }

TEST(TurnedSystems, WhatCycle976CalibratesThereMeasuresRightThere) {
  Planter plant(403);
  for (int world = 0; world < 48; ++world) {
    SCOPED_TRACE(world);
    const Turned turned = world % 2 == 0 ? Turned::traori(plant, world / 2) : Turned::swivelled(plant, world / 2);
    const int units = world / 2 % 4;  // length, both kinds of ring, ball
    simulation::Truth truth = perfectWorld(turned.build);
    simulation::TrueProbe& probe = truth.tools[0].probe;
    probe.tipOffset = {plant.number(-0.1, 0.1), plant.number(-0.1, 0.1)};
    probe.pretravel = plant.number(0, 0.02);
    probe.axialPretravel = plant.number(0, 0.01);
    const double radius = plant.number(18, 22), height = plant.number(-1, 1);
    if (units == 3) {
      place(truth, simulation::SolidSphere({0, 0, height - 15}, 15), turned.pose);
    } else {
      place(truth, simulation::Ring(20, 30, -40), turned.pose, "ring");
    }
    place(truth, simulation::Ring(radius, 35, -40), turned.pose * translation({72, 0, 0}));
    place(truth, simulation::Box({-110, -20, -40}, {-60, 20, height}), turned.pose);
    SinumerikBench bench(truth);
    turned.plantIn(bench);
    bench.set("$TC_DP3", {1, 1}, 100 + plant.number(-0.5, 0.5));
    const NamedNumbers common = {{"S_FA", 5}, {"S_TSA", 4}};
    if (units == 0) {
      bench.run("CYCLE976", with(common, {{"S_MVAR", 1001000}, {"S_SETV", height}, {"S_MA", 3}, {"S_MD", 1}}), {},
                turned.approach({-85, 0, 10}));
    } else if (units == 3) {
      bench.run("CYCLE976", with(common, {{"S_MVAR", 1000003}, {"S_SETV", 30}, {"S_SETV0", height}}), {},
                turned.approach({0, 0, 8}));
    } else {
      bench.run("CYCLE976", with(common, {{"S_MVAR", units}, {"S_SETV", 40}}), {}, turned.approach({0, 0, -10}));
    }
    if (units != 0) {
      bench.run("CYCLE977", with(common, {{"S_MVAR", 1}, {"S_SETV", 2 * radius}}), {}, turned.approach({72, 0, -10}));
      // Pretravel runs along the path, so that a chord beside the middle shows it to the second order.
      const double tolerance = units == 3 ? 2e-4 : 2e-5;
      EXPECT_NEAR(bench.ovr(4), 2 * radius, tolerance);
      EXPECT_NEAR(bench.ovr(5), 72, tolerance);
      EXPECT_NEAR(bench.ovr(6), 0, tolerance);
    }
    if (units == 0 || units == 3) {
      bench.run("CYCLE978", with(common, {{"S_SETV", height}, {"S_MA", 3}, {"S_MD", 2}}), {},
                turned.approach({-85, 0, 8}));
      EXPECT_NEAR(bench.ovr(4), height, units == 3 ? 1e-3 : 1e-7) << "the length";
    }
  }
}

/// How far the tool axis leans towards the axes of the workpiece system, degrees.
Vector2 leaning(const SinumerikBench& bench, const Vector3& tilt) {
  const control::Channel& channel = bench.control.channel;
  const machine::MachineDescription& description = channel.description();
  const machine::AxisPositions here = channel.axes();
  const double angle = tilt.norm();
  const Vector3 inSpindle = rotation(tilt / angle, angle).linear() * Vector3::UnitZ();
  const Vector3 inBase = baseFromSpindle(description, here).linear() * inSpindle;
  Matrix3 baseFromWorkpiece = channel.frame().linear();
  if (channel.following() == control::Following::Kinematics) {
    baseFromWorkpiece = baseFromTable(description, here).linear() *
                        baseFromTable(description, channel.reference()).linear().transpose() * baseFromWorkpiece;
  }
  const Vector3 axis = baseFromWorkpiece.transpose() * inBase;
  return {degreesFromRadians(std::atan2(axis.x(), axis.z())), degreesFromRadians(std::atan2(axis.y(), axis.z()))};
}

TEST(TurnedSystems, Cycle995TellsTheLeaningInTheWorkpieceSystem) {
  Planter plant(404);
  for (int world = 0; world < 24; ++world) {
    const Turned turned = world % 2 == 0 ? Turned::traori(plant, world / 2) : Turned::swivelled(plant, world / 2);
    const Vector3 tilt(plant.number(-0.08, 0.08), plant.number(-0.08, 0.08), 0);
    simulation::Truth truth = perfectWorld(turned.build);
    truth.errors.spindleTilt = tilt;
    truth.tools[0].length = 160;
    truth.tools[0].probe.stylusLength = 100;
    place(truth, simulation::SolidSphere(Vector3::Zero(), 12), turned.pose);
    SinumerikBench bench(truth);
    turned.plantIn(bench);
    bench.set("$TC_DP3", {1, 1}, 160);
    bench.run("CYCLE995",
              {{"S_MVAR", world % 4 < 2 ? 102015.0 : 1102015.0},
               {"S_SETV", 24},
               {"S_FA", 6},
               {"S_TSA", 4},
               {"S_STA1", plant.number(-180, 180)},
               {"S_DZ", 45},
               {"S_NMSP", 1 + world % 3}},
              {}, turned.approach({0, 0, 18}));
    const Vector2 leans = leaning(bench, tilt);
    // The leaning head misses the ball a little, which the shaft then touches at another height.
    EXPECT_NEAR(bench.ovr(2), leans.x(), 3e-4) << world;
    EXPECT_NEAR(bench.ovr(3), leans.y(), 3e-4) << world;
  }
}

TEST(TurnedSystems, ALeaningProbeMeasuresByTheCentreOfItsBall) {
  // Under TRAORI the tool leans against the 3rd axis. Where its length ends at the ball's centre (bit 1 of MD 51740
  // off), trigger points hold for it as it stands.
  Planter plant(405);
  for (int world = 0; world < 36; ++world) {
    const char* build = builds[world % 3];
    const char* leans = world % 3 == 1 ? "B" : "A";
    const int axis = world / 3 % 3;
    const Vector3 error = plant.within(1);
    simulation::Truth truth = perfectWorld(build);
    truth.tools[0].probe.stylusRadius = 0.5;
    place(truth, simulation::Box({0, 0, -60}, {100, 80, 0}), translation(origin + error));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.set("$TC_DP3", {1, 1}, 98);
    bench.set("$MNS_MEA_FUNCTION_MASK", {}, 9);
    bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}, -2);
    Vector3 start(40, 40, -1.5);
    start[axis] = axis == 2 ? 12 : -12;
    bench.run("CYCLE978",
              {{"S_MVAR", 100},
               {"S_KNUM", targets[world % 7]},
               {"S_FA", 7},
               {"S_TSA", 3},
               {"S_MA", axis + 1},
               {"S_MD", axis == 2 ? 2 : 1}},
              {},
              fmt::format("SUPA G0 Z0 D0\nD1\nTRAORI\nG0 {}{:.6f} C{:.6f}\nG0 X{:.12f} Y{:.12f}\nG0 Z{:.12f}\n", leans,
                          plant.number(-14, 14), plant.number(-170, 170), start.x(), start.y(), start.z()));
    EXPECT_NEAR(bench.ovr(4), error[axis], 1e-6) << world;
    EXPECT_NEAR(inWorkpiece(bench, origin + error)[axis], 0, 1e-6) << world;
  }
}

}  // namespace
}  // namespace probewright
