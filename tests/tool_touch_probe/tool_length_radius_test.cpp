#include <gmock/gmock.h>

#include "cycles/heidenhain/tool_measurement.hpp"
#include "tool_touch_probe/tool_worlds.hpp"

/// Cycles 481 to 483 and 31 to 33: tools on the tool touch probe are found as they are planted.
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;

/// What a turning tool is found shorter and thinner by, at most: what it is fed in a turn.
double permitted(double tolerance, int kind, double radius) {
  return kind == 1 ? tolerance * std::ceil(radius / 30) : kind == 2 ? tolerance * radius / 5 : tolerance;
}

/// A random mill on a random tool touch probe, both known about right.
struct Planted {
  explicit Planted(int at, Dice& dice, bool even = false) : world(controlOf(at)) {
    world.contact = {written(dice.between(80, 160)), written(dice.between(-80, 0)), written(dice.between(-480, -460))};
    const double radius = dice.between(2, 35);
    mill = plantedMill(dice, radius, dice.whole(1, 6), even);
    world.add(mill, 12, written(mill.length + dice.between(-1, 1)), written(radius + dice.between(-0.3, 0.3)));
    if (dice.coin()) {
      world.disc(written(dice.between(20, 40)));
    } else {
      world.cuboid(written(dice.between(16, 30)), written(dice.between(16, 30)));
    }
    tolerance = written(dice.between(0.002, 0.02));
    kind = dice.whole(0, 2);
    world.parameter("measureTolerance1", "MP6510", tolerance);
    world.parameter("probingFeedCalc", "MP6507", kind);
    world.parameter("probingDirRadial", "MP6505", dice.whole(0, 3));
    world.parameter("maxPeriphSpeedMeas", "MP6570", written(dice.between(10, 100)));
    world.parameter("maxSpeed", "MP6572", 1000);
  }
  /// The control computes with the radius that it believes.
  double slack() const { return permitted(tolerance, kind, world.bench.setup.beliefs.tools.back().radius); }

  ToolWorld world;
  simulation::TrueTool mill;
  double tolerance = 0;
  int kind = 0;
};

TEST(ToolMeasurement, FindsTheLongestAndTheLargestToothOfATurningMill) {
  Dice dice(4820);
  for (int at = 0; at < 16; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Planted planted(at, dice);
    const bool old = at % 4 >= 2;
    const std::string cycles =
        at % 3 == 0 ? toolCycle(483, 0, false, old) : toolCycle(481, 0, false, old) + toolCycle(482, 0, false, old);
    const Ran ran = planted.world.run(cycles);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const double length = planted.mill.length + largest(planted.mill, &simulation::TrueTooth::axial);
    const double radius = planted.mill.radius + largest(planted.mill, &simulation::TrueTooth::radial);
    // TOOL.T keeps four decimals.
    constexpr double rounded = 5.1e-5;
    EXPECT_LE(ran.cell("TOOL.T", "12", "L"), length + rounded);
    EXPECT_GE(ran.cell("TOOL.T", "12", "L"), length - planted.slack() - rounded);
    EXPECT_LE(ran.cell("TOOL.T", "12", "R"), radius + rounded);
    EXPECT_GE(ran.cell("TOOL.T", "12", "R"), radius - planted.slack() - rounded);
    EXPECT_EQ(ran.cell("TOOL.T", "12", "DL"), 0);
    EXPECT_EQ(ran.cell("TOOL.T", "12", "DR"), 0);
    EXPECT_EQ(ran.q(old ? 5 : 199), 0);
  }
}

std::vector<double> sorted(std::vector<double> values) {
  std::ranges::sort(values);
  return values;
}

