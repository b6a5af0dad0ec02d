#include "support/lathe_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

/// A bar in the chuck, its face at Z `face` of the machine, its axis beside the turning axis.
void chuckBar(setup::Setup& setup, double radius, double face, const Vector2& axis = Vector2::Zero()) {
  place(setup.world.truth, simulation::RoundBar(radius, -face, 0), translation({axis.x(), axis.y(), face}));
}

/// A bush in the chuck, bored right through.
void chuckBush(setup::Setup& setup, double bore, double face, const Vector2& axis = Vector2::Zero()) {
  place(setup.world.truth, simulation::Ring(bore, bore + 15, -face), translation({axis.x(), axis.y(), face}));
}

/// A probe with lengths and trigger points of its own.
LatheProbe somePeculiarProbe(Planter& plant, int position) {
  LatheProbe probe;
  probe.position = position;
  probe.length = plant.number(80, 140);
  probe.ballRadius = plant.number(1, 3);
  probe.mount = position == 8 ? Vector3(plant.number(-5, 5), 0, plant.number(-40, 40))
                              : Vector3(plant.number(-60, -40), 0, plant.number(-5, 5));
  probe.pretravel = plant.number(0, 0.02);
  probe.axialPretravel = plant.number(0, 0.02);
  return probe;
}

TEST(Cycle974, FindsTheFrontEdgeAndMovesTheZeroOffsetOntoIt) {
  Planter plant(9741);
  for (int world = 0; world < 120; ++world) {
    const int position = world % 2 == 0 ? 7 : 8;
    setup::Setup setup = latheSetup(somePeculiarProbe(plant, position));
    const double face = plant.number(100, 200), error = plant.number(-1.5, 1.5), set = plant.number(-2, 2);
    chuckBar(setup, 30, face);
    LatheBench bench(setup);
    const double base = plant.number(-20, 20);
    plantFrame(bench, "$P_CHBFR", 0, 0, base);
    plantFrame(bench, "$P_UIFR", 1, 0, face - base - error);
    const int knum[] = {1, 10001, 9000, 1001, 11001, 19000, 2000, 3001};
    bench.run(fmt::format("DIAMON\nG0 X40\nG0 Z20\nCYCLE974(100,{},,1,{:.12f},1,4,4,,{},\"\",,0,0,0,0,0,1,0,,2,0)",
                          knum[world % 8], set, 1 + world % 3));
    EXPECT_NEAR(bench.ovr(0), set, 1e-9);
    EXPECT_NEAR(bench.ovr(1), set, 1e-9);
    EXPECT_NEAR(bench.ovr(4), error, 1e-8) << "world " << world;
    EXPECT_NEAR(bench.ovr(5), error, 1e-8);
    EXPECT_NEAR(bench.ovr(16), error - set, 1e-8);
    EXPECT_NEAR(bench.ovr(17), error - set, 1e-8);
    EXPECT_EQ(bench.ovi(2), 974);
    EXPECT_EQ(bench.ovi(5), 1);
    EXPECT_EQ(bench.ovi(11), 1);
    const Vector3 onFace = bench.control.machineFromWorkpiece().inverse() * Vector3(20, 0, face);
    EXPECT_NEAR(onFace.z(), set, 1e-8);
    EXPECT_NEAR(onFace.x(), 20, 1e-9) << "X was not measured";
    // The probe ends the measuring path in front of the set position.
    const double radius = setup.world.truth.tools[0].probe.ballRadius;
    const double q =
        position == 7 ? setup.world.truth.tools[0].probe.axialPretravel : setup.world.truth.tools[0].probe.pretravel;
    const double end = bench.control.channel.machineFromAxes(bench.machine.position()).z();
    EXPECT_NEAR(end, face - error + set + 4 + radius - q, 1e-6);
  }
}

