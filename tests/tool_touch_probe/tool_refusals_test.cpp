#include <gmock/gmock.h>

#include "tool_touch_probe/tool_worlds.hpp"

/// What cycles 480 to 484 and 30 to 33 refuse, and what stops them.
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;

constexpr ControlKind kinds[] = {ControlKind::TNC640, ControlKind::iTNC530};

/// A mill of two teeth that the control knows as it is.
struct Refusing {
  explicit Refusing(ControlKind kind = ControlKind::TNC640) : world(kind), folder(world.bench) {
    world.disc(40);
    simulation::TrueTool mill;
    mill.length = 80;
    mill.radius = 8;
    mill.cutter.teeth.resize(2);
    mill.cutter.teeth[1].angle = 180;
    world.add(mill, 12, 80, 8);
  }
  void entries(const std::vector<std::pair<std::string, std::string>>& texts) { enter(folder, world, texts); }
  std::string alarm(const std::string& blocks) const { return world.run(blocks).alarm(); }

  ToolWorld world;
  TableFolder folder;
};

const std::string all[] = {toolCycle(481, 0, false, false), toolCycle(482, 0, false, false),
                           toolCycle(483, 0, false, false), toolCycle(481, 0, false, true),
                           toolCycle(482, 0, false, true),  toolCycle(483, 0, false, true),
                           probe(480, {{260, 60}}),         "TCH PROBE 30.0 TT\nTCH PROBE 30.1 HEIGHT: +60\n"};

TEST(ToolRefusals, OfToolsThatAreNone) {
  for (const ControlKind kind : kinds) {
    for (const std::string& cycle : all) {
      SCOPED_TRACE(cycle);
      const Refusing refusing(kind);
      EXPECT_EQ(refusing.world.bare(cycle).alarm(), "Touch probe axis not defined");
      EXPECT_EQ(refusing.world.run(cycle, 1).alarm(),
                kind == ControlKind::TNC640 ? "Tool type not permitted" : "Touch probe not ready");
    }
  }
  Refusing turning;
  turning.entries({{"TYP", "TURN"}});
  const Ran ran = turning.world.run(all[0]);
  EXPECT_EQ(ran.alarm(), "Tool type not permitted");
  EXPECT_THAT(ran.why(), HasSubstr("cycle 485"));
  for (const char* type : {"GRIND", "DRESS"}) {
    for (const std::string& cycle : all) {
      Refusing other;
      other.entries({{"TYP", type}});
      EXPECT_EQ(other.alarm(cycle), "Tool type not permitted") << type << cycle;
    }
  }
}

TEST(ToolRefusals, OfToolsWithoutWhatIsNeeded) {
  for (const ControlKind kind : kinds) {
    Refusing refusing(kind);
    const int most = kind == ControlKind::TNC640 ? 20 : 99;
    for (const int teeth : {0, most + 1}) {
      refusing.entries({{"CUT", fmt::format("{}", teeth)}});
      for (const int number : {481, 482, 483})
        EXPECT_EQ(refusing.alarm(toolCycle(number, 0, true, teeth == 0)), "Number of teeth not permitted") << number;
    }
    refusing.entries({{"R", "+0"}});
    EXPECT_EQ(refusing.alarm(toolCycle(482, 0, false, false)), "Tool radius not defined");
    EXPECT_EQ(refusing.alarm(all[6]), "Calibrating tool not defined");
    EXPECT_EQ(refusing.alarm(all[7]), "Calibrating tool not defined");
    EXPECT_EQ(refusing.alarm("TCH PROBE 484 TT\n"), "Calibrating tool not defined");
  }
}

TEST(ToolRefusals, OfMachinesThatAreNotReady) {
  for (const ControlKind kind : kinds) {
    Refusing nowhere(kind);
    nowhere.world.bench.setup.world.truth.toolProbes.clear();
    nowhere.world.bench.setup.world.truth.solids.clear();
    EXPECT_EQ(nowhere.alarm(all[0]), "Tool touch probe not calibrated");
    EXPECT_EQ(nowhere.alarm(all[6]), "Tool touch probe not defined");
    nowhere.world.parameter("centerPos.0", "MP6580.0", 100);
    nowhere.world.parameter("centerPos.2", "MP6580.2", -470);
    EXPECT_EQ(nowhere.alarm(all[6]), "Touch probe not ready");

    for (const char* neverMeasured : {"calibratedContactRadius1", "calibratedContactRadius2"}) {
      Refusing half(kind);
      half.world.parameter(neverMeasured, neverMeasured, 0);
      EXPECT_EQ(half.alarm(all[0]), "Tool touch probe not calibrated") << neverMeasured;
    }

    Refusing off(kind);
    off.world.toolProbe().switchedOn = false;
    EXPECT_EQ(off.alarm(all[0]), "Touch probe not ready");

    Refusing far(kind);
    far.world.parameter("calibratedContactZ", "calibratedContactZ", far.world.contact.z() + 40);
    EXPECT_EQ(far.alarm(all[0]), "Touch point inaccessible");
  }
  Refusing lengthsOnly;
  lengthsOnly.world.parameter("probingCapability", "", 1);
  EXPECT_EQ(lengthsOnly.alarm(all[1]), "Function not enabled");
  EXPECT_EQ(lengthsOnly.alarm(all[0]), "");
}

