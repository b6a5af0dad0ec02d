#include "cycles_heidenhain/worlds.hpp"

/// Machines and probes that are not as the control believes: results are wrong by what theory says.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

/// A hole or stud of this diameter at X50 Y40 of the preset.
Bench circleBench(bool hole, double diameter) {
  Bench bench;
  bench.preset(1, {-10, 5, -400});
  const Pose lying = pose({40, 45, -400});
  if (hole) {
    bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), lying);
  } else {
    bench.part(simulation::RoundBar(diameter / 2, -40, 0), lying);
  }
  return bench;
}

Ran measureCircle(const Bench& bench, bool hole, double diameter, double start = 20) {
  Words words = {{273, 50}, {274, 40}, {262, diameter},       {325, start},          {247, 90}, {261, -8}, {320, 0},
                 {260, 20}, {301, 0},  {hole ? 275 : 277, 0}, {hole ? 276 : 278, 0}, {279, 0},  {280, 0},  {281, 0},
                 {309, 0},  {330, 0}};
  Ran ran = bench.run(probe(hole ? 421 : 422, words));
  EXPECT_TRUE(ran.finished()) << ran.why();
  return ran;
}

TEST(PlantedErrors, WrongBallRadiusAndPretravelEnterTwice) {
  Dice dice(1);
  for (int i = 0; i < 20; ++i) {
    for (const bool hole : {true, false}) {
      const double diameter = written(dice.between(20, 60)), wrong = dice.between(-0.05, 0.05),
                   late = dice.between(0, 0.03);
      Bench bench = circleBench(hole, diameter);
      bench.believedProbe().radius = written(2 + wrong, 4);
      bench.trueProbe().pretravel = late;
      const Ran ran = measureCircle(bench, hole, diameter);
      const double believed = written(2 + wrong, 4) - 2;
      EXPECT_NEAR(ran.q(153), diameter + (hole ? 2 : -2) * (believed + late), exact);
      EXPECT_NEAR(ran.q(151), 50, exact);
      EXPECT_NEAR(ran.q(152), 40, exact);
    }
  }
}

TEST(PlantedErrors, AnUnknownTipOffsetMovesTheCentre) {
  Dice dice(2);
  for (int i = 0; i < 20; ++i) {
    const Vector2 offset(written(dice.between(-0.2, 0.2), 4), written(dice.between(-0.2, 0.2), 4));
    Bench bench = circleBench(true, 40);
    bench.trueProbe().tipOffset = offset;
    const Ran unknown = measureCircle(bench, true, 40);
    EXPECT_NEAR(unknown.q(151), 50 - offset.x(), exact);
    EXPECT_NEAR(unknown.q(152), 40 - offset.y(), exact);
    EXPECT_NEAR(unknown.q(153), 40, exact);
    bench.believedProbe().tipOffset = offset;
    const Ran known = measureCircle(bench, true, 40);
    EXPECT_NEAR(known.q(151), 50, exact);
    EXPECT_NEAR(known.q(152), 40, exact);
  }
}

TEST(PlantedErrors, TrackingTurnsAnUnknownTipOffsetIntoADiameter) {
  Dice dice(3);
  for (int i = 0; i < 20; ++i) {
    const double offset = written(dice.between(-0.2, 0.2), 4);
    Bench bench = circleBench(true, 40);
    bench.trueProbe().tipOffset = {offset, 0};
    bench.believedProbe().orient = true;
    const Ran unknown = measureCircle(bench, true, 40);
    EXPECT_NEAR(unknown.q(151), 50, exact);
    EXPECT_NEAR(unknown.q(152), 40, exact);
    EXPECT_NEAR(unknown.q(153), 40 - 2 * offset, exact);
    bench.believedProbe().tipOffset = {offset, 0};
    EXPECT_NEAR(measureCircle(bench, true, 40).q(153), 40, exact);
  }
}

TEST(PlantedErrors, AWrongLengthMovesTheHeight) {
  Bench bench = circleBench(false, 40);
  bench.believedProbe().length = 100.03;
  bench.trueProbe().axialPretravel = 0.004;
  const Ran ran =
      bench.run(probe(417, {{263, 50}, {264, 40}, {294, 0}, {320, 0}, {260, 20}, {305, 1}, {333, 0}, {303, 1}}));
  ASSERT_TRUE(ran.finished()) << ran.why();
  // The tip is believed 0.03 mm below where it is and travels 0.004 mm on.
  EXPECT_NEAR(ran.q(160), -0.034, exact);
}

TEST(PlantedErrors, AScaleErrorShrinksWhatIsMeasuredButNotTheBall) {
  Dice dice(4);
  for (int i = 0; i < 20; ++i) {
    const double scale = dice.between(-5e-4, 5e-4);
    Bench bench;
    bench.preset(1, {0, 0, -400});
    PlantedPart part{bench};
    part.machineFromPart = pose({100, 50, -400});
    layPocket(part, {80, 60});
    part.bench.setup.world.truth.errors.axes.resize(3);
    part.bench.setup.world.truth.errors.axes[0].scale = scale;
    const Ran ran = part.bench.run(probe(423, {{273, 100},
                                               {274, 50},
                                               {282, 80},
                                               {283, 60},
                                               {261, -8},
                                               {320, 0},
                                               {260, 20},
                                               {301, 0},
                                               {284, 0},
                                               {285, 0},
                                               {286, 0},
                                               {287, 0},
                                               {279, 0},
                                               {280, 0},
                                               {281, 0},
                                               {309, 0},
                                               {330, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), 100 / (1 + scale), exact);
    EXPECT_NEAR(ran.q(154), (80 - 4) / (1 + scale) + 4, exact);
    EXPECT_NEAR(ran.q(155), 60, exact);
  }
}

TEST(PlantedErrors, RepeatedMeasurementsMustAgree) {
  Bench bench = circleBench(true, 40);
  bench.control = ControlKind::iTNC530;
  bench.trueProbe().repeatability = 0.02;
  bench.setup.beliefs.parameters["MP6170"] = {3.0, {}};
  bench.setup.beliefs.parameters["MP6171"] = {0.002, {}};
  const Words words = {{273, 50}, {274, 40}, {262, 40}, {325, 0}, {247, 90}, {261, -8}, {320, 0}, {260, 20},
                       {301, 0},  {275, 0},  {276, 0},  {279, 0}, {280, 0},  {281, 0},  {309, 0}, {330, 0}};
  const Ran scattered = bench.run(probe(421, words));
  EXPECT_EQ(scattered.alarm(), "Value beyond tolerance") << scattered.why();
  bench.setup.beliefs.parameters["MP6171"] = {0.5, {}};
  const Ran ran = bench.run(probe(421, words));
  EXPECT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.touches(), 12U) << "every point three times";
}

}  // namespace
}  // namespace probewright::testing_support