TEST(Cycle974, MeasuresDiametersAtOnePoint) {
  Planter plant(9742);
  for (int world = 0; world < 200; ++world) {
    const bool inside = world % 2 == 0, diameters = world % 3 != 0, correct = world % 5 == 0;
    setup::Setup setup = latheSetup(somePeculiarProbe(plant, inside ? 7 : 8));
    const double face = plant.number(100, 200), radius = plant.number(30, 45), error = plant.number(-0.8, 0.8);
    if (inside) chuckBush(setup, radius, face);
    if (!inside) chuckBar(setup, radius, face);
    LatheBench bench(setup);
    const double shift = correct ? plant.number(-0.3, 0.3) : 0;
    plantFrame(bench, "$P_UIFR", 1, shift, face);
    const double count = diameters ? 2 : 1;
    const double set = count * (radius - error);
    const std::string way = inside ? fmt::format("G0 Z20\nG0 X{:.6f}\nG0 Z-10", count * 20)
                                   : fmt::format("G0 X{:.6f}\nG0 Z-10", count * 55);
    bench.run(fmt::format("{}\n{}\nCYCLE974({},1,,1,{:.12f},2,4,4,,1,\"\",,0,0,0,0,0,1,0,,2,0)",
                          diameters ? "DIAMON" : "DIAMOF", way, (correct ? 100 : 0) + (inside ? 1 : 2), set));
    const double actual = count * (radius - shift);
    EXPECT_NEAR(bench.ovr(0), set, 1e-9);
    EXPECT_NEAR(bench.ovr(2), set, 1e-9);
    EXPECT_NEAR(bench.ovr(4), actual, 1e-8) << "world " << world;
    EXPECT_NEAR(bench.ovr(6), actual, 1e-8);
    EXPECT_NEAR(bench.ovr(16), actual - set, 1e-8);
    EXPECT_NEAR(bench.ovr(18), actual - set, 1e-8);
    // The zero offset shifts by the radius, fine.
    EXPECT_NEAR(bench.data("$P_UIFR", {1, "X", "FI"}), correct ? (actual - set) / count : 0, 1e-8);
    EXPECT_EQ(bench.data("$P_UIFR", {1, "Z", "FI"}), 0);
  }
}

TEST(Cycle974, ReversalIsFreeOfTheEccentricityOfTheClamping) {
  Planter plant(9743);
  for (int world = 0; world < 120; ++world) {
    const bool inside = world % 2 == 0;
    LatheProbe probe = somePeculiarProbe(plant, 7);
    setup::Setup setup = latheSetup(probe);
    const double face = 150, radius = plant.number(30, 45), alpha = plant.number(0, 360);
    const Vector2 axis(plant.number(-0.5, 0.5), plant.number(-0.5, 0.5));
    if (inside) chuckBush(setup, radius, face, axis);
    if (!inside) chuckBar(setup, radius, face, axis);
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, face);
    bench.run(fmt::format("DIAMON\n{}\nCYCLE974({},,,1,{:.12f},2,4,4,{:.12f},1,\"\",,0,0,0,0,0,1,0,,2,0)",
                          inside ? "G0 Z20\nG0 X30\nG0 Z-10" : "G0 X120\nG0 Z-10", inside ? 10001 : 10002, 2 * radius,
                          alpha));
    // A positive C turns the workpiece the other way round.
    const Vector2 turned = Eigen::Rotation2Dd(-radiansFromDegrees(alpha)) * axis;
    const double ball = inside ? -probe.ballRadius : probe.ballRadius;
    const double chord = std::sqrt((radius + ball) * (radius + ball) - turned.y() * turned.y()) - ball;
    EXPECT_NEAR(bench.ovr(4), 2 * chord, 1e-8) << "world " << world;
    EXPECT_NEAR(std::remainder(bench.control.channel.spindleAngle() - alpha - 180, 360), 0, 1e-9);
  }
}