TEST(ToolMeasurement, FindsEachTooth) {
  Dice dice(4821);
  for (int at = 0; at < 20; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Planted planted(at, dice, true);
    planted.world.bench.setup.world.truth.tools.back().cutter.helix = 0;
    TableFolder folder(planted.world.bench);
    enter(folder, planted.world, {{"CUT", fmt::format("{}", planted.mill.cutter.teeth.size())}});
    const Ran ran =
        planted.world.run(at % 3 == 0 ? toolCycle(483, 0, true, at % 4 >= 2)
                                      : toolCycle(481, 0, true, at % 4 >= 2) + toolCycle(482, 0, true, at % 4 >= 2));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto& cycles = ran.outcome.journal.cycles;
    std::vector<double> lengths, radii;
    for (const auto& tooth : planted.mill.cutter.teeth) {
      lengths.push_back(written(planted.mill.length + tooth.axial, 4));
      radii.push_back(written(planted.mill.radius + tooth.radial, 4));
    }
    const auto lengthsShown = sorted(shownTeeth(cycles.front(), "LENGTH"));
    const auto radiiShown = sorted(shownTeeth(cycles.back(), "RADIUS"));
    lengths = sorted(lengths);
    radii = sorted(radii);
    EXPECT_THAT(lengthsShown, testing::Pointwise(testing::DoubleNear(1.1e-4), lengths));
    // The angle at which a tooth stands to be measured is known as well as the rotating tool was: within the feed of a
    // turn of its full reach.
    ASSERT_EQ(radiiShown.size(), radii.size());
    for (std::size_t i = 0; i < radii.size(); ++i) {
      EXPECT_LE(radiiShown[i], radii[i] + 1.1e-4);
      EXPECT_GE(radiiShown[i], radii[i] - planted.slack() - 1.1e-4);
    }
    EXPECT_NEAR(ran.cell("TOOL.T", "12", "L"), lengths.back(), 1.1e-4);
    EXPECT_NEAR(ran.cell("TOOL.T", "12", "R"), radiiShown.back(), 1.1e-4);
  }
}

/// A tooth is lowest where its corner begins, which R2 says; only there it is as long as it is.
TEST(ToolMeasurement, FindsTheLengthOfEachToothThatHasACorner) {
  Dice dice(4824);
  for (int at = 0; at < 12; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    ToolWorld world(controlOf(at));
    world.disc(40);
    const int teeth = 2 + at % 5;
    simulation::TrueTool mill = plantedMill(dice, dice.between(3, 12), teeth, true);
    mill.cutter.helix = 0;
    mill.cutter.cornerRadius = written(dice.between(0.1, 0.5) * mill.radius);
    world.add(mill, 12, written(mill.length + dice.between(-0.5, 0.5)), written(mill.radius));
    TableFolder folder(world.bench);
    enter(folder, world, {{"CUT", fmt::format("{}", teeth)}, {"R2", fmt::format("{:+.4f}", mill.cutter.cornerRadius)}});
    const Ran ran = world.run(toolCycle(481, 0, true, false));
    ASSERT_TRUE(ran.finished()) << ran.why();
    std::vector<double> lengths;
    for (const auto& tooth : mill.cutter.teeth)
      lengths.push_back(mill.length + tooth.axial);
    EXPECT_THAT(sorted(shownTeeth(ran.outcome.journal.cycles.front(), "LENGTH")),
                testing::Pointwise(testing::DoubleNear(6e-5), sorted(lengths)));
  }
}

/// A mill of one known tooth, checked against a table that is wrong by `wrong`.
struct Checked {
  Checked(ControlKind kind, double wrongLength, double wrongRadius, const std::string& wear,
          const std::string& breakage)
      : world(kind), folder(world.bench) {
    world.disc(40);
    simulation::TrueTool mill;
    mill.length = 80;
    mill.radius = 8;
    mill.cutter.teeth.resize(1);
    world.add(mill, 12, mill.length - wrongLength, mill.radius - wrongRadius);
    world.parameter("measureTolerance1", "MP6510", 0.001);
    enter(folder, world, {{"LTOL", wear}, {"RTOL", wear}, {"LBREAK", breakage}, {"RBREAK", breakage}, {"CUT", "1"}});
  }
  std::string locked(const Ran& ran) const { return ran.table("TOOL.T").text("12", "TL"); }

  ToolWorld world;
  TableFolder folder;
};

