#include <gmock/gmock.h>

#include <cmath>

#include "truth/told.hpp"

/// How near the moves of a program came to what stands on the table, against what was planted.
namespace probewright::truth::testing {
namespace {

setup::MachineOptions asking() {
  setup::MachineOptions options;
  options.clearance = true;
  return options;
}

const records::ClearanceSpan& nearest(const Told& told) {
  return *std::ranges::min_element(told.truth().clearance->spans, {}, &records::ClearanceSpan::distance);
}

/// The flat end of a mill and the ball of a probe, at distances of which some lie between the steps of the search.
TEST(ClearanceOfTools, IsThatOfTheirLowestPoint) {
  World world = worldWith(plate("{ z = -480 }"));
  world.more =
      "[[tool]]\nnumber = 2\nname = \"MILL\"\nkind = \"mill\"\nlength = 100\nradius = 8\n[tool.cutter]\n"
      "cutting_length = 30\n";
  for (const int tool : {1, 2}) {
    for (const double height : {5.0, 11.5, 18.5, 19.5}) {
      const Told told =
          run(world,
              fmt::format("TOOL CALL {} Z\nL Z+60 R0 FMAX\nL X-100 Y+20 FMAX\nL Z+{} FMAX\nL X+100 F2000\n"
                          "L Z+60 FMAX\n",
                          tool, height),
              asking());
      ASSERT_TRUE(told.finished()) << told.why();
      const records::ClearanceSpan& span = nearest(told);
      EXPECT_FALSE(span.orMore) << tool << " at " << height;
      EXPECT_NEAR(span.distance, height, 0.06) << tool << " at " << height;
      EXPECT_LE(span.distance, height + 1e-6) << tool << " at " << height;
      EXPECT_EQ(span.part, tool == 1 ? "ball" : "tool");
    }
  }
}

/// Moves that come near nothing are one span, as long as they belong to the same cycle or to none; those of a cycle
/// are told as its own to the last, and a tool change is not watched.
TEST(ClearanceSpans, AreOneWhereNothingIsNear) {
  World world = worldWith(plate("{ z = -480 }"));
  world.more = "[[tool]]\nnumber = 2\nname = \"MILL\"\nkind = \"mill\"\nlength = 100\nradius = 8\n";
  // Down beside the plate, from where the tool is changed.
  const Told changed = run(world, "TOOL CALL 1 Z\nL X-50 R0 FMAX\nL Z-8 FMAX\nTOOL CALL 2 Z\n", asking());
  ASSERT_TRUE(changed.finished()) << changed.why();
  ASSERT_EQ(changed.truth().clearance->spans.size(), 2U);
  EXPECT_NEAR(changed.truth().clearance->spans.back().distance, 7, 0.06);
  const Told far = run(world, "TOOL CALL 1 Z\nL Z+60 R0 FMAX\nL X-80 FMAX\nL Y+20 FMAX\nL X+0 FMAX\n", asking());
  ASSERT_TRUE(far.finished()) << far.why();
  ASSERT_EQ(far.truth().clearance->spans.size(), 1U);
  EXPECT_TRUE(far.truth().clearance->spans.front().orMore);
  EXPECT_FALSE(far.truth().clearance->spans.front().cycle);

  const Told cycle = run(
      world,
      "TOOL CALL 1 Z\nL Z+60 R0 FMAX\nL X+50 Y-50 FMAX\nTCH PROBE 427 COORDINATE ~\nQ263=+0 ~\nQ264=-30 ~\nQ261=-8 ~\n"
      "Q320=+2 ~\nQ272=+2 ~\nQ267=+1 ~\nQ260=+60 ~\nQ281=+0 ~\nQ288=+99 ~\nQ289=-99 ~\nQ309=+0 ~\nQ330=+0\n"
      "L X+50 FMAX\n",
      asking());
  ASSERT_TRUE(cycle.finished()) << cycle.why();
  const double begin = cycle.outcome.journal.cycles.front().startSeconds,
               end = cycle.outcome.journal.cycles.front().endSeconds;
  std::size_t own = 0;
  for (const records::ClearanceSpan& span : cycle.truth().clearance->spans) {
    const bool within = span.from >= begin - 1e-6 && span.to <= end + 1e-6;
    EXPECT_EQ(span.cycle.has_value(), within) << span.from << " to " << span.to << " s";
    own += within ? 1 : 0;
  }
  EXPECT_GE(own, 3U);
  EXPECT_NEAR(cycle.truth().clearance->spans.back().from, end, 1e-6);
}

/// While it measures, a probe comes as near as its ball touches; its body comes to 3 mm in front of a wall that hangs
/// over, which counts.
TEST(ClearanceOfMeasuring, CountsTheBodyNotTheStylus) {
  World world = worldWith(plate("{ z = -480 }"));
  world.probe = "stylus_length = 50\nbody_radius = 25\nbody_length = 90\n";
  // The ball touches with its centre at Y-33, where the body reaches to Y-8.
  world.more =
      "[[fixture]]\nname = \"gantry\"\npose = { x = 0, y = 15, z = -420 }\n[[fixture.feature]]\nshape = \"box\"\n"
      "size = [200, 40, 40]\n";
  const Told told = run(world,
                        "TOOL CALL 1 Z\nL Z+300 R0 FMAX\nL X+0 Y-120 FMAX\nL Z-8 FMAX\nTCH PROBE 427 COORDINATE ~\n"
                        "Q263=+0 ~\nQ264=-30 ~\nQ261=-8 ~\nQ320=+2 ~\nQ272=+2 ~\nQ267=+1 ~\nQ260=-8 ~\nQ281=+0 ~\n"
                        "Q288=+99 ~\nQ289=-99 ~\nQ309=+0 ~\nQ330=+0\nL Y-120 FMAX\nL Z+300 FMAX\n",
                        asking());
  ASSERT_TRUE(told.finished()) << told.why();
  const records::ClearanceSpan& span = nearest(told);
  EXPECT_EQ(span.part, "body");
  EXPECT_EQ(span.solid, "gantry");
  EXPECT_NEAR(span.distance, 3, 0.06);
}

/// On lathes the tool touch probe stands on the bed beside what turns; the part counts.
TEST(ClearanceOnLathes, IsThatOfThePart) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, 180};
  world.part = "[part]\nname = \"shaft\"\n[[part.feature]]\nshape = \"cylinder\"\ndiameter = 28\nheight = 180\n";
  world.probe = "stylus_length = 60\nbody_radius = 20\nshank_direction = [0, 0, 1]\n";
  world.more = "[machine]\nname = \"lathe2c\"\n";
  const Told told =
      run(world, "T=\"PROBE\" D1\nG54 G18 G90 G95 DIAMON\nG0 X140 Z50\nG0 X44\nG0 Z-12\nG0 X140\n", asking());
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_EQ(nearest(told).solid, "shaft");
  EXPECT_FALSE(nearest(told).orMore);
}

/// A tool change goes to an end of the travel on purpose.
TEST(Travel, DoesNotCountToolChanges) {
  World world = worldWith(plate("{ z = -480 }"));
  world.more =
      "[machine]\nclearance = 1000\n[[tool]]\nnumber = 2\nname = \"MILL\"\nkind = \"mill\"\nlength = 100\nradius = 8\n";
  session::RunOptions traced;
  traced.trace = true;
  const Told told = run(world, "TOOL CALL 1 Z\nL X+100 R0 FMAX\nTOOL CALL 2 Z\n", {}, traced);
  ASSERT_TRUE(told.finished()) << told.why();
  ASSERT_EQ(told.truth().nearEnds.size(), 1U);
  EXPECT_EQ(told.truth().nearEnds.front().axis, "X");
  EXPECT_EQ(told.truth().nearEnds.front().place->line, 3U);
}

}  // namespace
}  // namespace probewright::truth::testing
