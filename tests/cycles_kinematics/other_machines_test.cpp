#include "support/other_machines.hpp"
#include "cycles_kinematics/sphere_worlds.hpp"

/// Cycle 451 on machines with other axes, orders and senses than the ready-made ones.
namespace probewright::testing_support {
namespace {

/// How each of otherMachines() is measured.
std::vector<std::map<char, Measured>> measuredOf() {
  return {{{'A', {-80, 80, 0, 4}}, {'C', {90, 270, 0, 3}}},
          {{'B', {-80, 80, 0, 4}}, {'C', {90, 270, 0, 3}}},
          {{'A', {-60, 60, 0, 4}}, {'C', {60, 300, 20, 3}}},
          {{'B', {-80, 80, 0, 4}}, {'C', {90, 270, 0, 3}}},
          {{'A', {-50, 50, 0, 4}}, {'B', {-60, 60, 0, 4}}}};
}

SphereWorld worldOf(std::size_t at, Dice& dice, ControlKind control) {
  const OtherMachine other = otherMachines()[at];
  const Build build{other.base, measuredOf()[at], at < 3 ? Vector3(110, 30, -480) : Vector3(120, 50, -450)};
  SphereWorld world(build, control);
  other.change(world.bench.setup.world.truth.machine);
  world.plant(dice, 0.2, 0.02);
  return world;
}

class OtherMachines : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Machines, OtherMachines, ::testing::Range<std::size_t>(0, 5));

TEST_P(OtherMachines, ShowTheirPlantedAxesAndNothingASecondTime) {
  SCOPED_TRACE(otherMachines()[GetParam()].name);
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Dice dice(4580 + static_cast<unsigned>(GetParam()));
    const SphereWorld world = worldOf(GetParam(), dice, control);
    const Ran ran = world.bench.run(probe(451, words451(world.build, 2)) + "PLANE RESET STAY\n" +
                                    probe(451, words451(world.build, 0)));
    ASSERT_TRUE(ended(ran)) << ran.why();
    const Apart off = apart(machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes), world.truth());
    EXPECT_LT(off.place, 1e-6);
    EXPECT_LT(off.direction, 1e-8);
    for (const auto& [axis, measured] : world.build.axes)
      EXPECT_LT(ran.q(141 + axis - 'A'), 1e-6) << axis;
    EXPECT_FALSE(ran.log(control == ControlKind::TNC640 ? "TCHPR451.html" : "TCHPR451.TXT").empty());
  }
}

/// A tilted plane is where the part is, once the axes are known. The part: a second ball.
TEST_P(OtherMachines, MakeTiltedPlanesExact) {
  SCOPED_TRACE(otherMachines()[GetParam()].name);
  Dice dice(4590 + static_cast<unsigned>(GetParam()));
  const SphereWorld world = worldOf(GetParam(), dice, ControlKind::TNC640);
  // Where the round table is the outer one it turns the tool on the spot.
  const std::string tilted =
      std::string(GetParam() == 2 ? "PLANE SPATIAL SPA+20 SPB+0" : "PLANE SPATIAL SPA+0 SPB+20") +
      " SPC+0 TURN F5000 SEQ+ TABLE ROT\n" + touchTop() + "Q1=Q160\nPLANE RESET TURN FMAX\n";
  // The top of the sphere is one radius above the preset in its middle, however the plane is tilted.
  const Ran before = world.bench.run(tilted);
  ASSERT_TRUE(ended(before)) << before.why();
  EXPECT_GT(std::abs(before.q(1) - sphereRadius), 1e-3);
  const Ran after = world.bench.run(probe(451, words451(world.build, 2)) + "PLANE RESET STAY\n" + tilted);
  ASSERT_TRUE(ended(after)) << after.why();
  // Where the ball's middle lies across the plane matters in the second order only.
  EXPECT_NEAR(after.q(1), sphereRadius, 1e-5);
}

}  // namespace
}  // namespace probewright::testing_support
