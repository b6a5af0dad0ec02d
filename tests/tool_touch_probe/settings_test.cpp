#include <gmock/gmock.h>

#include "cycles/heidenhain/tool_measurement.hpp"
#include "tool_touch_probe/tool_worlds.hpp"

/// What the machine parameters CfgTT of the TNC 640 and MP6500 of the iTNC 530 change about cycles 480 to 484 and 30
/// to 33.
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;

constexpr ControlKind kinds[] = {ControlKind::TNC640, ControlKind::iTNC530};

/// MP6500 as long as nobody sets it: enabled, no stops.
constexpr int usual = 1 | 32 | 64;

/// A mill that is 0.1 mm longer and 0.3 mm thicker than TOOL.T says.
struct Set {
  explicit Set(ControlKind kind, const std::vector<std::pair<std::string, std::string>>& entries = {})
      : world(kind), folder(world.bench) {
    world.disc(40);
    simulation::TrueTool mill;
    mill.length = 80.1;
    mill.radius = 8.3;
    mill.cutter.teeth.resize(1);
    world.add(mill, 12, 80, 8);
    world.parameter("measureTolerance1", "MP6510", 0.001);
    enter(folder, world, entries);
  }
  std::string alarm(const std::string& blocks) const { return world.run(blocks).alarm(); }

  ToolWorld world;
  TableFolder folder;
};

const std::string length = toolCycle(481, 0, false, false), radius = toolCycle(482, 0, false, false);

TEST(ToolSettings, SwitchTheCyclesOff) {
  Set off(ControlKind::iTNC530);
  off.world.parameter("", "MP6500", usual - 1);
  for (const std::string& cycle : {length, radius, toolCycle(483, 1, false, true), probe(480, {{260, 60}})})
    EXPECT_EQ(off.alarm(cycle), "Function not enabled");
  off.world.parameter("", "MP6500", usual);
  EXPECT_EQ(off.alarm(length), "");
}

TEST(ToolSettings, LetLengthsAloneBeMeasuredWithAStationaryTool) {
  for (const ControlKind kind : kinds) {
    Set standing(kind, {{"CUT", "1"}, {"R-OFFS", "8"}});
    standing.world.parameter("probingCapability", "MP6500", kind == ControlKind::TNC640 ? 1 : usual + 2);
    EXPECT_EQ(standing.alarm(radius), "Function not enabled");
    EXPECT_EQ(standing.alarm(toolCycle(481, 0, true, false)), "Function not enabled");
    EXPECT_EQ(standing.alarm(length), "");
    // A round tool stands anyway; the TNC 640 locks all radii.
    enter(standing.folder, standing.world, {{"CUT", "0"}});
    EXPECT_EQ(standing.alarm(radius), kind == ControlKind::TNC640 ? "Function not enabled" : "");
  }
  Set teeth(ControlKind::iTNC530, {{"CUT", "1"}, {"R-OFFS", "0"}});
  teeth.world.parameter("", "MP6500", usual + 8);
  EXPECT_EQ(teeth.alarm(toolCycle(482, 0, true, false)), "Function not enabled");
  EXPECT_EQ(teeth.alarm(radius), "");
  EXPECT_EQ(teeth.alarm(length), "");
  teeth.world.parameter("", "MP6500", usual + 4);
  EXPECT_EQ(teeth.alarm(length), "Function not enabled") << "R-OFFS is 0";
}

/// The tool travels its clearance of 5 mm at the feed that belongs to the speed.
TEST(ToolSettings, TurnTheToolAtTheLowestSpeedOfTheSpindle) {
  for (const ControlKind kind : kinds) {
    Set slow(kind);
    slow.world.parameter("lowestSpindleSpeed", "lowestSpindleSpeed", 100);
    const auto seconds = [&] {
      const Ran ran = slow.world.run(radius);
      EXPECT_TRUE(ran.finished()) << ran.why();
      return ran.cycle().endSeconds - ran.cycle().startSeconds;
    };
    const double usually = seconds();
    slow.world.parameter("spindleSpeedCalc", "MP6500", kind == ControlKind::TNC640 ? 1 : usual + 16);
    const double travel = 5 - 0.3, automatic = 0.001 * 30 / (8 * 0.0063), lowest = 0.001 * 100;
    EXPECT_NEAR(seconds() - usually, 60 * travel * (1 / lowest - 1 / automatic), 10);
  }
}

