#include "support/lathe_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

constexpr double face = 200;

/// A probe that reaches along -Z, under the turning centre.
LatheProbe longProbe(Planter& plant) {
  LatheProbe probe;
  probe.position = 7;
  probe.length = plant.number(90, 140);
  probe.ballRadius = plant.number(1, 3);
  probe.mount = {plant.number(-90, -70), 0, plant.number(-5, 5)};
  probe.pretravel = plant.number(0, 0.02);
  probe.axialPretravel = plant.number(0, 0.02);
  return probe;
}

TEST(Cycle994, MeasuresOutsideByTwoPointsRoundTheFace) {
  Planter plant(9941);
  for (int world = 0; world < 150; ++world) {
    const LatheProbe probe = longProbe(plant);
    setup::Setup setup = latheSetup(probe);
    const double radius = plant.number(15, 25), error = plant.number(-0.5, 0.5), zero = plant.number(-0.4, 0.4);
    const Vector2 axis(plant.number(-0.3, 0.3), plant.number(-0.3, 0.3));
    place(setup.world.truth, simulation::RoundBar(radius, -100, 0), translation({axis.x(), axis.y(), face}));
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, zero, face);
    const bool diameters = world % 3 != 0, zone = world % 2 == 0;
    const double count = diameters ? 2 : 1, depth = plant.number(3, 12);
    // The way round given by S_MA, by S_MVAR, or left to the standard.
    const int mvar = 2 + (zone ? 1000 : 0), ma = world % 4 < 2 ? 102 : 2;
    bench.run(
        fmt::format("{}\nG0 X{:.6f}\nG0 Z{:.6f}\nCYCLE994({},,,1,{:.12f},{},{:.6f},{:.6f},3,3,{},\"\",,0,0,0,0,0,1,"
                    "0,,2,0)",
                    diameters ? "DIAMON" : "DIAMOF", count * 40, -depth, mvar, count * (radius - error), ma, count * 34,
                    depth + 5, 1 + world % 2));
    const double ball = probe.ballRadius;
    const double chord = std::sqrt((radius + ball) * (radius + ball) - axis.y() * axis.y()) - ball;
    EXPECT_NEAR(bench.ovr(4), count * chord, 1e-8) << "world " << world;
    EXPECT_NEAR(bench.ovr(6), count * chord, 1e-8);
    EXPECT_NEAR(bench.ovr(0), count * (radius - error), 1e-9);
    EXPECT_NEAR(bench.ovr(16), count * (chord - radius + error), 1e-8);
    EXPECT_EQ(bench.ovi(2), 994);
    EXPECT_EQ(bench.ovi(3), mvar);
    // It ends below the centre at the height where it began, the measuring path away from the set diameter.
    const Vector3 end = bench.control.channel.machineFromAxes(bench.machine.position()).vector();
    EXPECT_NEAR(end.x(), zero - (radius - error) - 3 - (ball - probe.pretravel), 1e-6);
    EXPECT_NEAR(end.z(), face - depth, 1e-6);
  }
}

TEST(Cycle994, MeasuresInsideStraightThroughOrRoundACore) {
  Planter plant(9942);
  for (int world = 0; world < 150; ++world) {
    const LatheProbe probe = longProbe(plant);
    setup::Setup setup = latheSetup(probe);
    const double radius = plant.number(30, 36), error = plant.number(-0.5, 0.5);
    const Vector2 axis(plant.number(-0.3, 0.3), plant.number(-0.3, 0.3));
    place(setup.world.truth, simulation::Ring(radius, 50, -100), translation({axis.x(), axis.y(), face}));
    const bool core = world % 2 == 0;
    // The core ends a little in front of the face: straight through the centre the stylus would meet it.
    if (core) place(setup.world.truth, simulation::RoundBar(10, -100, 4), translation({0, 0, face}), "core");
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, face);
    const double ball = probe.ballRadius;
    bench.run(
        fmt::format("DIAMON\nG0 X46\nG0 Z20\nG0 Z-10\nCYCLE994({},,,1,{:.12f},{},{:.6f},20,{},3,1,\"\",,0,0,0,0,"
                    "0,1,0,,2,0)",
                    core ? 1001 : 1, 2 * (radius - error), world % 4 < 2 ? 2 : 102, 2 * (10.5 + ball), core ? 60 : 5));
    const double chord = std::sqrt((radius - ball) * (radius - ball) - axis.y() * axis.y()) + ball;
    EXPECT_NEAR(bench.ovr(4), 2 * chord, 1e-8) << "world " << world;
    EXPECT_NEAR(bench.ovr(18), 2 * (chord - radius + error), 1e-8);
  }
}

