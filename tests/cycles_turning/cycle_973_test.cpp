#include "support/lathe_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

double trigger(const LatheBench& bench, int axis, int sign, int set = 0) {
  return bench.data(fmt::format("$SNS_MEA_WP_TRIG_{}_DIR_AX{}", sign < 0 ? "MINUS" : "PLUS", axis), {set});
}

LatheProbe somePeculiarProbe(Planter& plant, int position) {
  LatheProbe probe;
  probe.position = position;
  probe.length = plant.number(80, 140);
  probe.ballRadius = plant.number(1, 3);
  probe.mount = position == 8 ? Vector3(plant.number(-5, 5), 0, plant.number(-40, 40))
                              : Vector3(plant.number(-90, -60), 0, plant.number(-5, 5));
  probe.pretravel = plant.number(0, 0.02);
  probe.axialPretravel = plant.number(0, 0.02);
  return probe;
}

/// How far the axes travel on from contact to signal along axis 1 (Z) or 2 (X).
double pretravelOf(const LatheProbe& probe, int axis) {
  const bool along = (axis == 1) == (probe.position == 7);
  return along ? probe.axialPretravel : probe.pretravel;
}

TEST(Cycle973, FindsTheTriggerPointOnASurface) {
  Planter plant(9731);
  for (int world = 0; world < 160; ++world) {
    const LatheProbe probe = somePeculiarProbe(plant, world % 2 == 0 ? 7 : 8);
    const int axis = 1 + world / 2 % 2;
    const bool radius = world % 4 < 2, diameters = world % 3 != 0;
    setup::Setup setup = latheSetup(probe);
    place(setup.world.truth, simulation::RoundBar(30, -100, 0), translation({0, 0, 200}));
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, 190);
    const std::string way = axis == 1 ? "G0 X20\nG0 Z20" : "G0 X160\nG0 Z2";
    const double surface = axis == 1 ? 10 : diameters ? 60 : 30;
    bench.run(fmt::format("{}\n{}\nCYCLE973({},2,,{},{},1,5,4,{},{},,2,0)", diameters ? "DIAMON" : "DIAMOF", way,
                          radius ? 1101 : 1100, surface, axis, world % 5 == 0 ? 0 : 250, 1 + world % 3));
    const double expected = -(probe.ballRadius - pretravelOf(probe, axis));
    EXPECT_NEAR(trigger(bench, axis, -1, 1), expected, 1e-8) << "world " << world;
    EXPECT_EQ(trigger(bench, axis, 1, 1), 0) << "the other direction was not calibrated";
    EXPECT_EQ(trigger(bench, 3 - axis, -1, 1), 0);
    EXPECT_NEAR(bench.ovr(4 + 4 * axis), expected, 1e-8);
    EXPECT_NEAR(bench.ovr(5 + 4 * axis), expected, 1e-8);
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {1}), radius ? -2 * expected : 0, 1e-8);
    EXPECT_NEAR(bench.ovr(4), radius ? -2 * expected : 0, 1e-8);
    // Bit 3 of SD 54740 hands the ball's radius on to the tool.
    EXPECT_NEAR(bench.data("$TC_DP6", {1, 1}), radius ? -expected : probe.ballRadius - probe.pretravel, 1e-8);
    EXPECT_EQ(bench.data("$SNS_MEA_WP_FEED", {1}), world % 5 == 0 ? 300 : 250);
    EXPECT_EQ(bench.ovi(2), 973);
    EXPECT_EQ(bench.ovi(5), 2);
    EXPECT_EQ(bench.ovr(28), 4);
  }
}