TEST(ToolSettings, TouchARotatingToolASecondTimeMoreSlowly) {
  Set twice(ControlKind::TNC640);
  twice.world.parameter("measureTolerance1", "", 0.5);
  EXPECT_EQ(twice.world.run(radius).cycle().touches.size(), 1U);
  twice.world.parameter("measureTolerance2", "", 0.001);
  const Ran ran = twice.world.run(toolCycle(483, 0, false, false));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.cycle().touches.size(), 4U);
  EXPECT_NEAR(ran.cell("TOOL.T", "12", "R"), 8.3, 0.0011);
  EXPECT_NEAR(ran.cell("TOOL.T", "12", "L"), 80.1, 0.0011);
  // Nothing turns where the tool stands.
  enter(twice.folder, twice.world, {{"R-OFFS", "0"}});
  EXPECT_EQ(twice.world.run(length).cycle().touches.size(), 1U);
}

TEST(ToolSettings, SayWhatIsEnteredInTheToolTable) {
  struct Case {
    int adapt, bits, mode;
    bool enters;
  };
  for (const Case& each : {Case{0, usual + 2048, 1, false}, Case{0, usual + 2048, 0, true}, Case{1, usual, 1, true},
                           Case{2, 0, 0, false}, Case{2, 0, 1, false}}) {
    for (const ControlKind kind : kinds) {
      if (kind == ControlKind::iTNC530 && each.bits == 0) continue;
      SCOPED_TRACE(fmt::format("{} {} {}", control::name(kind), each.adapt, each.mode));
      Set set(kind, {{"LTOL", "0.05"}});
      set.world.parameter("adaptToolTable", "MP6500", kind == ControlKind::TNC640 ? each.adapt : each.bits);
      const Ran ran = set.world.run(toolCycle(481, each.mode, false, false));
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_NEAR(ran.cell("TOOL.T", "12", "L"), each.mode == 0 && each.enters ? 80.1 : 80, 0.0011);
      EXPECT_NEAR(ran.cell("TOOL.T", "12", "DL"), each.mode == 1 && each.enters ? 0.1 : 0, 0.0011);
      if (each.mode == 1) {
        EXPECT_NEAR(ran.q(115), 0.1, 0.0011);
      }
      EXPECT_EQ(ran.table("TOOL.T").text("12", "TL"), each.mode == 1 ? "L" : "") << "a worn tool is locked anyway";
    }
  }
}

TEST(ToolSettings, StopTheProgramAtBrokenTools) {
  for (const ControlKind kind : kinds) {
    const bool newer = kind == ControlKind::TNC640;
    Set set(kind, {{"RTOL", "0.05"}, {"RBREAK", "0.2"}});
    const std::string check = toolCycle(482, 1, false, false);
    EXPECT_EQ(set.alarm(check), newer ? "Tool breakage" : "");
    EXPECT_EQ(set.alarm(radius), "");
    set.world.parameter("stopOnCheck", "MP6500", newer ? 0 : usual - 32);
    EXPECT_EQ(set.alarm(check), newer ? "" : "Tool breakage");
    set.world.parameter("stopOnMeasurement", "MP6500", newer ? 1 : usual - 64);
    const Ran ran = set.world.run(radius);
    EXPECT_EQ(ran.alarm(), "Tool breakage");
    EXPECT_THAT(ran.why(), HasSubstr("differs from what TOOL.T said"));
    EXPECT_NEAR(ran.cell("TOOL.T", "12", "R"), 8.3, 0.0011) << "it is entered before";
    EXPECT_EQ(ran.table("TOOL.T").text("12", "TL"), "");
  }
}

TEST(ToolSettings, RefuseATiltedPlaneWhereTheyAreToldTo) {
  ToolWorld world(ControlKind::iTNC530);
  world.bench = Bench(ControlKind::iTNC530, "mill5-head-head");
  world.bench.preset(1, {0, 0, -420});
  world.disc(40);
  simulation::TrueTool mill;
  mill.length = 80;
  mill.radius = 8;
  world.add(mill, 12, 80, 8);
  const std::string tilted = "L Z+0 R0 FMAX M91\nPLANE SPATIAL SPA+0 SPB+0 SPC+20 TURN FMAX\n" + length;
  EXPECT_NE(world.run(tilted).alarm(), "Tilted working plane not permitted");
  world.parameter("", "MP6500", usual + 8192);
  EXPECT_EQ(world.run(tilted).alarm(), "Tilted working plane not permitted");
  EXPECT_EQ(world.run(length).alarm(), "");
}

}  // namespace
}  // namespace probewright::testing_support