TEST(ToolMeasurement, ChecksAgainstTheTolerancesOfTheTable) {
  struct Case {
    double length, radius;
    int status;
  };
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const Case& each :
         {Case{0.02, -0.03, 0}, Case{-0.08, 0.01, 1}, Case{0.01, 0.09, 1}, Case{0.4, 0.01, 2}, Case{0.09, -0.5, 2}}) {
      for (const bool old : {false, true}) {
        SCOPED_TRACE(fmt::format("{} {} {} {}", control::name(kind), each.length, each.radius, old));
        Checked checked(kind, each.length, each.radius, "0.05", "0.2");
        checked.world.parameter("stopOnCheck", "", 0);
        const Ran ran = checked.world.run(toolCycle(483, 1, false, old));
        ASSERT_TRUE(ran.finished()) << ran.why();
        EXPECT_NEAR(ran.q(115), each.length, 0.0011);
        EXPECT_NEAR(ran.q(116), each.radius, 0.0011);
        EXPECT_NEAR(ran.cell("TOOL.T", "12", "DL"), each.length, 0.0011);
        EXPECT_NEAR(ran.cell("TOOL.T", "12", "DR"), each.radius, 0.0011);
        EXPECT_EQ(ran.cell("TOOL.T", "12", "L"), 80 - each.length);
        EXPECT_EQ(ran.cell("TOOL.T", "12", "R"), 8 - each.radius);
        EXPECT_EQ(ran.q(old ? 5 : 199), each.status);
        EXPECT_EQ(checked.locked(ran), each.status > 0 ? "L" : "");
      }
    }
  }
}

TEST(ToolMeasurement, StopsTheProgramWhereACheckFindsABrokenTool) {
  Checked broken(ControlKind::TNC640, -0.5, 0, "0.05", "0.2");
  const Ran stopped = broken.world.run(toolCycle(481, 1, false, false));
  EXPECT_EQ(stopped.alarm(), "Tool breakage");
  EXPECT_EQ(broken.locked(stopped), "L");
  EXPECT_EQ(stopped.q(199), 2);
  const Ran again = broken.world.run(toolCycle(481, 0, false, false) + "TOOL CALL 12 Z\n");
  EXPECT_TRUE(again.finished()) << again.why();
  broken.world.parameter("stopOnCheck", "", 0);
  const Ran later = broken.world.run(toolCycle(481, 1, false, false) + "TOOL CALL 12 Z\n");
  EXPECT_EQ(later.alarm(), "Tool locked") << "the program goes on until it calls the tool";
}

TEST(ToolMeasurement, ComparesWithoutWriting) {
  Checked checked(ControlKind::TNC640, 0.4, -0.3, "0.05", "0.2");
  const Ran ran = checked.world.run(toolCycle(483, 2, false, false));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(115), 0.4, 0.0011);
  EXPECT_NEAR(ran.q(116), -0.3, 0.0011);
  EXPECT_EQ(ran.q(199), 2);
  EXPECT_EQ(ran.cell("TOOL.T", "12", "DL"), 0);
  EXPECT_EQ(checked.locked(ran), "");
  Checked older(ControlKind::iTNC530, 0.4, -0.3, "0.05", "0.2");
  EXPECT_EQ(older.world.run(toolCycle(483, 2, false, false)).alarm(), "Cycle parameter wrong");
}

TEST(ToolMeasurement, FindsABrokenToothAmongOthers) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Checked checked(kind, 0, 0, "0.05", "0.2");
    auto& mill = checked.world.bench.setup.world.truth.tools.back();
    mill.cutter.teeth = {{.angle = 10}, {.angle = 130, .broken = 0.6}, {.angle = 250}};
    enter(checked.folder, checked.world, {{"CUT", "3"}, {"LTOL", "0.05"}, {"LBREAK", "0.2"}});
    checked.world.parameter("stopOnCheck", "", 0);
    const Ran whole = checked.world.run(toolCycle(481, 1, false, false));
    EXPECT_EQ(whole.q(199), 0) << "the longest tooth counts: " << whole.why();
    const Ran each = checked.world.run(toolCycle(481, 1, true, false));
    EXPECT_EQ(each.q(199), 2) << each.why();
    EXPECT_EQ(checked.locked(each), "L");
    EXPECT_THAT(each.cycle().screens.back(), HasSubstr("+79.4000 B"));
  }
}

/// A mill wider than the contact whose end has broken off touches with the face of the break.
TEST(ToolMeasurement, FindsAToolWhoseEndHasBrokenOff) {
  for (const char* offset : {"0", "14"}) {
    SCOPED_TRACE(offset);
    ToolWorld world;
    world.disc(12);
    simulation::TrueTool mill;
    mill.length = 90;
    mill.radius = 25;
    for (int i = 0; i < 4; ++i)
      mill.cutter.teeth.push_back({.angle = 20.0 + 90 * i, .axial = 0.01, .broken = 0.8});
    world.add(mill, 12, mill.length, mill.radius);
    world.parameter("stopOnCheck", "", 0);
    TableFolder folder(world.bench);
    enter(folder, world, {{"R-OFFS", offset}, {"CUT", "4"}, {"LBREAK", "0.5"}});
    for (const bool teeth : {false, true}) {
      const Ran ran = world.run(toolCycle(481, 1, teeth, false));
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_NEAR(ran.q(115), -0.79, 0.0051);
      EXPECT_EQ(ran.q(199), 2);
    }
  }
}