TEST(Cycle973, FindsTheLengthOfTheProbe) {
  Planter plant(9732);
  for (int world = 0; world < 120; ++world) {
    const LatheProbe probe = somePeculiarProbe(plant, world % 2 == 0 ? 7 : 8);
    const int axis = 1 + world / 2 % 2;
    setup::Setup setup = latheSetup(probe);
    place(setup.world.truth, simulation::RoundBar(30, -100, 0), translation({0, 0, 200}));
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, 200);
    const std::string length = axis == 1 ? "$TC_DP4" : "$TC_DP3";
    const double right = bench.data(length, {1, 1}), wrong = plant.number(-1, 1);
    const double other = bench.data(axis == 1 ? "$TC_DP3" : "$TC_DP4", {1, 1});
    bench.set(length, {1, 1}, right + wrong);
    const std::string way = axis == 1 ? "G0 X20\nG0 Z20" : "G0 X160\nG0 Z-8";
    bench.run(fmt::format("DIAMON\n{}\nCYCLE973(1001100,1,,{},{},1,5,4,300,1,,2,0)", way, axis == 1 ? 0 : 60, axis));
    // The ball's centre then stands, by the tool data, the believed ball radius in front of the surface at the signal.
    const double ball = probe.ballRadius - probe.pretravel;
    const double gap = probe.ballRadius - pretravelOf(probe, axis);
    EXPECT_NEAR(bench.data(length, {1, 1}), right + gap - ball, 1e-8) << "world " << world;
    EXPECT_EQ(bench.data(axis == 1 ? "$TC_DP3" : "$TC_DP4", {1, 1}), other);
    EXPECT_NEAR(trigger(bench, axis, -1), -ball, 1e-9);
    // What is measured with it is right.
    bench.run(fmt::format("DIAMON\n{}\nCYCLE974({},,,1,{},{},4,4,,1,\"\",,0,0,0,0,0,1,0,,2,0)",
                          axis == 1 ? "G0 X20\nG0 Z20" : "G0 X160\nG0 Z-8", axis == 1 ? 0 : 2, axis == 1 ? 0.5 : 60.5,
                          axis));
    EXPECT_NEAR(bench.ovr(4), axis == 1 ? 0 : 60, 1e-8);
  }
}

/// The reference groove of a machine: where its faces truly are.
struct Groove {
  int position = 8;  ///< of the probe that reaches into it
  double base = 150, upper = 162, minus = 280, plus = 300;
};

Groove someGroove(Planter& plant, int position) {
  Groove groove;
  groove.position = position;
  groove.base = position == 8 ? plant.number(80, 120) : plant.number(250, 350);
  groove.upper = groove.base + plant.number(10, 16);
  groove.minus = position == 8 ? plant.number(250, 350) : plant.number(100, 150);
  groove.plus = groove.minus + plant.number(16, 24);
  return groove;
}

/// Puts the groove on the machine as three boxes, open to +X or to +Z.
void placeGroove(setup::Setup& setup, const Groove& groove) {
  const auto box = [&](double fromBase, double toBase, double fromWall, double toWall) {
    const bool acrossZ = groove.position == 8;
    place(setup.world.truth, acrossZ ? simulation::Box({fromBase, -20, fromWall}, {toBase, 20, toWall})
                                     : simulation::Box({fromWall, -20, fromBase}, {toWall, 20, toBase}));
  };
  box(groove.base - 10, groove.base, groove.minus - 10, groove.plus + 10);
  box(groove.base, groove.upper, groove.minus - 10, groove.minus);
  box(groove.base, groove.upper, groove.plus, groove.plus + 10);
}

/// Enters the groove as number `number`, its walls displaced by `shift`.
void enterGroove(LatheBench& bench, const Groove& groove, int number, double shift = 0) {
  const bool acrossZ = groove.position == 8;
  const auto edge = [&](const char* what, int axis, double value) {
    bench.set(fmt::format("$SNS_MEA_CAL_EDGE_{}_AX{}", what, axis), {number - 1}, value);
  };
  edge("BASE", acrossZ ? 2 : 1, groove.base);
  if (acrossZ) edge("UPPER", 2, groove.upper);
  edge("PLUS_DIR", acrossZ ? 1 : 2, groove.plus + shift);
  edge("MINUS_DIR", acrossZ ? 1 : 2, groove.minus + shift);
}

/// To a place outside the groove's mouth, beside its middle, in a workpiece system that has nothing to do with it.
std::string wayTo(const Groove& groove, double zero) {
  const double middle = (groove.plus + groove.minus) / 2 + 2;
  const double x = groove.position == 8 ? groove.upper + 20 : middle;
  const double z = groove.position == 8 ? middle : groove.upper + 20;
  return fmt::format("DIAMON\nG0 X{:.9f} Z{:.9f}\n", 2 * x, z - zero);
}

TEST(Cycle973, RepeatsFromOutsideTheGroove) {
  for (const int position : {7, 8}) {
    Planter plant(97340 + position);
    const Groove groove = someGroove(plant, position);
    setup::Setup setup = latheSetup(somePeculiarProbe(plant, position));
    placeGroove(setup, groove);
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, 60);
    enterGroove(bench, groove, 1);
    bench.set("$SNS_MEA_FUNCTION_MASK", {}, 1);
    // A data set of zeros, and a safe area smaller than the ball's radius.
    const std::string axis = position == 8 ? "1" : "2";
    EXPECT_EQ(bench.alarmOf(wayTo(groove, 60) + "CYCLE973(2103,6,1,," + axis + ",,3,0.5,,1,,2,0)"), "61303");
    std::size_t repetitions = 0;
    for (const auto& event : bench.control.journal.events)
      repetitions += event.text.find("repeated") != std::string::npos;
    EXPECT_EQ(repetitions, 4U);
  }
}