TEST(Cycle994, CorrectsTheTool) {
  Planter plant(9943);
  for (int world = 0; world < 100; ++world) {
    const LatheProbe probe = longProbe(plant);
    setup::Setup setup = latheSetup(probe);
    const bool inside = world % 2 == 0;
    const double radius = plant.number(25, 35), wrong = plant.number(-0.2, 0.2);
    if (inside) place(setup.world.truth, simulation::Ring(radius, 50, -100), translation({0, 0, face}));
    if (!inside) place(setup.world.truth, simulation::RoundBar(radius, -100, 0), translation({0, 0, face}));
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, face);
    const int code = world % 3 == 0 ? 1 : world % 3 == 1 ? 4100001 : 4110001;
    bench.run(fmt::format("DIAMON\n{}\nCYCLE994({},,{},1,{:.12f},2,0,30,4,3,1,\"2\",,0.0001,0,0,0,0,1,0,,2,0)",
                          inside ? "G0 X40\nG0 Z20\nG0 Z-10" : "G0 X90\nG0 Z-10", inside ? 201 : 202, code,
                          2 * (radius - wrong)));
    const double correction = std::abs(2 * wrong) <= 0.0001 ? 0 : world % 3 == 2 ? wrong : -wrong;
    EXPECT_NEAR(bench.data(world % 3 == 0 ? "$TC_DP12" : "$TC_DP3", {2, 1}), (world % 3 == 0 ? 0 : 80) + correction,
                1e-8)
        << "world " << world;
    EXPECT_NEAR(bench.ovr(20), correction, 1e-8);
  }
}

TEST(Cycle994, MeasuresOutsideWithoutCalibrationIfTheMachineAllows) {
  LatheProbe probe;
  probe.position = 7;
  probe.mount = {-80, 0, 0};
  setup::Setup setup = latheSetup(probe);
  place(setup.world.truth, simulation::RoundBar(20, -100, 0), translation({0, 0, face}));
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, face);
  const std::string program =
      "DIAMON\nG0 X90\nG0 Z10\nG0 Z-10\nCYCLE994(2,,,3,40.5,2,0,30,4,3,1,\"\",,0,0,0,0,0,1,0,,2,0)";
  EXPECT_EQ(bench.alarmOf(program), "61341");
  bench.set("$MCS_MEA_FUNCTION_MASK", {}, 4);
  bench.run(program);
  EXPECT_NEAR(bench.ovr(4), 40, 1e-9);
}

TEST(Cycle994, PassesByAndMeasuresInAThirdAxis) {
  // The way round and the axis of measuring on a machine with Y: 302 measures X and passes in Y, 203 the other way,
  // 103 measures Y and passes in Z.
  for (const int ma : {302, 203, 103, 102}) {
    LatheProbe probe;
    probe.position = 7;
    probe.mount = {-50, 0, 0};
    setup::Setup setup = latheSetup(probe, "mill3");
    place(setup.world.truth, simulation::RoundBar(18, -80, 0), translation({50, 0, -350}));
    LatheBench bench(setup);
    bench.set("$TC_DP1", {1, 1}, 580);
    bench.set("$TC_DP2", {1, 1}, 7);
    bench.set("$TC_DP3", {1, 1}, 50);
    bench.set("$TC_DP4", {1, 1}, 98);
    bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}, -2);
    bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX3", {0}, 2);
    plantFrame(bench, "$P_UIFR", 1, 50, -350);
    const std::string program =
        fmt::format("DIAMON\nG0 Z60\nG0 {}\nG0 Z-10\nCYCLE994(2,,,1,36.4,{},0,{},4,3,1,\"\",,0,0,0,0,0,1,0,,2,0)",
                    ma % 10 == 2 ? "X60 Y0" : "X0 Y60", ma, ma < 200 ? 20 : 40);
    if (ma != 102) {
      EXPECT_EQ(bench.alarmOf(program), "61336") << ma;
    }
    bench.set("$MCS_MEA_FUNCTION_MASK", {}, 2);
    bench.run(program);
    EXPECT_NEAR(bench.ovr(4), 36, 1e-9) << ma;
    EXPECT_NEAR(bench.ovr(ma % 10 == 2 ? 6 : 7), 36, 1e-9) << ma;
    EXPECT_NEAR(bench.ovr(16), -0.4, 1e-9);
  }
}