TEST(ToolMeasurement, OfAStandingToolIsExact) {
  Dice dice(4822);
  for (int at = 0; at < 12; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    ToolWorld world(controlOf(at));
    world.disc(40);
    simulation::TrueTool drill;
    drill.length = dice.between(60, 110);
    drill.radius = dice.between(1, 8);
    drill.cutter.pointAngle = dice.between(90, 140);
    drill.cutter.teeth = {{.angle = 0}, {.angle = 180}};
    world.add(drill, 12, written(drill.length + dice.between(-1, 1)), written(drill.radius));
    TableFolder folder(world.bench);
    enter(folder, world, {{"R-OFFS", "0"}});
    const Ran ran = world.run(toolCycle(481, 1, false, at % 3 == 0));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(115), drill.length - world.bench.setup.beliefs.tools.back().length, 1e-6);
  }
}

/// A ball is measured at its equator with L-OFFS = R, and at its lowest point in the middle of the contact.
TEST(ToolMeasurement, OfABallMillNeedsItsOffset) {
  Dice dice(4823);
  ToolWorld world;
  world.disc(40);
  simulation::TrueTool ball = plantedMill(dice, 5, 4, true);
  for (auto& tooth : ball.cutter.teeth)
    tooth.radial = tooth.axial = 0;
  ball.cutter.cornerRadius = 5;
  ball.cutter.helix = 0;
  world.add(ball, 12, ball.length, 5);
  world.parameter("offsetToolAxis", "", 2);
  TableFolder folder(world.bench);
  const auto deviations = [&](const std::string& offset) {
    enter(folder, world, {{"R-OFFS", "0"}, {"L-OFFS", offset}, {"CUT", "4"}});
    const Ran ran = world.run(toolCycle(483, 1, false, false));
    EXPECT_TRUE(ran.finished()) << ran.why();
    return Vector2(ran.q(115), ran.q(116));
  };
  EXPECT_NEAR(deviations("5").x(), 0, 1e-4);  // TOOL.T rounds the length
  EXPECT_NEAR(deviations("5").y(), 0, 0.0051);
  // 2 mm above the lowest point a ball of 5 mm is 4 mm wide.
  EXPECT_NEAR(deviations("0").y(), -1, 0.0051);
}

TEST(ToolMeasurement, ComputesSpeedAndFeedAsTheManualsDo) {
  control::heidenhain::MachineParameters parameters;
  parameters.maxPeriphSpeedMeas = 30;
  parameters.measureTolerance1 = 0.005;
  const auto speeds = [&](int kind, double radius) {
    parameters.probingFeedCalc = kind;
    return cycles::heidenhain::toolProbingSpeeds(parameters, radius);
  };
  EXPECT_NEAR(speeds(0, 10).spindle, 476.190, 1e-3);
  EXPECT_NEAR(speeds(0, 10).feed, 2.38095, 1e-5);
  EXPECT_NEAR(speeds(1, 10).feed, 2.38095, 1e-5);
  EXPECT_NEAR(speeds(2, 10).feed, 4.76190, 1e-5);
  EXPECT_NEAR(speeds(0, 50).spindle, 95.2381, 1e-4);
  EXPECT_NEAR(speeds(0, 50).feed, 0.476190, 1e-6);
  EXPECT_NEAR(speeds(1, 50).feed, 0.952381, 1e-6);
  EXPECT_NEAR(speeds(2, 50).feed, 4.76190, 1e-5);
  EXPECT_EQ(speeds(1, 30).feed, speeds(0, 30).feed);
  EXPECT_NEAR(speeds(1, 150).feed, 4 * speeds(0, 150).feed, 1e-12);
  EXPECT_EQ(speeds(0, 1).spindle, 1000);
}

}  // namespace
}  // namespace probewright::testing_support