TEST(Cycle974, CorrectsTheTurningToolThatMadeThePart) {
  Planter plant(9744);
  for (int world = 0; world < 160; ++world) {
    const int units = world % 3;  // face, inside, outside
    const bool diameters = world % 2 == 0;
    setup::Setup setup = latheSetup(somePeculiarProbe(plant, units == 2 ? 8 : 7));
    const double face = 150, radius = plant.number(30, 45);
    if (units == 1) chuckBush(setup, radius, face);
    if (units != 1) chuckBar(setup, radius, face);
    LatheBench bench(setup);
    // The tool cut beside its target by what its length is wrong.
    const double wrong = plant.number(0.05, 0.3) * (world % 4 < 2 ? 1 : -1);
    const double zero = plant.number(-3, 3);
    plantFrame(bench, "$P_UIFR", 1, 0, face - zero);
    const double count = diameters ? 2 : 1;
    const double set = units == 0 ? zero - wrong : count * (radius - wrong);
    const int digits[] = {0, 4, 1, 2, 3};
    const int memory = digits[world % 5];
    const int component = world % 7 < 3 ? 0 : units == 0 ? 2 : 1;
    const bool inverted = world % 11 == 0;
    const int code = 1 + 10000 * inverted + 100000 * component + 1000000 * memory;
    const std::string length = units == 0 ? "4" : "3";
    const double sum = 0.01;
    bench.set("$TC_SCP1" + length, {2, 1}, memory == 2 ? sum : 0);
    const std::string ways[] = {"G0 X20\nG0 Z20", "G0 Z20\nG0 X20\nG0 Z-10", "G0 X160\nG0 Z-10"};
    bench.run(fmt::format("{}\n{}\nCYCLE974({},,{},1,{:.12f},{},4,4,,1,\"FINISH\",1,0.001,1,0,0,1,1,0,,2,0)",
                          diameters ? "DIAMON" : "DIAMOF", ways[units], 200 + units, code, set, units == 0 ? 1 : 2));
    const double correction = inverted ? wrong : -wrong;
    const std::string names[] = {"$TC_DP1" + std::string(units == 0 ? "3" : "2"), "$TC_SCP1" + length,
                                 "$TC_ECP1" + length, "$TC_ECP1" + length, "$TC_DP" + length};
    const double before = memory == 4 ? (units == 0 ? 40 : 80) : memory == 2 ? sum : 0;
    EXPECT_NEAR(bench.data(names[memory], {2, 1}), before + correction, 1e-8) << "world " << world;
    if (memory == 2) {
      EXPECT_EQ(bench.data("$TC_SCP1" + length, {2, 1}), 0);
    }
    EXPECT_NEAR(bench.ovr(20), correction, 1e-8);
    EXPECT_NEAR(bench.ovr(16), units == 0 ? wrong : count * wrong, 1e-8);
    EXPECT_EQ(bench.ovi(0), 1);
    EXPECT_EQ(bench.ovi(8), 2);
    EXPECT_EQ(bench.ovi(13), memory == 0 || memory == 4 ? 0 : 1);
  }
}

TEST(Cycle974, TakesEmpiricalValueMeanAndToleranceOnTheDiameter) {
  setup::Setup setup = latheSetup({});
  chuckBar(setup, 20.03, 150);
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, 150);
  bench.set("$SCS_MEA_EMPIRIC_VALUE", {2}, 0.01);
  bench.set("$SCS_MEA_AVERAGE_VALUE", {4}, 0.02);
  const auto call = [](const char* limits) {
    return fmt::format("DIAMON\nG0 X120\nG0 Z-10\nCYCLE974(202,,1,1,40,2,4,1,,1,\"FINISH\",,{},,2,1)", limits);
  };
  // Diameter 40.06 less 0.01: difference 0.05; mean 0.02 - (0.02 - 0.05) / 3 = 0.03, below the zero offset range.
  bench.run(call("0.04,0.5,0.1,-0.1,0.07,3,50003"));
  EXPECT_NEAR(bench.ovr(16), 0.05, 1e-9);
  EXPECT_NEAR(bench.ovr(30), 0.01, 1e-12);
  EXPECT_NEAR(bench.ovr(31), 0.03, 1e-9);
  EXPECT_NEAR(bench.data("$SCS_MEA_AVERAGE_VALUE", {4}), 0.03, 1e-9);
  EXPECT_EQ(bench.data("$TC_DP12", {2, 1}), 0);
  // Once more: 0.03 + 0.02 / 3 = 0.0367; and with a smaller range the mean corrects, half of it as a length.
  bench.run(call("0.035,0.5,0.1,-0.1,0.07,3,50003"));
  EXPECT_NEAR(bench.data("$TC_DP12", {2, 1}), -(0.03 + 0.02 / 3) / 2, 1e-9);
  EXPECT_EQ(bench.data("$SCS_MEA_AVERAGE_VALUE", {4}), 0);
  EXPECT_EQ(bench.messages(), "");
  // The set value lies in the middle of the tolerance: 40.02 +- 0.02. Oversize corrects at once and whole.
  bench.set("$TC_DP12", {2, 1}, 0);
  bench.run(call("0.01,0.5,0.04,0,0.5,3,50000"));
  EXPECT_NEAR(bench.ovr(0), 40.02, 1e-9);
  EXPECT_NEAR(bench.ovr(8), 0.02, 1e-9);
  EXPECT_NEAR(bench.ovr(12), -0.02, 1e-9);
  EXPECT_NEAR(bench.data("$TC_DP12", {2, 1}), -0.02, 1e-9);
  EXPECT_EQ(bench.messages(), "61304 ");
  bench.run(call("0.01,0.03,0.04,0,0.5,3,0"));
  EXPECT_EQ(bench.messages(), "61304 61306 ");
  EXPECT_NEAR(bench.data("$TC_DP12", {2, 1}), -0.02, 1e-9) << "a worn tool is not corrected";
}

