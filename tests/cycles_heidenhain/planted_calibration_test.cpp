#include "cycles_heidenhain/worlds.hpp"

/// Calibrations of probes and on machines that are not ideal: the effective values contain what is wrong in the same
/// way at every touch, and so take it out of later measurements. What differs from touch to touch remains.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6, digit = 6e-5;  // tables have four decimals

enum class Kind { Ring, Stud, Sphere, OldRing, OldPin };

struct Calibrated {
  Bench bench;
  double ball = 0, length = 0;
  Vector2 tip = Vector2::Zero();
  double standard = 0;  ///< radius
  double begin = 0;     ///< Q380
  int count = 4;
  std::string cycle = {};
};

/// A standard at X0 Y0, 0.3 mm beside; a hole of 50 mm at X120, whose top face is Z0.
Calibrated calibrated(Dice& dice, Kind kind, int count) {
  const bool old = kind == Kind::OldRing || kind == Kind::OldPin;
  Calibrated world{Bench(old ? ControlKind::iTNC530 : ControlKind::TNC640)};
  Bench& bench = world.bench;
  world.ball = written(dice.between(1, 3), 4);
  world.length = written(dice.between(80, 120), 4);
  bench.probeOf(world.length, world.ball);
  world.tip = {written(dice.between(-0.1, 0.1), 4), written(dice.between(-0.1, 0.1), 4)};
  bench.trueProbe().tipOffset = world.tip;
  auto& believed = bench.believedProbe();
  // Cycle 2 finds no offset: the control knows it.
  believed.tipOffset = old ? world.tip : Vector2(0.05, -0.05);
  believed.radius = written(world.ball + dice.between(-0.2, 0.2), 4);
  believed.length = written(world.length + dice.between(-0.3, 0.3), 4);
  believed.maximumTravel = 40;
  bench.preset(1, {0, 0, -400});
  bench.part(simulation::Ring(25, 50, -30), pose({120, 0, -400}));
  const Vector3 place(dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), -400);
  world.standard = written(dice.between(12, 18), 4);
  world.begin = old ? 0 : written(dice.between(0, 360));
  world.count = old ? 4 : count;
  const Words words = {{407, world.standard}, {320, 1}, {423, world.count}, {380, world.begin}};
  const auto go = [](double z) { return fmt::format("L Z+60 R0 FMAX\nL X+0 Y+0 R0 FMAX\nL Z{:+.4f} R0 FMAX\n", z); };
  switch (kind) {
    case Kind::Ring:
      bench.part(simulation::Ring(world.standard, world.standard + 10, -30), pose(place));
      world.cycle = go(-8) + probe(462, words);
      break;
    case Kind::Stud:
      bench.part(simulation::RoundBar(world.standard, -30, 0), pose(place));
      world.cycle = go(3.5) + probe(463, with(words, {{301, dice.whole(0, 1)}}));
      break;
    case Kind::Sphere:
      bench.part(simulation::SolidSphere(Vector3::Zero(), world.standard), pose(place));
      world.cycle = go(world.standard + 3.5) + probe(460, with(words, {{301, dice.whole(0, 1)}, {433, 1}, {434, 0}}));
      break;
    case Kind::OldRing:
    case Kind::OldPin:
      if (kind == Kind::OldRing) {
        bench.part(simulation::Ring(world.standard, world.standard + 10, -30), pose(place));
      } else {
        bench.part(simulation::RoundBar(world.standard, -30, 0), pose(place));
      }
      bench.setup.beliefs.parameters["MP6180.2"] = {-400.0, {}};
      bench.setup.beliefs.parameters["MP6185.0"] = {8.0, {}};
      world.cycle = fmt::format("TCH PROBE 2.0 CALIBRATE TS\nTCH PROBE 2.1 HEIGHT: +40 R {:+.4f} DIRECTION: {}\n",
                                world.standard, kind == Kind::OldPin ? 1 : 0);
      break;
  }
  world.cycle += "L Z+60 R0 FMAX\n";
  return world;
}

const Words hole = {{273, 120}, {274, 0}, {262, 50}, {325, 0}, {247, 90}, {261, -8}, {320, 1}, {260, 30},
                    {301, 0},   {275, 0}, {276, 0},  {279, 0}, {280, 0},  {281, 0},  {309, 0}, {330, 0}};

constexpr Kind kinds[] = {Kind::Ring, Kind::Stud, Kind::Sphere, Kind::OldRing, Kind::OldPin};

/// A signal that comes late by the same way everywhere makes the ball smaller; measured with that, the hole is right.
TEST(PlantedCalibration, TakesPretravelIntoTheRadius) {
  Dice dice(4661);
  for (int at = 0; at < 60; ++at) {
    const Kind kind = kinds[at % 5];
    SCOPED_TRACE(fmt::format("world {}", at));
    Calibrated world = calibrated(dice, kind, dice.whole(3, 8));
    const double late = written(dice.between(0.002, 0.03), 4);
    world.bench.trueProbe().pretravel = late;
    const Ran ran = world.bench.run(world.cycle + probe(421, hole));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), world.ball - late, exact);
    EXPECT_NEAR(ran.q(153), 50, exact);
    EXPECT_NEAR(ran.q(151), 120, exact);
    EXPECT_NEAR(ran.q(152), 0, exact);
  }
}