/// The contact faces Z: along another axis the tool would run into it.
TEST(ToolRefusals, OfToolAxesBesideZ) {
  for (const ControlKind kind : kinds) {
    for (const std::string& cycle : all) {
      for (const char* call : {"TOOL CALL 12 X\n", "TOOL CALL 12 Y\n"}) {
        const Refusing refusing(kind);
        EXPECT_EQ(refusing.world.bare(call + cycle).alarm(), "Tool axis not permitted") << call << cycle;
      }
    }
  }
}

TEST(ToolRefusals, OfModesAndTransformations) {
  for (const std::string& cycle : all) {
    SCOPED_TRACE(cycle);
    const Refusing refusing;
    EXPECT_EQ(refusing.alarm("FUNCTION MODE TURN\n" + cycle), "Function not permitted");
    for (const char* grinding : {"FUNCTION MODE GRIND\n", "FUNCTION MODE DRESS\n", "FUNCTION DRESS BEGIN\n"})
      EXPECT_EQ(refusing.alarm(grinding + cycle), "Function not permitted") << grinding;
    EXPECT_EQ(refusing.alarm("FUNCTION DRESS BEGIN\nFUNCTION DRESS END\n" + cycle), "");
    EXPECT_EQ(refusing.alarm("FUNCTION MODE GRIND\nFUNCTION MODE MILL\n" + cycle), "");
    EXPECT_EQ(refusing.alarm("CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\n" + cycle),
              "Coordinate transformation not permitted");
    EXPECT_EQ(refusing.alarm("CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 X+5\n" + cycle), "");
  }
}

/// DIRECT says how the tool cuts; measured the other way round it would cut into the contact.
TEST(ToolRefusals, TheWrongDirectionOfCuttingDamagesTheContact) {
  for (const ControlKind kind : kinds) {
    Refusing refusing(kind);
    refusing.entries({{"DIRECT", "+"}});
    const Ran ran = refusing.world.run(all[1]);
    EXPECT_EQ(ran.alarm(), "Collision");
    EXPECT_THAT(ran.why(), HasSubstr("cutting direction"));
    refusing.world.bench.setup.world.truth.tools.back().cutter.cutting = machine::Rotation::CounterClockwise;
    EXPECT_EQ(refusing.alarm(all[1]), "");
    refusing.entries({{"DIRECT", "-"}});
    EXPECT_EQ(refusing.alarm(all[1]), "Collision");
    refusing.world.bench.setup.world.truth.tools.back().cutter.teeth.clear();
    EXPECT_EQ(refusing.alarm(all[1]), "") << "a round body does not cut";
  }
}

TEST(ToolRefusals, SingleTeethNeedASpindleThatStandsWhereItIsTold) {
  Refusing refusing;
  refusing.entries({{"CUT", "2"}});
  refusing.world.bench.setup.world.truth.machine.spindleOrients = false;
  EXPECT_EQ(refusing.alarm(toolCycle(482, 0, true, false)), "Spindle orientation not possible");
  EXPECT_EQ(refusing.alarm(toolCycle(482, 0, false, false)), "");
}

/// The clearance height is raised to the safety zone above the contact.
TEST(ToolRefusals, NoClearanceHeightIsTooLow) {
  for (const ControlKind kind : kinds) {
    const Refusing refusing(kind);
    const Ran ran = refusing.world.run(probe(483, {{340, 1}, {260, -80}, {341, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(115), 0, 0.0051);
  }
}

TEST(ToolRefusals, AnOldStatusParameterMayBeLeftOut) {
  const Refusing refusing;
  const Ran ran = refusing.world.run(
      "TCH PROBE 31.0 T\nTCH PROBE 31.1 CHECK: 1\nTCH PROBE 31.2 HEIGHT: +60\nTCH PROBE 31.3 PROBING THE TEETH: 0\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.q(199), 0);
  EXPECT_NEAR(ran.q(115), 0, 0.0051);
}

}  // namespace
}  // namespace probewright::testing_support