TEST(Cycle973, CalibratesInTheGrooveInBothDirections) {
  Planter plant(9733);
  for (int world = 0; world < 120; ++world) {
    const int position = 7 + world % 2;
    const LatheProbe probe = somePeculiarProbe(plant, position);
    const Groove groove = someGroove(plant, position);
    setup::Setup setup = latheSetup(probe);
    placeGroove(setup, groove);
    LatheBench bench(setup);
    const double zero = plant.number(50, 80);
    plantFrame(bench, "$P_UIFR", 1, 0, zero);
    const int number = 1 + world % 3;
    // Without positional deviation the walls' place may be rough, the width is right.
    const bool deviation = world % 4 < 2;
    enterGroove(bench, groove, number, deviation ? 0 : plant.number(-0.5, 0.5));
    // The tool data are wrong across the stylus: to the cycle that is the ball's deviation.
    const double wrong = plant.number(-0.3, 0.3);
    const int axis = position == 8 ? 1 : 2;
    const std::string length = axis == 1 ? "$TC_DP4" : "$TC_DP3";
    bench.set(length, {1, 1}, bench.data(length, {1, 1}) + wrong);
    bench.run(wayTo(groove, zero) +
              fmt::format("CYCLE973({},4,{},,{},,3,4,300,1,,2,0)", deviation ? 2103 : 12103, number, axis));
    const double radius = probe.ballRadius - probe.pretravel, skew = deviation ? wrong : 0;
    EXPECT_NEAR(trigger(bench, axis, 1, 3), radius + skew, 1e-8) << "world " << world;
    EXPECT_NEAR(trigger(bench, axis, -1, 3), -radius + skew, 1e-8);
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {3}), 2 * radius, 1e-8);
    EXPECT_NEAR(bench.data(fmt::format("$SNS_MEA_WP_POS_DEV_AX{}", axis), {3}), skew, 1e-8);
    EXPECT_NEAR(bench.data("$TC_DP6", {1, 1}), radius, 1e-8);
    EXPECT_NEAR(bench.ovr(4), 2 * radius, 1e-8);
    EXPECT_NEAR(bench.ovr(5), 2 * radius, 1e-8);
    EXPECT_NEAR(bench.ovr(4 + 4 * axis), -radius + skew, 1e-8);
    EXPECT_NEAR(bench.ovr(6 + 4 * axis), radius + skew, 1e-8);
    EXPECT_NEAR(bench.ovr(19 + axis), skew, 1e-8);
    // The workpiece system is in effect again.
    EXPECT_NEAR((bench.control.machineFromWorkpiece() * Vector3::Zero()).z(), zero, 1e-9);
  }
}

TEST(Cycle973, CalibratesOneWallOrTheBaseOfTheGroove) {
  Planter plant(9734);
  for (int world = 0; world < 120; ++world) {
    const int position = 7 + world % 2;
    const LatheProbe probe = somePeculiarProbe(plant, position);
    const Groove groove = someGroove(plant, position);
    setup::Setup setup = latheSetup(probe);
    placeGroove(setup, groove);
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, 60);
    enterGroove(bench, groove, 2);
    const int walls = position == 8 ? 1 : 2, base = 3 - walls;
    const int way = world / 2 % 2;  // plus, minus
    bench.run(wayTo(groove, 60) + fmt::format("CYCLE973(1103,5,2,,{},{},3,4,,2,,2,0)", walls, way));
    const double radius = probe.ballRadius - probe.pretravel;
    EXPECT_NEAR(trigger(bench, walls, way == 0 ? 1 : -1, 4), way == 0 ? radius : -radius, 1e-8) << "world " << world;
    EXPECT_EQ(trigger(bench, walls, way == 0 ? -1 : 1, 4), 0);
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {4}), 2 * radius, 1e-8);
    // The length on the base, with a wrong length in the tool data; the axis follows from the cutting edge position.
    const std::string length = base == 1 ? "$TC_DP4" : "$TC_DP3";
    const double right = bench.data(length, {1, 1}), wrong = plant.number(-0.5, 0.5);
    const bool adapt = world % 4 < 2;
    bench.set(length, {1, 1}, right + wrong);
    const std::string out = position == 8 ? fmt::format("G0 X{:.6f}\n", 2 * (groove.upper + 20))
                                          : fmt::format("G0 Z{:.6f}\n", groove.upper + 20 - 60);
    bench.run(out + wayTo(groove, 60) + fmt::format("CYCLE973({},5,2,,,,3,4,,1,,2,0)", adapt ? 1000102 : 102));
    const double axial = probe.ballRadius - probe.axialPretravel;
    if (adapt) {
      EXPECT_NEAR(bench.data(length, {1, 1}), right + axial - radius, 1e-8) << "world " << world;
      EXPECT_NEAR(trigger(bench, base, -1, 4), -radius, 1e-8);
    } else {
      EXPECT_EQ(bench.data(length, {1, 1}), right + wrong);
      EXPECT_NEAR(trigger(bench, base, -1, 4), -axial + wrong, 1e-8) << "world " << world;
    }
  }
}

