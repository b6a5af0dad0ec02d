#include "cycles_kinematics/sphere_worlds.hpp"

/// Cycle 452: after a drift or a change of heads the preset lies in the sphere again.
namespace probewright::testing_support {
namespace {

Words words452(const Build& build, const Words& changes = {}) {
  Words words = words451(build, 0);
  std::erase_if(words, [](const auto& word) { return word.first == 406 || word.first == 431; });
  return with(words, changes);
}

const std::string reset = "PLANE RESET STAY\n";

/// The spindle has drifted: the kinematics takes it over, the rotary axes stay where they are.
TEST(PresetCompensation, TakesOverADrift) {
  Dice dice(4521);
  for (std::size_t at = 0; at < 4; ++at) {
    SCOPED_TRACE(builds()[at].machine);
    SphereWorld world(builds()[at], controlOf(static_cast<int>(at)));
    const Vector3 drift = dice.within(0.04);
    world.bench.setup.world.truth.errors.thermal.push_back({drift, 1});
    const Ran ran = world.bench.run(probe(452, words452(world.build)) + reset);
    ASSERT_TRUE(ended(ran)) << ran.why();
    const KinematicData found = kinematicsOf(ran, world.built());
    // The drift ends with e^-t of its way.
    EXPECT_LT((found.base - drift).norm(), 1e-5);
    EXPECT_LT(apart(machine::corrected(world.built(), found.axes), world.built()).place, 1e-5);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(ran.q(147 + i), drift[i], 1e-5);
    EXPECT_EQ(ran.preset().translation(), world.build.sphere) << "the preset table stays";
    const bool html = world.bench.control == ControlKind::TNC640;
    EXPECT_NE(ran.log(html ? "TCHPR452.html" : "TCHPR452.TXT").find("Measurement uncertainty"), std::string::npos);
  }
}

/// The sphere lies elsewhere and the axes too: the second time there is nothing left to compensate.
TEST(PresetCompensation, SecondTimeFindsNothing) {
  Dice dice(4522);
  for (std::size_t at = 0; at < 4; ++at) {
    SCOPED_TRACE(builds()[at].machine);
    SphereWorld world(builds()[at]);
    world.plant(dice, 0.1, 0);
    const Vector3 off = dice.within(0.1);
    world.bench.setup.beliefs.presets.front().origin += off;
    const Ran ran = world.bench.run(probe(452, words452(world.build)) + reset + probe(452, words452(world.build)) +
                                    reset + probe(451, words451(world.build, 0)));
    ASSERT_TRUE(ended(ran)) << ran.why();
    const control::CycleRecord& second = ran.outcome.journal.cycles[1];
    for (const control::ResultRecord& result : second.results)
      EXPECT_LT(result.value, 1e-6) << result.name;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(ran.q(147 + i), 0, 1e-6);
  }
}

/// Another head hangs differently on the axis that carries it, and its own axis lies elsewhere in it: only that axis is
/// measured, and then the preset holds at every angle of the other.
TEST(PresetCompensation, AdjustsAHeadThatWasChanged) {
  Dice dice(4523);
  for (int at = 0; at < 4; ++at) {
    SCOPED_TRACE(at);
    Build build = builds()[2];
    const Vector3 hangs = dice.within(0.1);
    const Vector3 place = build.sphere;
    build.sphere -= hangs;
    SphereWorld world(build);
    world.bench.setup.beliefs.presets.front().origin = place;
    const std::size_t a = *world.built().axisIndex("A"), c = *world.built().axisIndex("C");
    auto& errors = world.bench.setup.world.truth.errors;
    // Tool and A elsewhere on C are, seen from the tool, C elsewhere and everything shifted.
    errors.rotaryAxes.push_back({c, -hangs, Vector3::Zero()});
    errors.rotaryAxes.push_back({a, Vector3(0, dice.between(-0.1, 0.1), dice.between(-0.1, 0.1)), Vector3::Zero()});
    Build onlyA = build;
    onlyA.axes.erase('C');
    Build onlyC = build;
    onlyC.axes.erase('A');
    const Ran ran = world.bench.run(probe(452, words452(onlyA)) + reset + probe(451, words451(onlyC, 0, {{413, 30}})));
    ASSERT_TRUE(ended(ran)) << ran.why();
    EXPECT_LT(ran.q(143), 1e-6);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(ran.q(147 + i), 0, 1e-6);
  }
}

TEST(PresetCompensation, NeedsNoRotaryAxes) {
  SphereWorld world({"mill3", {}, {50, 40, -400}});
  world.bench.setup.world.truth.errors.thermal.push_back({{0.01, -0.02, 0.03}, 1});
  const Ran ran =
      world.bench.run(probe(452, words452(world.build)) + "L Z+60 R0 FMAX\n" + probe(452, words452(world.build)));
  ASSERT_TRUE(ended(ran)) << ran.why();
  EXPECT_LT((kinematicsOf(ran, world.built()).base - Vector3(0.01, -0.02, 0.03)).norm(), 1e-5);
  EXPECT_EQ(ran.q(141), -1);
  EXPECT_NEAR(ran.q(149), 0, 1e-5);
}

TEST(PresetCompensation, RefusesATiltedPlane) {
  SphereWorld world(builds()[0]);
  EXPECT_EQ(world.bench.run("PLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY\n" + probe(452, words452(world.build))).alarm(),
            "Tilted working plane not permitted");
}

}  // namespace
}  // namespace probewright::testing_support