TEST(Cycle974, AThirdAxisIsMeasuredForX) {
  Planter plant(9745);
  for (int world = 0; world < 100; ++world) {
    LatheProbe probe;
    probe.position = 7;
    probe.length = plant.number(90, 110);
    probe.mount = {plant.number(-60, -40), 0, 0};
    setup::Setup setup = latheSetup(probe, "mill3");
    const double radius = plant.number(20, 30), error = plant.number(-0.5, 0.5);
    place(setup.world.truth, simulation::RoundBar(radius, -80, 0), translation({50, 0, -350}));
    LatheBench bench(setup);
    // What a mill's beliefs are not: a probe of a lathe with lengths across and along.
    bench.set("$TC_DP1", {1, 1}, 580);
    bench.set("$TC_DP2", {1, 1}, 7);
    bench.set("$TC_DP3", {1, 1}, -probe.mount.x());
    bench.set("$TC_DP4", {1, 1}, probe.length - probe.ballRadius);
    for (const char* way : {"MINUS", "PLUS"})
      bench.set(fmt::format("$SNS_MEA_WP_TRIG_{}_DIR_AX3", way), {0}, way[0] == 'M' ? -2 : 2);
    bench.set("$MCS_MEA_FUNCTION_MASK", {}, 2);
    plantFrame(bench, "$P_UIFR", 1, 50, -350);
    const std::string way = "DIAMON\nG0 X0 Y60\nG0 Z-10\n";
    bench.run(fmt::format("{}CYCLE974(102,1,,1,{:.12f},3,4,4,,1,\"\",,0,0,0,0,0,1,0,,2,0)", way, 2 * (radius - error)));
    EXPECT_NEAR(bench.ovr(7), 2 * radius, 1e-8);
    EXPECT_NEAR(bench.ovr(19), 2 * error, 1e-8);
    EXPECT_NEAR(bench.data("$P_UIFR", {1, "X", "FI"}), error, 1e-8);
    EXPECT_EQ(bench.data("$P_UIFR", {1, "Y", "FI"}), 0);
    bench.set("$P_UIFR", {1, "X", "FI"}, 0);
    bench.run(fmt::format("{}CYCLE974(202,,1,1,{:.12f},3,4,4,,1,\"FINISH\",,0,0,0,0,0,1,0,,2,0)", "G0 Z100\n" + way,
                          2 * (radius - error)));
    EXPECT_NEAR(bench.data("$TC_DP12", {2, 1}), -error, 1e-8);
    EXPECT_EQ(bench.data("$TC_DP14", {2, 1}), 0);
    bench.set("$MCS_MEA_FUNCTION_MASK", {}, 0);
    EXPECT_EQ(bench.alarmOf("G0 Z100\n" + way + "CYCLE974(2,,,1,50,3,4,4,,1,\"\",,0,0,0,0,0,1,0,,2,0)"), "61336");
  }
}