TEST(Cycle973, RefusesWhatItCannotDo) {
  const Groove groove;
  setup::Setup setup = latheSetup({});
  placeGroove(setup, groove);
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, 60);
  enterGroove(bench, groove, 1);
  const auto call = [&](const std::string& arguments, const std::string& before = {}) {
    return wayTo(groove, 60) + before + "CYCLE973(" + arguments + ")";
  };
  // A good call on the outer edge of the groove, in X.
  EXPECT_EQ(bench.alarmOf(call("2103,1,1,,1,,3,4,300,1,,2,0")), "");
  bench.run("G0 X400");
  for (const char* mvar :
       {"4", "1110", "100", "2100", "3101", "21101", "101100", "1001101", "2001100", "1102", "103", "-1"})
    EXPECT_EQ(bench.alarmOf(call(std::string(mvar) + ",1,1,,1,,3,4,300,1,,2,0")), "61307") << mvar;
  EXPECT_EQ(bench.alarmOf(call("2103,13,1,,1,,3,4,300,1,,2,0")), "61313");
  EXPECT_EQ(bench.alarmOf(call("2103,1,4,,1,,3,4,300,1,,2,0")), "61333");
  EXPECT_EQ(bench.alarmOf(call("2103,1,0,,1,,3,4,300,1,,2,0")), "61333");
  EXPECT_EQ(bench.alarmOf(call("2103,1,3,,1,,3,4,300,1,,2,0")), "61319") << "groove 3 is not entered";
  EXPECT_EQ(bench.alarmOf(call("2103,1,1,,2,,3,4,300,1,,2,0")), "61325") << "no walls in X";
  EXPECT_EQ(bench.alarmOf(call("1103,1,1,,1,2,3,4,300,1,,2,0")), "61326");
  EXPECT_EQ(bench.alarmOf(call("1101,1,,0,3,1,3,4,300,1,,2,0")), "61336") << "there is no Y";
  EXPECT_EQ(bench.alarmOf(call("1101,1,,0,0,1,3,4,300,1,,2,0")), "61325");
  EXPECT_EQ(bench.alarmOf(call("2103,1,1,,1,,0,4,300,1,,2,0")), "61308");
  EXPECT_EQ(bench.alarmOf(call("2103,2,1,,1,,3,1.9,300,1,,2,0")), "61303")
      << "a data set of zeros needs a safe area larger than the ball's radius";
  EXPECT_EQ(bench.data("$SNS_MEA_WP_BALL_DIAM", {1}), 0) << "nothing is written then";
  bench.run("G0 X400");
  EXPECT_EQ(bench.alarmOf(call("1101,1,,420,2,1,3,4,300,1,,2,0", "G0 X440\n")), "61301") << "nothing there";
  EXPECT_EQ(bench.alarmOf(call("2103,1,1,,1,,3,4,300,1,,2,0", "D0\n")), "61311");
  bench.set("$TC_DP6", {1, 1}, 0);
  EXPECT_EQ(bench.alarmOf(call("2103,1,1,,1,,3,4,300,1,,2,0")), "61351");
  bench.set("$TC_DP6", {1, 1}, 2);
  bench.set("$TC_DP2", {1, 1}, 6);
  EXPECT_EQ(bench.alarmOf(call("2103,1,1,,1,,3,4,300,1,,2,0")), "61315") << "no groove for this position";
  bench.set("$TC_DP2", {1, 1}, 3);
  EXPECT_EQ(bench.alarmOf(call("1101,1,,420,2,1,3,4,300,1,,2,0")), "61315");
  bench.set("$TC_DP1", {1, 1}, 500);
  EXPECT_EQ(bench.alarmOf(call("1101,1,,420,2,1,3,4,300,1,,2,0")), "61309");
}

}  // namespace
}  // namespace probewright
