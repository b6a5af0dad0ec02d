#include "cycles_heidenhain/worlds.hpp"

/// Cycles 2, 9, 441 and 460 to 463: a probe of unknown length, radius and tip offset becomes known, and what it
/// measures afterwards is right.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 100;
constexpr double exact = 1e-6;

/// A standard on the table and a probe that the control knows wrongly.
struct Standard {
  Bench bench;
  double length = 0, ball = 0;    ///< truth
  Vector2 tip = Vector2::Zero();  ///< truth, spindle at 0
  Pose machineFromPreset = Pose::Identity();
  Vector3 place = Vector3::Zero();         ///< of the standard's reference point in the preset, as the program has it
  Vector3 machinePlace = Vector3::Zero();  ///< as it truly is
};

Standard standard(Dice& dice, ControlKind control) {
  Standard world{Bench(control)};
  world.length = written(dice.between(80, 140), 4);
  world.ball = written(dice.between(1, 3), 4);
  world.tip = {written(dice.between(-0.2, 0.2), 4), written(dice.between(-0.2, 0.2), 4)};
  world.bench.probeOf(world.length, world.ball);
  world.bench.trueProbe().tipOffset = world.tip;
  auto& believed = world.bench.believedProbe();
  believed.length = written(world.length + dice.between(-0.8, 0.8), 4);
  believed.radius = written(world.ball + dice.between(-0.3, 0.3), 4);
  believed.tipOffset = {written(dice.between(-0.2, 0.2), 4), written(dice.between(-0.2, 0.2), 4)};
  believed.maximumTravel = 70;
  const Vector3 origin(written(dice.between(-80, 80), 4), written(dice.between(-60, 60), 4), -400);
  const double rotation = dice.coin() ? 0 : written(dice.between(-40, 40));
  world.bench.preset(1, origin, rotation);
  world.machineFromPreset = pose(origin, {0, 0, rotation});
  world.place = {written(dice.between(-30, 30)), written(dice.between(-30, 30)), 0};
  world.machinePlace = world.machineFromPreset *
                       Vector3(world.place.x() + dice.between(-0.8, 0.8), world.place.y() + dice.between(-0.8, 0.8), 0);
  return world;
}

std::string goTo(const Vector3& place, double height) {
  return fmt::format("L Z+60 R0 FMAX\nL X{:+.4f} Y{:+.4f} R0 FMAX\nL Z{:+.4f} R0 FMAX\n", place.x(), place.y(), height);
}

double probeCell(const Ran& ran, const std::string& column) { return ran.cell("TCHPROBE.TP", "1", column); }

/// The log has a row for the datum with its new value.
void expectLogged(const Ran& ran, const std::string& datum) {
  const std::string log = ran.log("TCHPRAUTO.html");
  if (ran.outcome.control == ControlKind::iTNC530) {
    EXPECT_EQ(log, "") << "the iTNC 530 keeps none";
    return;
  }
  const std::size_t row = log.find("<td>" + datum + "</td>");
  ASSERT_NE(row, std::string::npos) << log;
  const std::string after = fmt::format("<td>{:.4f}</td></tr>", ran.cell("TOOL.T", "1", datum));
  EXPECT_LT(log.find(after, row), log.find("\n", row)) << log;
}

void expectRadius(const Ran& ran, const Standard& world, bool withOffset = true) {
  EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), world.ball, exact);
  expectLogged(ran, "R");
  if (!withOffset) return;
  const bool table = world.bench.control == ControlKind::TNC640;
  EXPECT_NEAR(table ? probeCell(ran, "CAL_OF1") : ran.cell("TOOL.T", "1", "CAL-OF1"), world.tip.x(), exact);
  EXPECT_NEAR(table ? probeCell(ran, "CAL_OF2") : ran.cell("TOOL.T", "1", "CAL-OF2"), world.tip.y(), exact);
}

/// A hole away from the standard, and the cycle that measures it.
struct Hole {
  Vector3 centre;
  double diameter = 0;
  std::string cycle;
};

Hole layHole(Dice& dice, Standard& world) {
  Hole hole;
  hole.centre = world.place + Vector3(120, 0, 0) + Vector3(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), 0);
  hole.diameter = dice.between(24, 40);
  world.bench.part(simulation::Ring(hole.diameter / 2, hole.diameter / 2 + 15, -40),
                   pose(world.machineFromPreset * hole.centre));
  Words words = {{273, written(hole.centre.x())},
                 {274, written(hole.centre.y())},
                 {262, written(hole.diameter)},
                 {325, 0},
                 {247, 90},
                 {261, -8},
                 {320, 0},
                 {260, 30},
                 {301, 0},
                 {275, 0},
                 {276, 0},
                 {279, 0},
                 {280, 0},
                 {281, 0},
                 {309, 0},
                 {330, 0}};
  if (world.bench.control == ControlKind::TNC640) words = with(words, {{423, 4}, {365, 1}});
  hole.cycle = probe(421, words);
  return hole;
}