/// Outside, the zone leads the probe round: out to its edge above, across, and in from its edge below.
TEST(Cycle994, TheZoneMakesTheWayRoundWiderByItsMeasure) {
  Planter plant(9945);
  for (int world = 0; world < 40; ++world) {
    const LatheProbe probe = longProbe(plant);
    setup::Setup setup = latheSetup(probe);
    const double radius = plant.number(15, 20), zone = radius + plant.number(8, 14), way = plant.number(24, 30);
    place(setup.world.truth, simulation::RoundBar(radius, -100, 0), translation({0, 0, face}));
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, face);
    const auto travelled = [&](int mvar, double size) {
      const std::string start = "SUPA G0 Z500 D0\nDIAMON\nD1\nG0 X100\nG0 Z-20\n";
      bench.run(start);
      const double before = bench.control.channel.pathLength();
      bench.run(start + fmt::format("CYCLE994({},,,1,{:.12f},2,{:.12f},{:.12f},3,1)", mvar, 2 * radius, 2 * size, way));
      EXPECT_NEAR(bench.ovr(4), 2 * radius, 1e-8) << "world " << world;
      return bench.control.channel.pathLength() - before;
    };
    const double start = radius + 3 + probe.ballRadius - probe.pretravel;
    // Four times the way between start position and edge of the zone: out, half across and half across, in.
    EXPECT_NEAR(travelled(1002, zone) - travelled(2, zone), 4 * (zone - start), 1e-6) << "world " << world;
    EXPECT_NEAR(travelled(1002, radius) - travelled(2, 0), 0, 1e-6) << "a zone that the path keeps clear of anyway";
  }
}

/// 301: the probe across the bed measures along Z and passes by in Y; the axis of the way round by S_MVAR as well.
TEST(Cycle994, MeasuresAlongTheBedAndPassesByInAThirdAxis) {
  struct Call {
    int mvar, ma;
  };
  for (const Call call : {Call{2, 301}, Call{3002, 1}, Call{3002, 301}}) {
    Planter plant(9946);
    for (int world = 0; world < 20; ++world) {
      LatheProbe probe;
      probe.position = 8;
      probe.mount = {0, 0, -50};
      setup::Setup setup = latheSetup(probe, "mill3");
      const double half = plant.number(15, 20), shift = plant.number(-0.3, 0.3);
      place(setup.world.truth, simulation::Box({-30, -10, -half}, {20, 10, half}), translation({50, 0, -350 + shift}));
      LatheBench bench(setup);
      bench.set("$TC_DP1", {1, 1}, 580);
      bench.set("$TC_DP2", {1, 1}, 8);
      bench.set("$TC_DP3", {1, 1}, 98);
      bench.set("$TC_DP4", {1, 1}, 50);
      bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0}, -2);
      bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 2);
      bench.set("$MCS_MEA_FUNCTION_MASK", {}, 2);
      plantFrame(bench, "$P_UIFR", 1, 50, -350);
      bench.run(fmt::format("DIAMON\nG0 Z80\nG0 X0 Y0\nG0 Z40\nCYCLE994({},,,1,{:.12f},{},0,40,4,3)", call.mvar,
                            2 * (half - 0.2), call.ma));
      EXPECT_NEAR(bench.ovr(4), 2 * half, 1e-9) << call.mvar << " " << call.ma;
      EXPECT_NEAR(bench.ovr(5), 2 * half, 1e-9);
      EXPECT_NEAR(bench.ovr(17), 0.4, 1e-9);
      EXPECT_EQ(bench.ovr(6), 0) << "axis 2 was not measured";
    }
  }
}

TEST(Cycle994, RefusesWhatItCannotDo) {
  LatheProbe probe;
  probe.position = 7;
  probe.mount = {-80, 0, 0};
  setup::Setup setup = latheSetup(probe);
  place(setup.world.truth, simulation::RoundBar(20, -100, 0), translation({0, 0, face}));
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, face);
  const auto call = [](const std::string& arguments) {
    return "SUPA G0 Z500 D0\nDIAMON\nD1\nG0 X90\nG0 Z10\nG0 Z-10\nCYCLE994(" + arguments +
           ",1,\"FINISH\",,0,0,0,0,0,1,0,,2,0)";
  };
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,0,30,4,3")), "");
  EXPECT_EQ(bench.alarmOf(call("0,,,1,40,2,0,30,4,3")), "61307");
  EXPECT_EQ(bench.alarmOf(call("102,1,,1,40,2,0,30,4,3")), "61307") << "no zero offset from two points";
  EXPECT_EQ(bench.alarmOf(call("4002,,,1,40,2,0,30,4,3")), "61307");
  EXPECT_EQ(bench.alarmOf(call("2002,,,1,40,2,0,30,4,3")), "61325") << "passing by in the measuring axis";
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,202,0,30,4,3")), "61325");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,0,0,30,4,3")), "61325");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,302,0,30,4,3")), "61336") << "there is no Y";
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,0,0,4,3")), "61334") << "no way round";
  EXPECT_EQ(bench.alarmOf(call("1002,,,1,40,2,-1,30,4,3")), "61334");
  EXPECT_EQ(bench.alarmOf(call("1001,,,1,100,2,96.1,30,4,3")), "61334") << "no room for the ball";
  EXPECT_EQ(bench.alarmOf(call("2,,,1,0,2,0,30,4,3")), "61319");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,95,2,0,30,4,3")), "61332");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,0,30,0,3")), "61308");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,43.5,2,0,30,4,3")), "61303");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,50,2,0,30,4,3")), "61301");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,0,8,4,3")), "61302") << "the way round is too short: a collision";
}

}  // namespace
}  // namespace probewright
