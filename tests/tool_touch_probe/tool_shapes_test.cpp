#include <gmock/gmock.h>

#include "tool_touch_probe/tool_worlds.hpp"

/// Disc and T-slot cutters, whose edges are wider than what carries them, and holders.
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;

/// The contact is a disc of 40 mm, 10 mm thick.
struct Shaped {
  Shaped(ControlKind kind, const simulation::TrueTool& tool, const std::string& offset = "0")
      : world(kind), folder(world.bench) {
    world.disc(40);
    world.add(tool, 12, tool.length, tool.radius);
    world.parameter("measureTolerance1", "MP6510", 0.002);
    enter(folder, world, {{"L-OFFS", offset}});
  }
  Ran measured() const { return world.run(probe(483, {{340, 1}, {260, 60}, {341, 0}})); }

  ToolWorld world;
  TableFolder folder;
};

/// `thick`: of the edges, on a neck of 5 mm radius.
simulation::TrueTool cutter(double radius, double thick) {
  simulation::TrueTool tool;
  tool.length = 90;
  tool.radius = radius;
  tool.cutter.cutLength = thick;
  tool.cutter.shankRadius = 5;
  tool.cutter.teeth.resize(1);
  return tool;
}

TEST(ToolShapes, DiscAndTSlotCuttersAreMeasuredAtTheirEdges) {
  Dice dice(4830);
  for (int at = 0; at < 12; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    // Up to the side of the contact their edges are: from 5 mm below its top to `thick` above that.
    simulation::TrueTool tool = cutter(written(dice.between(12, 60)), written(dice.between(2, 12)));
    tool.cutter.helix = dice.coin() ? 0 : 10;
    const double radial = dice.between(-0.05, 0.05), axial = dice.between(-0.05, 0.05);
    tool.cutter.teeth[0] = {.angle = dice.between(-180, 180), .radial = radial, .axial = axial};
    const Ran ran = Shaped(controlOf(at), tool).measured();
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_LE(ran.q(115), axial + 1e-4);
    EXPECT_GE(ran.q(115), axial - 0.0021);
    EXPECT_LE(ran.q(116), radial + 1e-4);
    EXPECT_GE(ran.q(116), radial - 0.0021);
  }
}

/// L-OFFS puts the edges of a thin disc where the contact is, or beside it.
TEST(ToolShapes, AThinDiscCanMissTheContact) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    const simulation::TrueTool disc = cutter(30, 1.5);
    EXPECT_EQ(Shaped(kind, disc, "-3").measured().alarm(), "");
    EXPECT_EQ(Shaped(kind, disc, "+3").measured().alarm(), "");
    // 5 + 7 mm below the top: under the contact, and the neck is too thin to reach it.
    EXPECT_EQ(Shaped(kind, disc, "+7").measured().alarm(), "Touch point inaccessible");
  }
}

TEST(ToolShapes, AHolderThatMeetsTheContactFirstIsACollision) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    simulation::TrueTool shortMill;
    shortMill.length = 70;
    shortMill.radius = 6;
    shortMill.cutter.teeth.resize(2);
    shortMill.cutter.teeth[1].angle = 180;
    shortMill.cutter.holderRadius = 25;
    shortMill.cutter.holderLength = 58;
    EXPECT_EQ(Shaped(kind, shortMill, "0").measured().alarm(), "");
    const Ran ran = Shaped(kind, shortMill, "+8").measured();
    EXPECT_EQ(ran.alarm(), "Collision");
    EXPECT_THAT(ran.why(), HasSubstr("holder"));
  }
}

}  // namespace
}  // namespace probewright::testing_support