void expectHole(const Ran& ran, const Hole& hole) {
  EXPECT_NEAR(ran.q(151), hole.centre.x(), exact);
  EXPECT_NEAR(ran.q(152), hole.centre.y(), exact);
  EXPECT_NEAR(ran.q(153), hole.diameter, exact);
}

TEST(Cycle462, CalibratesInAnyRing) {
  Dice dice(462);
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Standard world = standard(dice, ControlKind::TNC640);
    const double radius = written(dice.between(10, 30), 4);
    world.bench.part(simulation::Ring(radius, radius + 15, -30), pose(world.machinePlace));
    const Hole hole = layHole(dice, world);
    const Words words = {
        {407, radius}, {320, dice.coin() ? 0 : 1}, {423, dice.whole(3, 8)}, {380, written(dice.between(0, 360))}};
    // Wrongly calibrated the hole comes out wrong by the errors of the calibration.
    const Ran before = world.bench.run(hole.cycle);
    ASSERT_TRUE(before.finished()) << before.why();
    EXPECT_NEAR(before.q(153), hole.diameter + 2 * (world.bench.believedProbe().radius - world.ball), exact);
    const Ran ran = world.bench.run(goTo(world.place, -9) + probe(462, words) + "L Z+60 R0 FMAX\n" + hole.cycle);
    ASSERT_TRUE(ran.finished()) << ran.why();
    expectRadius(ran, world);
    expectHole(ran, hole);
  }
}

TEST(Cycle463, CalibratesOnAnyStud) {
  Dice dice(463);
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Standard world = standard(dice, ControlKind::TNC640);
    const double radius = written(dice.between(5, 30), 4);
    world.bench.part(simulation::RoundBar(radius, -40, 0), pose(world.machinePlace));
    const Hole hole = layHole(dice, world);
    const Words words = {{407, radius},
                         {320, 3},
                         {301, dice.whole(0, 1)},
                         {423, dice.whole(3, 8)},
                         {380, written(dice.between(0, 360))}};
    const Ran ran = world.bench.run(goTo(world.place, 4) + probe(463, words) + "L Z+60 R0 FMAX\n" + hole.cycle);
    ASSERT_TRUE(ran.finished()) << ran.why();
    expectRadius(ran, world);
    expectHole(ran, hole);
  }
}

TEST(Cycle460, CalibratesOnAnySphere) {
  Dice dice(460);
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Standard world = standard(dice, controlOf(at));
    const double radius = written(dice.between(8, 20), 4);
    const double height = written(dice.between(-5, 5), 4);
    const bool withLength = dice.coin();
    world.bench.part(simulation::SolidSphere(Vector3::Zero(), radius),
                     pose(world.machinePlace + Vector3(0, 0, height)));
    const Hole hole = layHole(dice, world);
    const int count = world.bench.control == ControlKind::TNC640 ? dice.whole(3, 8) : dice.whole(3, 4);
    const Words words = {{407, radius},
                         {320, 1},
                         {301, dice.whole(0, 1)},
                         {423, count},
                         {380, written(dice.between(0, 360))},
                         {433, withLength ? 1 : 0},
                         {434, height}};
    const Ran ran =
        world.bench.run(goTo(world.place, height + radius + 4) + probe(460, words) + "L Z+60 R0 FMAX\n" + hole.cycle);
    ASSERT_TRUE(ran.finished()) << ran.why();
    expectRadius(ran, world);
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), withLength ? world.length : world.bench.believedProbe().length, exact);
    expectHole(ran, hole);
  }
}

TEST(Cycle461, CalibratesTheLengthOnAnySurface) {
  Dice dice(461);
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Standard world = standard(dice, ControlKind::TNC640);
    const double height = written(dice.between(-10, 10), 4);
    world.bench.part(simulation::Box({-30, -30, -20}, {30, 30, 0}), pose(world.machinePlace + Vector3(0, 0, height)));
    const Ran ran = world.bench.run(goTo(world.place, height + 5) + probe(461, {{434, height}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), world.length, exact);
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "DL"), 0, exact);
    expectLogged(ran, "L");
  }
}