/// Three lobes: five, seven or eight touches average them out; three meet the same lobe each time, so the radius is
/// that of the direction of Q380.
TEST(PlantedCalibration, AveragesLobesUnlessEachTouchMeetsOne) {
  Dice dice(4662);
  for (int at = 0; at < 60; ++at) {
    const Kind kind = kinds[at % 3];
    constexpr int counts[] = {3, 5, 7, 8};
    SCOPED_TRACE(fmt::format("world {}", at));
    Calibrated world = calibrated(dice, kind, counts[at / 3 % 4]);
    simulation::TrueProbe& stylus = world.bench.trueProbe();
    stylus.pretravel = dice.between(0.01, 0.02);
    stylus.lobing = dice.between(0.002, 0.006);
    stylus.lobingPhase = dice.between(0, 120);
    const Ran ran = world.bench.run(world.cycle);
    ASSERT_TRUE(ran.finished()) << ran.why();
    // Inside, the surface looks towards the middle.
    const double normal = world.begin + (kind == Kind::Ring ? 180 : 0);
    const double lobe = world.count == 3 ? stylus.lobing * std::cos(radians(3 * (normal - stylus.lobingPhase))) : 0;
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), world.ball - stylus.pretravel - lobe, digit);
    // Beside the spindle axis the ball meets the wall at a slant of up to 0.14 / 10, which turns the lobes as much.
    constexpr double slanting = 0.006 * 3 * 0.14 / 10 + digit;
    EXPECT_NEAR(ran.cell("TCHPROBE.TP", "1", "CAL_OF1"), world.tip.x(), slanting);
    EXPECT_NEAR(ran.cell("TCHPROBE.TP", "1", "CAL_OF2"), world.tip.y(), slanting);
  }
}

/// Axes that display too little show a circle that is too small: a ring makes the ball larger, a stud smaller.
TEST(PlantedCalibration, TakesTheScalesIntoTheRadius) {
  Dice dice(4663);
  for (int at = 0; at < 50; ++at) {
    const Kind kind = kinds[at % 5];
    SCOPED_TRACE(fmt::format("world {}", at));
    Calibrated world = calibrated(dice, kind, dice.whole(3, 8));
    const double scale = dice.between(-1e-3, 1e-3);
    world.bench.setup.world.truth.errors.axes.resize(3);
    for (int axis = 0; axis < 2; ++axis)
      world.bench.setup.world.truth.errors.axes[static_cast<std::size_t>(axis)].scale = scale;
    const Ran ran = world.bench.run(world.cycle);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const bool inside = kind == Kind::Ring || kind == Kind::OldRing;
    const double locus = (world.standard + (inside ? -1 : 1) * world.ball) / (1 + scale);
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), inside ? world.standard - locus : locus - world.standard, digit);
  }
}

/// What comes late along the stylus makes it shorter, in every cycle that finds the length; heights are right then.
TEST(PlantedCalibration, TakesAxialPretravelIntoTheLength) {
  Dice dice(4664);
  const Words top = {{263, 160}, {264, 0}, {261, 0}, {320, 1}, {272, 3}, {267, -1},
                     {260, 30},  {281, 0}, {288, 0}, {289, 0}, {309, 0}, {330, 0}};
  for (int at = 0; at < 45; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const int cycle = std::array{460, 461, 9}[static_cast<std::size_t>(at % 3)];
    Calibrated world = calibrated(dice, cycle == 9 ? Kind::OldRing : Kind::Sphere, 5);
    const double late = written(dice.between(0.001, 0.02), 4);
    world.bench.trueProbe().axialPretravel = late;
    world.bench.trueProbe().pretravel = written(dice.between(0, 0.02), 4);
    const std::string beside = "L Z+60 R0 FMAX\nL X+160 Y+0 R0 FMAX\nL Z+4 R0 FMAX\n";
    const std::string text = cycle == 460   ? world.cycle
                             : cycle == 461 ? beside + probe(461, {{434, 0}})
                                            : beside +
                                                  "TCH PROBE 9.0 CALIBRATE TS LENGTH\nTCH PROBE 9.1 DATUM +0 "
                                                  "REFERENCE SYSTEM 0\n";
    const Ran ran = world.bench.run(text + "L Z+60 R0 FMAX\n" + probe(427, top));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), world.length - late, exact);
    EXPECT_NEAR(ran.q(160), 0, exact);
  }
}

/// Scatter: the radius scatters by what the mean of so many touches lets it.
TEST(PlantedCalibration, ScattersLessWithMoreTouches) {
  constexpr double sigma = 0.005;
  constexpr int runs = 120;
  for (const int count : {3, 8}) {
    Dice dice(4665);
    Calibrated world = calibrated(dice, Kind::Ring, count);
    world.bench.trueProbe().repeatability = sigma;
    double sum = 0;
    for (int at = 0; at < runs; ++at) {
      world.bench.setup.world.truth.seed = static_cast<std::uint64_t>(at + 1);
      const Ran ran = world.bench.run(world.cycle);
      ASSERT_TRUE(ran.finished()) << ran.why();
      sum += std::pow(ran.cell("TOOL.T", "1", "R") - world.ball, 2);
    }
    const double expected = sigma / std::sqrt(count);
    EXPECT_NEAR(std::sqrt(sum / runs), expected, 0.25 * expected) << count << " touches";
  }
}

}  // namespace
}  // namespace probewright::testing_support
