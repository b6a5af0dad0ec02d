#include <gmock/gmock.h>

#include "tool_touch_probe/tool_worlds.hpp"

/// What the manuals say of cycles 480 to 484 beside their results: heights, paths, displays, values of GLOBAL DEF.
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr ControlKind kinds[] = {ControlKind::TNC640, ControlKind::iTNC530};

/// A mill of `teeth` that the control knows as it is.
struct Detail {
  explicit Detail(ControlKind kind, int teeth = 1, double radius = 8) : world(kind), folder(world.bench) {
    world.disc(40);
    simulation::TrueTool mill;
    mill.length = 80;
    mill.radius = radius;
    for (int i = 0; i < teeth; ++i)
      mill.cutter.teeth.push_back({.angle = 360.0 * i / teeth, .axial = -0.001 * i});
    world.add(mill, 12, 80, radius);
    enter(folder, world, {{"CUT", fmt::format("{}", teeth)}});
  }
  ToolWorld world;
  TableFolder folder;
};

TEST(ToolDetails, TheDisplayOfTheOlderControlHasRoomFor24Teeth) {
  for (const auto& [kind, teeth] : {std::pair(ControlKind::iTNC530, 30), std::pair(ControlKind::TNC640, 20)}) {
    const Detail detail(kind, teeth, 30);
    const Ran ran = detail.world.run(toolCycle(482, 0, true, false));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.touches(), 1U + static_cast<std::size_t>(teeth)) << "each is measured";
    EXPECT_EQ(shownTeeth(ran.cycle(), "RADIUS").size(), kind == ControlKind::iTNC530 ? 24U : 20U);
  }
}

/// Single teeth are measured without a tool table: CUT comes from the setup. A round tool has no entry, as 0 means a
/// standing spindle.
TEST(ToolDetails, TheSetupTellsTheNumberOfTeeth) {
  for (const ControlKind kind : kinds) {
    for (const int teeth : {0, 1, 3, 20}) {
      ToolWorld world(kind);
      world.disc(40);
      simulation::TrueTool mill;
      mill.length = 80;
      mill.radius = 12;
      for (int i = 0; i < teeth; ++i)
        mill.cutter.teeth.push_back({.angle = 360.0 * i / teeth, .axial = -0.001 * i});
      world.add(mill, 12, 80, 12);
      for (auto& tool : world.bench.setup.beliefs.tools)
        if (tool.number == 12) setup::believeAsCalibrated(tool, world.bench.setup.world.truth.tools.back());
      const Ran whole = world.run(toolCycle(482, 0, false, false));
      EXPECT_TRUE(whole.finished()) << whole.why();
      const Ran ran = world.run(toolCycle(482, 0, true, false));
      EXPECT_EQ(ran.finished(), teeth > 0) << teeth << ran.why();
      if (teeth == 0) continue;
      EXPECT_EQ(ran.touches(), 1U + static_cast<std::size_t>(teeth));
    }
  }
}

/// Q260 of GLOBAL DEF 120.
TEST(ToolDetails, TheClearanceHeightMayComeFromGlobalDef) {
  for (const ControlKind kind : kinds) {
    const Detail detail(kind);
    const std::string global = "GLOBAL DEF 120 PROBING ~\n  Q320=+0 ;S ~\n  Q260=+75 ;H ~\n  Q301=+1 ;T\n";
    std::string cycle = toolCycle(481, 1, false, false);
    const std::string written = "Q260=+60.000000";
    cycle.replace(cycle.find(written), written.size(), "Q260=PREDEF");
    const Ran ran = detail.world.run(global + cycle);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(115), 0, 0.0051);
    // It ends there: 75 mm above the preset, the tool's length below the spindle.
    ASSERT_TRUE(ran.machine);
    EXPECT_NEAR(ran.machine->position()[2], -420 + 75 + 80, 1e-6);
  }
}