TEST(Cycle9, CalibratesTheLengthInBothSystems) {
  Dice dice(9);
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Standard world = standard(dice, ControlKind::iTNC530);
    const double height = written(dice.between(-10, 10), 4);
    world.bench.part(simulation::Box({-30, -30, -20}, {30, 30, 0}), pose(world.machinePlace + Vector3(0, 0, height)));
    const bool inMachine = dice.coin();
    const Ran ran = world.bench.run(goTo(world.place, height + 5) +
                                    fmt::format("TCH PROBE 9.0 CALIBRATE TS LENGTH\nTCH PROBE 9.1 DATUM {:+.4f} "
                                                "REFERENCE SYSTEM {}\n",
                                                inMachine ? height - 400 : height, inMachine ? 1 : 0));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), world.length, exact);
    expectLogged(ran, "L");
  }
}

TEST(Cycle2, CalibratesAtThePlaceOfTheMachineParameters) {
  Dice dice(2);
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Standard world = standard(dice, ControlKind::iTNC530);
    // The cycle knows nothing of the tip offset; the control is to know it already.
    world.bench.believedProbe().tipOffset = world.tip;
    const bool outside = dice.coin();
    const double radius = written(dice.between(10, 30), 4);
    if (outside) {
      world.bench.part(simulation::RoundBar(radius, -40, 0), pose(world.machinePlace));
    } else {
      world.bench.part(simulation::Ring(radius, radius + 15, -30), pose(world.machinePlace));
    }
    const Hole hole = layHole(dice, world);
    const Vector3 roughly = world.machineFromPreset * world.place;
    world.bench.setup.beliefs.parameters["MP6180.0"] = {roughly.x(), {}};
    world.bench.setup.beliefs.parameters["MP6180.1"] = {roughly.y(), {}};
    world.bench.setup.beliefs.parameters["MP6180.2"] = {roughly.z(), {}};
    world.bench.setup.beliefs.parameters["MP6185.0"] = {9.0, {}};
    const Ran ran = world.bench.run(fmt::format("TCH PROBE 2.0 CALIBRATE TS\nTCH PROBE 2.1 HEIGHT: +30 R {:+.4f} "
                                                "DIRECTION: {}\n",
                                                radius, outside ? 1 : 0) +
                                    hole.cycle);
    ASSERT_TRUE(ran.finished()) << ran.why();
    expectRadius(ran, world, true);
    expectHole(ran, hole);
  }
}

TEST(Cycle2, NeedsThePlaceOfTheStandard) {
  Dice dice(22);
  const Standard world = standard(dice, ControlKind::iTNC530);
  const Ran ran = world.bench.run("TCH PROBE 2.0 CALIBRATE TS\nTCH PROBE 2.1 HEIGHT: +30 R +20 DIRECTION: 0\n");
  EXPECT_EQ(ran.alarm(), "Calibration workpiece not defined");
}

TEST(Calibrations, RefuseTransformationsAndMissingTouches) {
  Dice dice(46);
  const Standard world = standard(dice, ControlKind::TNC640);
  const std::string shift = "CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 X+10\n";
  const Words ring = {{407, 20}, {320, 0}, {423, 4}, {380, 0}};
  EXPECT_EQ(world.bench.run(shift + probe(462, ring)).alarm(), "Coordinate transformation not permitted");
  EXPECT_EQ(world.bench.run(goTo(world.place, 20) + probe(461, {{434, 0}})).alarm(), "Touch point inaccessible");
  EXPECT_EQ(world.bench.runBare(probe(461, {{434, 0}})).alarm(), "Touch probe axis not defined");
}

/// A hole and a probe whose tip offset (0.1, 0) the control does not know.
TEST(Cycle441, TurnsTheProbeToEveryTouch) {
  Dice dice(441);
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Standard world = standard(dice, ControlKind::TNC640);
    const double offset = written(dice.between(-0.2, 0.2), 4);
    world.bench.believedProbe().radius = world.ball;
    world.bench.believedProbe().tipOffset = {0, 0};
    world.bench.trueProbe().tipOffset = {offset, 0};
    const Hole hole = layHole(dice, world);
    const std::string fast =
        "TCH PROBE 441 FAST PROBING ~\n Q 396=3000 ;A ~\n Q 397=0 ;B ~\n Q 399={} ;C ~\n Q 400=0 ;D\n";
    const auto run = [&](int track) {
      std::string text = fast;
      text.replace(text.find("{}"), 2, std::to_string(track));
      return world.bench.run(text + hole.cycle);
    };
    // Turned, the ball stands ahead by the offset everywhere: the hole seems smaller, its centre is right.
    const Ran turned = run(1);
    ASSERT_TRUE(turned.finished()) << turned.why();
    EXPECT_NEAR(turned.q(151), hole.centre.x(), exact);
    EXPECT_NEAR(turned.q(152), hole.centre.y(), exact);
    EXPECT_NEAR(turned.q(153), hole.diameter - 2 * offset, exact);
    // Fixed, the whole circle is shifted along X of the machine.
    const Ran fixed = run(0);
    ASSERT_TRUE(fixed.finished()) << fixed.why();
    const Vector3 shift = world.machineFromPreset.linear().transpose() * Vector3(offset, 0, 0);
    EXPECT_NEAR(fixed.q(151), hole.centre.x() - shift.x(), exact);
    EXPECT_NEAR(fixed.q(152), hole.centre.y() - shift.y(), exact);
    EXPECT_NEAR(fixed.q(153), hole.diameter, exact);
  }
}

