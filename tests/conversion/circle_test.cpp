#include "conversion/twins.hpp"

/// Holes and spigots: 412, 413, 421, 422 and CYCLE977, CYCLE979.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 200;
constexpr double exact = 1e-6;

TEST(Convert412, SetsTheSameOriginInAnyWorld) {
  Dice dice(4120);
  for (int world = 0; world < worlds; ++world) {
    PlantedPart part = plant(dice, ControlKind::TNC640, 1, 180);
    const double ball = part.bench.believedProbe().radius;
    const double diameter = dice.between(2 * ball + 6, 90);
    part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), part.machineFromPart);
    const bool moves = dice.coin();
    const Words words = {{321, part.nominal.x()},
                         {322, part.nominal.y()},
                         {262, written(diameter + dice.between(-0.5, 0.5))},
                         {325, written(dice.between(-360, 360))},
                         {247, dice.coin() ? 90 : -90},
                         {261, part.nominal.z() - written(dice.between(5, 12))},
                         {320, dice.coin() ? 0 : written(dice.between(0, 3))},
                         {260, part.nominal.z() + 20},
                         {301, dice.whole(0, 1)},
                         {305, 1},
                         {331, moves ? written(dice.between(-50, 50)) : part.nominal.x()},
                         {332, moves ? written(dice.between(-50, 50)) : part.nominal.y()},
                         {303, 1}};
    const std::string klartext = klartextProgram(probe(412, words));
    const std::string sinumerik = toSinumerik(klartext);
    // What shifts a frame has no twin in Klartext.
    const std::string again = moves ? klartext : toKlartext(sinumerik);
    SCOPED_TRACE(fmt::format("world {}\n{}\n{}\n{}", world, klartext, sinumerik, again));
    const Twin original = runTwin(klartext, part.bench.setup, ControlKind::TNC640);
    const Twin there = runTwin(sinumerik, part.bench.setup, ControlKind::Sinumerik840Dsl);
    ASSERT_TRUE(original.finished) << original.why;
    ASSERT_TRUE(there.finished) << there.why;
    const Twin back = runTwin(again, part.bench.setup, ControlKind::TNC640);
    ASSERT_TRUE(back.finished) << back.why;
    EXPECT_NEAR(original.result("Q153"), back.result("Q153"), exact);
    EXPECT_TRUE(original.machineFromWorkpiece.isApprox(back.machineFromWorkpiece, 1e-9));
    EXPECT_NEAR(original.result("Q153"), there.result("_OVR[4]"), exact);
    EXPECT_NEAR(original.result("Q151"), there.result("_OVR[5]"), exact);
    EXPECT_NEAR(original.result("Q152"), there.result("_OVR[6]"), exact);
    EXPECT_LT((original.machineFromWorkpiece.translation() - there.machineFromWorkpiece.translation()).norm(), exact);
    EXPECT_TRUE(original.machineFromWorkpiece.isApprox(there.machineFromWorkpiece, 1e-9));
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace probewright::testing_support
