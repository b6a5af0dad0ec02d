#include "cycles_kinematics/sphere_worlds.hpp"

/// Kinematics cycles with the probe in an angle head: the touch probe axis is Y, main and minor axis are Z and X.
namespace probewright::testing_support {
namespace {

struct AngleHead {
  AngleHead() : world({"mill4-table", {{'B', {-12, 12, 0, 3}}}, {60, -380, -560}, 45}) {
    world.bench.setup.world.truth.tools.front().shankDirection = Vector3::UnitY();
  }
  Ran run(int mode, const Words& changes = {}) const {
    return world.bench.runBare("TOOL CALL 1 Y\n" + probe(451, words451(world.build, mode, changes)));
  }
  SphereWorld world;
};

TEST(Cycle451InAnAngleHead, FindsThePlantedAxis) {
  AngleHead head;
  Dice dice(4514);
  head.world.plant(dice, 0.1, 0);
  const Ran ran = head.run(1);
  ASSERT_TRUE(ended(ran)) << ran.why();
  const KinematicData found = kinematicsOf(ran, head.world.built());
  EXPECT_LT(apart(machine::corrected(head.world.built(), found.axes), head.world.truth()).place, 1e-6);
}

TEST(Cycle451InAnAngleHead, SetsThePresetIntoTheSphere) {
  AngleHead head;
  const Vector3 beside(0.4, -0.3, 0.2);
  head.world.bench.setup.beliefs.presets.front().origin = head.world.build.sphere + beside;
  const Ran ran = head.world.bench.runBare("TOOL CALL 1 Y\nL Z-0.2 X-0.4 FMAX\nL Y+20 FMAX\n" +
                                           probe(451, words451(head.world.build, 0, {{431, 1}})));
  ASSERT_TRUE(ended(ran)) << ran.why();
  EXPECT_LT((ran.seen(head.world.build.sphere) - Vector3::Zero()).norm(), 1e-4);
}

}  // namespace
}  // namespace probewright::testing_support