/// Without its parameter 484 stops; that parameter is one of the TNC 640.
TEST(ToolDetails, Cycle484KnowsItsParameterOnTheNewerControlOnly) {
  Detail newer(ControlKind::TNC640), older(ControlKind::iTNC530);
  EXPECT_THAT(newer.world.run("TCH PROBE 484 CALIBRATE\n").screens(),
              testing::Contains(HasSubstr("Position the calibrating tool")));
  const Ran refused = older.world.run(probe(484, {{536, 1}}));
  EXPECT_EQ(refused.outcome.info.exit, records::ExitState::InputMistake);
  EXPECT_THAT(refused.why(), HasSubstr("Q536"));
}

/// Each parameter of the old forms beyond its range, or left out; before anything moves.
TEST(ToolDetails, OldFormsRefuseValuesBeyondTheirRanges) {
  for (const ControlKind kind : kinds) {
    const Detail detail(kind);
    const auto refused = [&](const std::string& cycle, const std::string& part) {
      const Ran ran = detail.world.run(cycle);
      EXPECT_EQ(ran.outcome.info.exit, records::ExitState::InputMistake) << cycle;
      EXPECT_THAT(ran.why(), HasSubstr(part)) << cycle;
    };
    refused("TCH PROBE 30.0 TT\nTCH PROBE 30.1 HEIGHT: +100000\n", "HEIGHT");
    refused("TCH PROBE 30.0 TT\nTCH PROBE 30.1 HEIGHT: -100000\n", "HEIGHT");
    for (const int number : {31, 32, 33}) {
      const auto cycle = [number](const std::string& check, const std::string& height, const std::string& teeth) {
        return fmt::format(
            "TCH PROBE {0}.0 TOOL\nTCH PROBE {0}.1 CHECK: {1}\nTCH PROBE {0}.2 HEIGHT: {2}\n"
            "TCH PROBE {0}.3 PROBING THE TEETH: {3}\n",
            number, check, height, teeth);
      };
      EXPECT_EQ(detail.world.run(cycle("1 Q5", "+60", "0")).why(), "");
      refused(cycle("3", "+60", "0"), "CHECK");
      refused(cycle("-1", "+60", "0"), "CHECK");
      refused(cycle("0.5", "+60", "0"), "CHECK");
      refused(cycle("0 Q2000", "+60", "0"), "Q");
      refused(cycle("0", "+100000", "0"), "HEIGHT");
      refused(cycle("0", "+60", "2"), "TEETH");
      refused(fmt::format("TCH PROBE {0}.0 TOOL\nTCH PROBE {0}.1 CHECK: 0\nTCH PROBE {0}.2 HEIGHT: +60\n", number), "");
    }
  }
}

/// The first way leads up or down to the clearance height, all others stay at or above it but beside the contact.
TEST(ToolDetails, ToolsTravelAtTheClearanceHeight) {
  for (const ControlKind kind : kinds) {
    const Detail detail(kind);
    const Ran ran = detail.world.run(toolCycle(483, 0, false, false));
    ASSERT_TRUE(ran.finished()) << ran.why();
    ASSERT_TRUE(ran.machine);
    EXPECT_NEAR(ran.machine->position()[2], -420 + 60 + 80, 1e-6) << "back to the clearance height";
    EXPECT_EQ(ran.outcome.journal.cycles.size(), 1U);
    EXPECT_EQ(ran.machine->spindle().rotation, machine::Rotation::None) << "the spindle stands";
  }
}

/// Lengths come first where a TNC 640 turns the tool, radii first otherwise.
TEST(ToolDetails, TheOrderOf483DependsOnTheControlAndTheTeeth) {
  for (const ControlKind kind : kinds) {
    for (const bool teeth : {false, true}) {
      const Detail detail(kind);
      const Ran ran = detail.world.run(toolCycle(483, 0, teeth, false));
      ASSERT_TRUE(ran.finished()) << ran.why();
      const bool along = std::abs(ran.cycle().touches.front().direction.z()) > 0.5;
      EXPECT_EQ(along, kind == ControlKind::TNC640 && !teeth);
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