TEST(Cycle441, SetsTheFeedAndTheInterruption) {
  Dice dice(4411);
  Standard world = standard(dice, ControlKind::TNC640);
  const Hole hole = layHole(dice, world);
  const auto run = [&](int feed, int interrupt) {
    return world.bench.run(
        fmt::format("TCH PROBE 441 FAST PROBING ~\n Q396={} ~\n Q397=0 ~\n Q399=0 ~\n Q400={}\n", feed, interrupt) +
        hole.cycle);
  };
  const Ran fast = run(3000, 0);
  const Ran slow = run(300, 1);
  ASSERT_TRUE(fast.finished() && slow.finished()) << fast.why() << slow.why();
  const auto seconds = [](const Ran& ran) { return ran.cycle().endSeconds - ran.cycle().startSeconds; };
  EXPECT_GT(seconds(slow), 2 * seconds(fast));
  const auto stops = [](const Ran& ran) {
    return std::ranges::count(ran.outcome.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
  };
  EXPECT_EQ(stops(fast), 0);
  EXPECT_EQ(stops(slow), 1);
}

TEST(Cycle441, TakesRapidAndTheFeedOfTheToolCall) {
  Dice dice(4412);
  Standard world = standard(dice, ControlKind::TNC640);
  const Hole hole = layHole(dice, world);
  const auto seconds = [&](const std::string& feed) {
    const Ran ran = world.bench.runBare("TOOL CALL 1 Z F300\n" +
                                        fmt::format("TCH PROBE 441 FAST PROBING ~\n Q396={} ~\n Q397=0 ~\n Q399=0 ~\n "
                                                    "Q400=0\n",
                                                    feed) +
                                        hole.cycle);
    EXPECT_TRUE(ran.finished()) << ran.why();
    return ran.cycle().endSeconds - ran.cycle().startSeconds;
  };
  EXPECT_NEAR(seconds("FAUTO"), seconds("300"), exact);
  EXPECT_LT(seconds("FMAX"), seconds("3000") - 1);
}

TEST(Cycle441, TurnsTheProbeOfTheITNC530OnlyWhereMP6165AllowsIt) {
  Dice dice(4413);
  Standard world = standard(dice, ControlKind::iTNC530);
  world.bench.believedProbe().radius = world.ball;
  world.bench.believedProbe().tipOffset = {0, 0};
  world.bench.trueProbe().tipOffset = {0.1, 0};
  const Hole hole = layHole(dice, world);
  const auto run = [&](double allowed, int track) {
    world.bench.setup.beliefs.parameters["MP6165"] = {allowed, {}};
    return world.bench.run(
        fmt::format("TCH PROBE 441 FAST PROBING ~\n Q396=3000 ~\n Q397=0 ~\n Q399={} ~\n Q400=0\n", track) +
        hole.cycle);
  };
  const auto warnings = [](const Ran& ran) {
    return std::ranges::count(ran.outcome.journal.events, control::EventKind::Warning, &control::EventRecord::kind);
  };
  // Turned to every touch, an unknown offset makes the hole small; held still, it does not.
  EXPECT_NEAR(run(1, 1).q(153), hole.diameter - 0.2, exact);
  EXPECT_NEAR(run(1, 0).q(153), hole.diameter, 1e-3);
  EXPECT_NEAR(run(0, 1).q(153), hole.diameter, 1e-3);
  EXPECT_EQ(warnings(run(0, 1)), 1);
  EXPECT_EQ(warnings(run(1, 1)) + warnings(run(0, 0)), 0);
}

}  // namespace
}  // namespace probewright::testing_support
