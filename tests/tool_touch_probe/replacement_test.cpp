#include <gmock/gmock.h>

#include "tool_touch_probe/tool_worlds.hpp"

/// Locked tools and their replacement tools: columns TL and RT of TOOL.T.
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;

/// Tools 12, 13 and 14 are mills of 80, 81 and 82 mm; `entries` are TL and RT of each.
struct Replacing {
  using Entries = std::vector<std::pair<std::string, std::string>>;
  Replacing(ControlKind kind, const std::array<Entries, 3>& entries) : world(kind), folder(world.bench) {
    world.disc(40);
    auto table = control::heidenhain::defaultToolTable(kind);
    for (int i = 0; i < 3; ++i) {
      const int number = 12 + i;
      simulation::TrueTool mill;
      mill.length = 80 + i;
      mill.radius = 8;
      world.add(mill, number, mill.length, mill.radius);
      world.bench.setup.world.truth.tools.back().name = world.bench.setup.beliefs.tools.back().name = "";
      const std::string row = std::to_string(number);
      EXPECT_TRUE(table.ensureRow(row));
      EXPECT_TRUE(table.setNumber(row, "L", mill.length));
      EXPECT_TRUE(table.setNumber(row, "R", mill.radius));
      for (const auto& [column, text] : entries[static_cast<std::size_t>(i)])
        EXPECT_TRUE(table.setText(row, control::heidenhain::Column::named(column), text)) << column;
    }
    folder.put("TOOL.T", table);
  }

  ToolWorld world;
  TableFolder folder;
};

constexpr ControlKind kinds[] = {ControlKind::TNC640, ControlKind::iTNC530};
const std::string which = "FN 18: SYSREAD Q1 = ID20 NR1\n";

TEST(ReplacementTools, AreCalledInsteadOfLockedOnes) {
  for (const ControlKind kind : kinds) {
    const Replacing one(kind, {{{{"TL", "L"}, {"RT", "13"}}, {}, {}}});
    const Ran ran = one.world.run(which + probe(481, {{340, 1}, {260, 60}, {341, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.q(1), 13);
    EXPECT_NEAR(ran.q(115), 0, 0.0051) << "it is in the spindle, too";
    EXPECT_TRUE(std::ranges::any_of(ran.outcome.journal.events, [](const control::EventRecord& event) {
      return event.text == "Tool 12 is locked; tool 13 replaces it (column RT)";
    }));

    const Replacing two(kind, {{{{"TL", "L"}, {"RT", "13"}}, {{"TL", "L"}, {"RT", "14"}}, {}}});
    EXPECT_EQ(two.world.run(which).q(1), 14);
    const Replacing free(kind, {{{{"RT", "13"}}, {}, {}}});
    EXPECT_EQ(free.world.run(which).q(1), 12);
  }
}

TEST(ReplacementTools, ThatAreNoneStopTheProgram) {
  for (const ControlKind kind : kinds) {
    const auto alarm = [&](const std::array<Replacing::Entries, 3>& entries) {
      return Replacing(kind, entries).world.run(which).why();
    };
    EXPECT_THAT(alarm({{{{"TL", "L"}}, {}, {}}}), HasSubstr("has no replacement tool (RT)"));
    EXPECT_THAT(alarm({{{{"TL", "L"}, {"RT", "0"}}, {}, {}}}), HasSubstr("has no replacement tool (RT)"));
    EXPECT_THAT(alarm({{{{"TL", "L"}, {"RT", "77"}}, {}, {}}}), HasSubstr("TOOL.T has no tool 77"));
    EXPECT_THAT(alarm({{{{"TL", "L"}, {"RT", "13"}}, {{"TL", "L"}, {"RT", "12"}}, {}}}),
                HasSubstr("all of its replacement tools (RT) are locked"));
  }
}

/// A check locks a worn tool; the next call brings its replacement.
TEST(ReplacementTools, FollowACheckThatLocks) {
  for (const ControlKind kind : kinds) {
    Replacing worn(kind, {{{{"LTOL", "0.05"}, {"RT", "14"}}, {}, {}}});
    worn.world.bench.setup.world.truth.tools[worn.world.bench.setup.world.truth.tools.size() - 3].length = 79.8;
    const Ran ran = worn.world.run(toolCycle(481, 1, false, false) + "TOOL CALL 12 Z\n" + which);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.q(199), 1);
    EXPECT_EQ(ran.q(1), 14);
  }
}

}  // namespace
}  // namespace probewright::testing_support