TEST(Cycle974, RefusesWhatItCannotDo) {
  setup::Setup setup = latheSetup({});
  chuckBar(setup, 20, 150);
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, 150);
  const auto call = [](const std::string& arguments, const std::string& before = {}) {
    return "DIAMON\nG0 X120\nG0 Z-10\n" + before + "\nCYCLE974(" + arguments + ")";
  };
  const std::string rest = ",\"FINISH\",,0,1,0,0,0,1,0,,2,0";
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,4,1,,1" + rest)), "");
  EXPECT_EQ(bench.alarmOf(call("3,,,1,40,2,4,1,,1" + rest)), "61307") << "no such feature";
  EXPECT_EQ(bench.alarmOf(call("302,,,1,40,2,4,1,,1" + rest)), "61307") << "no such task";
  EXPECT_EQ(bench.alarmOf(call("20002,,,1,40,2,4,1,,1" + rest)), "61307") << "no such way of positioning";
  EXPECT_EQ(bench.alarmOf(call("10000,,,1,0,1,4,1,,1" + rest)), "61307") << "a face with reversal";
  EXPECT_EQ(bench.alarmOf(call("10102,1,,1,40,2,4,1,,1" + rest)), "61307") << "a zero offset with reversal";
  EXPECT_EQ(bench.alarmOf(call("2,,,13,40,2,4,1,,1" + rest)), "61313");
  EXPECT_EQ(bench.alarmOf(call("2,,,2,40,2,4,1,,1" + rest)), "61341") << "a data set without calibration";
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,4,4,1,,1" + rest)), "61325");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,3,4,1,,1" + rest)), "61336") << "there is no Y";
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,0,1,,1" + rest)), "61308");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,42.5,2,4,1,,1" + rest)), "61303") << "the difference is 2.5";
  EXPECT_EQ(bench.alarmOf(call("2,,,1,50,2,4,1,,1" + rest)), "61301") << "nothing there";
  EXPECT_EQ(bench.alarmOf(call("2,,,1,130,2,4,1,,1" + rest)), "61332") << "already past the set diameter";
  EXPECT_EQ(bench.alarmOf(call("1,,,1,40,2,4,1,,1" + rest)), "61332") << "outside, but asked for a bore";
  EXPECT_EQ(bench.alarmOf(call("102,100,,1,40,2,4,1,,1" + rest)), "61321");
  EXPECT_EQ(bench.alarmOf(call("102,4001,,1,40,2,4,1,,1" + rest)), "61322");
  EXPECT_EQ(bench.alarmOf(call("102,20001,,1,40,2,4,1,,1" + rest)), "61323");
  EXPECT_EQ(bench.alarmOf(call("102,100001,,1,40,2,4,1,,1" + rest)), "61324");
  EXPECT_EQ(bench.alarmOf(call("202,,2,1,40,2,4,1,,1" + rest)), "61328") << "D2 does not exist";
  EXPECT_EQ(bench.alarmOf(call("202,,1,1,40,2,4,1,,1,\"NOBODY\",,0,1,0,0,0,1,0,,2,0")), "61343");
  EXPECT_EQ(bench.alarmOf(call("202,,1000001,1,40,2,4,1,,1" + rest)), "61319") << "additive offset without DL";
  EXPECT_EQ(bench.alarmOf(call("202,,1,1,40,2,4,1,,1,\"FINISH\",,0,1,0,0,0,0,10000,,2,0")), "61318");
  EXPECT_EQ(bench.alarmOf(call("202,,1,1,40,2,4,1,,1,\"FINISH\",,0,1,0,0,0,1,21,,2,0")), "61319");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,4,1,,1" + rest, "D0")), "61311");
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,4,1,,1" + rest, "SCALE X2")), "61310");
  bench.run("SCALE");
  bench.set("$TC_DP2", {1, 1}, 3);
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,4,1,,1" + rest)), "61315");
  bench.set("$TC_DP2", {1, 1}, 8);
  bench.set("$TC_DP1", {1, 1}, 710);
  bench.set("$SC_TOOL_LENGTH_TYPE", {}, 2);
  EXPECT_EQ(bench.alarmOf(call("2,,,1,40,2,4,1,,1" + rest)), "61309");
}

TEST(Lathe, NamesTheAxisThatATurnedFrameAsksFor) {
  // The lathe has X and Z. A frame turned about Z asks for Y as well.
  setup::Setup setup = latheSetup({});
  place(setup.world.truth, simulation::RoundBar(40, -100, 0), translation({0, 0, 200}));
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, 200);
  const std::string beside = "ROT\nDIAMOF\nG0 X60\nG0 Z-10\n";
  EXPECT_EQ(bench.alarmOf(beside + "ROT Z30\nG0 X55\nCYCLE978(0,,,1,40,6,4,2,2,1)\n"), "18310") << "in the program";
  EXPECT_EQ(bench.alarmOf(beside + "ROT Z30\nCYCLE978(0,,,1,40,6,4,2,2,1)\n"), "61336") << "in the cycle";
  EXPECT_EQ(bench.alarmOf(beside + "CYCLE978(0,,,1,40,6,4,2,2,1)\n"), "");
  EXPECT_NEAR(bench.ovr(4), 40, 1e-7);
}

}  // namespace
}  // namespace probewright
