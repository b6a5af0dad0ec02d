#include "cycles_heidenhain/worlds.hpp"

/// The iTNC 530's machine parameters of calibrating: one set of data or one a tool (MP7411), a place for every traverse
/// range (MP6180 to MP6182, MP6185), and the feature content level.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

void set(Bench& bench, const std::string& name, double value) { bench.setup.beliefs.parameters[name] = {value, {}}; }

/// Two probes of different length and ball, both known to the tool table as they are; a hole of known size, the preset
/// in the middle of its upper edge.
struct TwoProbes {
  Bench bench{ControlKind::iTNC530};
  double length[2] = {};
  double ball[2] = {};
  Vector3 origin;
  double diameter = 0;

  explicit TwoProbes(Dice& dice) {
    length[0] = written(dice.between(90, 130), 4);
    length[1] = written(length[0] + dice.between(-1.5, 1.5), 4);
    ball[0] = written(dice.between(1.5, 3), 4);
    ball[1] = written(ball[0] + dice.between(-0.4, 0.4), 4);
    bench.probeOf(length[0], ball[0]);
    bench.believedProbe().maximumTravel = 40;
    simulation::TrueTool other = idealProbe(length[1], ball[1]);
    other.number = 2;
    other.name = "OTHER";
    bench.setup.world.truth.tools.push_back(other);
    control::BelievedTool believed = bench.believedProbe();
    believed.number = 2;
    believed.name = "OTHER";
    believed.length = length[1];
    believed.radius = ball[1];
    bench.setup.beliefs.tools.push_back(believed);
    origin = Vector3(written(dice.between(-80, 80)), written(dice.between(-60, 60)), -400);
    bench.preset(1, origin);
    diameter = dice.between(30, 40);
    bench.part(simulation::Ring(diameter / 2, 60, -40), pose(origin));
  }

  /// Measures the hole, then the face beside it.
  static std::string measure() {
    const Words hole = {{273, 0}, {274, 0},  {262, 34}, {325, 0}, {247, 90}, {261, -8}, {320, 0}, {260, 30},
                        {301, 0}, {275, 50}, {276, 20}, {279, 0}, {280, 0},  {281, 0},  {309, 0}, {330, 0}};
    const Words face = {{263, 40}, {264, 0}, {261, 0}, {320, 4},  {272, 3}, {267, -1},
                        {260, 30}, {281, 0}, {288, 9}, {289, -9}, {309, 0}, {330, 0}};
    return probe(421, hole) + "Q40 = Q153\n" + probe(427, face) + "Q41 = Q160\nFN 18: SYSREAD Q42 = ID350 NR11\n" +
           "FN 18: SYSREAD Q43 = ID350 NR12\n";
  }
};

TEST(MP7411, ChoosesBetweenTheToolTableAndTheOneSetOfCalibrationData) {
  Dice dice(7411);
  for (int at = 0; at < 20; ++at) {
    SCOPED_TRACE(at);
    TwoProbes world(dice);
    // The tool in the spindle has its own data in TOOL.T: right with either.
    const Ran own = world.bench.runBare("TOOL CALL 2 Z\n" + TwoProbes::measure());
    ASSERT_TRUE(own.finished()) << own.why();
    EXPECT_NEAR(own.q(40), world.diameter, exact);
    EXPECT_NEAR(own.q(41), 0, exact);
    EXPECT_NEAR(own.q(42), world.ball[1], exact);

    // One set for all: it is that of the first probe, and the second one measures wrong by the differences. Oversizes
    // of TOOL CALL are overwritten too.
    set(world.bench, "MP7411", 0);
    const Ran one = world.bench.runBare("TOOL CALL 2 Z DL+0.3 DR+0.2\n" + TwoProbes::measure());
    ASSERT_TRUE(one.finished()) << one.why();
    EXPECT_NEAR(one.q(40), world.diameter + 2 * (world.ball[0] - world.ball[1]), exact);
    EXPECT_NEAR(one.q(41), world.length[1] - world.length[0], exact);
    EXPECT_NEAR(one.q(42), world.ball[0], exact);
    EXPECT_NEAR(one.q(43), world.length[0], exact);
    const Ran first = world.bench.run(TwoProbes::measure());
    ASSERT_TRUE(first.finished()) << first.why();
    EXPECT_NEAR(first.q(40), world.diameter, exact);
    EXPECT_NEAR(first.q(41), 0, exact);

    // Calibrated with the second probe in the spindle, the set is right for it; the tool table stays as it was. The
    // length that TOOL.T gives counts between the cycles: the probe stands where the program sends it.
    set(world.bench, "MP6180.0", world.origin.x() + 0.2);
    set(world.bench, "MP6180.1", world.origin.y() - 0.2);
    set(world.bench, "MP6180.2", world.origin.z());
    set(world.bench, "MP6185.0", 9);
    const Ran fresh = world.bench.runBare(
        fmt::format("TOOL CALL 2 Z\nTCH PROBE 2.0 CALIBRATE TS\nTCH PROBE 2.1 HEIGHT: +30 R {:+.6f} DIRECTION: 0\n"
                    "FN 18: SYSREAD Q44 = ID350 NR13\n"
                    "L Z+50 R0 FMAX\nL X+40 Y+0 R0 FMAX\nL Z+10 R0 FMAX\n"
                    "TCH PROBE 9.0 CALIBRATE TS LENGTH\nTCH PROBE 9.1 DATUM +0 REFERENCE SYSTEM 0\n"
                    "FN 18: SYSREAD Q45 = ID240 NR1 IDX3\nL Z+60 R0 FMAX\n{}",
                    world.diameter / 2, TwoProbes::measure()));
    ASSERT_TRUE(fresh.finished()) << fresh.why();
    EXPECT_NEAR(fresh.q(40), world.diameter, exact);
    EXPECT_NEAR(fresh.q(41), 0, exact);
    EXPECT_NEAR(fresh.q(42), world.ball[1], exact);
    EXPECT_NEAR(fresh.q(43), world.length[1], exact);
    EXPECT_NEAR(fresh.q(44), world.diameter / 2, exact);
    EXPECT_NEAR(fresh.q(45), world.origin.z() + 10 + world.length[1], exact);
    EXPECT_NEAR(fresh.cell("TOOL.T", "2", "R"), world.ball[1], exact);
    EXPECT_NEAR(fresh.cell("TOOL.T", "1", "R"), world.ball[0], exact);
    std::string written;
    for (const auto& cycle : fresh.outcome.journal.cycles) {
      for (const auto& write : cycle.writes)
        written += write.table + ": " + write.entry + "\n";
    }
    EXPECT_EQ(written, "calibration data: effective radius\ncalibration data: effective length\n");
  }
}

TEST(MP7411, TheOneSetKnowsItsCentreOffsetAndItsEmptyRadius) {
  Dice dice(74112);
  TwoProbes world(dice);
  world.bench.setup.world.truth.tools[1].probe.tipOffset = {0.11, -0.07};
  for (const bool known : {false, true}) {
    SCOPED_TRACE(known);
    set(world.bench, "MP7411", 0);
    set(world.bench, "calibratedLength", world.length[1]);
    set(world.bench, "calibratedRadius", world.ball[1]);
    set(world.bench, "calibratedOffset1", known ? 0.11 : 0);
    set(world.bench, "calibratedOffset2", known ? -0.07 : 0);
    const Ran ran = world.bench.runBare("TOOL CALL 2 Z\n" + TwoProbes::measure());
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.outcome.journal.cycles.front().results.front().value, known ? 0 : -0.11, exact);
    EXPECT_NEAR(ran.q(40), world.diameter, exact);
  }
  set(world.bench, "calibratedRadius", 0);
  const Ran empty = world.bench.runBare("TOOL CALL 2 Z\n" + TwoProbes::measure());
  EXPECT_EQ(empty.alarm(), "Touch probe not calibrated");
  EXPECT_NE(empty.why().find("MP7411 = 0"), std::string::npos) << empty.why();
}

TEST(MP7411, Cycle460CalibratesTheOneSetWithItsCentreOffset) {
  // The equator of the sphere is found in passes.
  constexpr double near = 1e-5;
  Dice dice(74113);
  for (int at = 0; at < 12; ++at) {
    SCOPED_TRACE(at);
    TwoProbes world(dice);
    const Vector2 tip(written(dice.between(-0.2, 0.2), 4), written(dice.between(-0.2, 0.2), 4));
    world.bench.setup.world.truth.tools[1].probe.tipOffset = tip;
    set(world.bench, "MP7411", 0);
    const double radius = 12.5, height = 6;
    const Vector3 place = world.origin + Vector3(120 + dice.between(-0.4, 0.4), dice.between(-0.4, 0.4), height);
    world.bench.part(simulation::SolidSphere(Vector3::Zero(), radius), pose(place));
    const Words words = {{407, radius}, {320, 2}, {301, 1}, {423, 4}, {380, 0}, {433, 1}, {434, height}};
    const Ran ran = world.bench.runBare("TOOL CALL 2 Z\nL Z+60 R0 FMAX\nL X+120 Y+0 R0 FMAX\n" +
                                        fmt::format("L Z{:+.4f} R0 FMAX\n", height + radius + 5) + probe(460, words) +
                                        "L Z+60 R0 FMAX\n" + TwoProbes::measure() +
                                        "FN 18: SYSREAD Q44 = ID350 NR14 IDX1\nFN 18: SYSREAD Q45 = ID350 NR14 IDX2\n");
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(40), world.diameter, near);
    EXPECT_NEAR(ran.q(41), 0, near);
    EXPECT_NEAR(ran.q(42), world.ball[1], near);
    EXPECT_NEAR(ran.q(43), world.length[1], near);
    EXPECT_NEAR(ran.q(44), tip.x(), near);
    EXPECT_NEAR(ran.q(45), tip.y(), near);
    EXPECT_NEAR(ran.cell("TOOL.T", "2", "L"), world.length[1], near);
    for (const control::WriteRecord& write : ran.outcome.journal.cycles.front().writes)
      EXPECT_EQ(write.table, "calibration data");
  }
}

TEST(Cycle2, TakesTheStandardOfTheTraverseRange) {
  Dice dice(6182);
  for (int at = 0; at < 12; ++at) {
    SCOPED_TRACE(at);
    const int range = at % 3;
    Bench bench(ControlKind::iTNC530);
    const double ball = written(dice.between(1, 3), 4), depth = written(dice.between(4, 12));
    bench.probeOf(100, ball);
    bench.believedProbe().radius = ball + 0.2;
    bench.believedProbe().maximumTravel = 70;
    bench.preset(1, {0, 0, -400});
    const bool outside = dice.coin();
    // A standard of its own size for every range; only that of the range in force has the size that the block names.
    double radius = 0;
    for (int i = 0; i < 3; ++i) {
      const Vector3 place(-150.0 + 150 * i, 20.0 * i, -400.0 - 5 * i);
      const double size = written(dice.between(10, 25), 4);
      if (i == range) radius = size;
      // The touches must meet the standard at the depth of this range: below it is wider or narrower.
      if (outside) {
        bench.part(simulation::RoundBar(size, -depth - 4, 0), pose(place));
        bench.part(simulation::RoundBar(size + 1, -60, -depth - 4), pose(place));
      } else {
        bench.part(simulation::Ring(size, size + 15, -depth - 4), pose(place));
        bench.part(simulation::Ring(size - 1, size + 15, -40), pose(place - Vector3(0, 0, depth + 4)));
      }
      const std::string name = fmt::format("MP618{}", i);
      for (int axis = 0; axis < 3; ++axis)
        set(bench, fmt::format("{}.{}", name, axis), place[axis]);
      set(bench, fmt::format("MP6185.{}", i), i == range ? depth : depth + 9);
    }
    if (range > 0) set(bench, "traverseRange", range + 1);
    const std::string calibrate = fmt::format(
        "TCH PROBE 2.0 CALIBRATE TS\nTCH PROBE 2.1 HEIGHT: +30 R {:+.4f} DIRECTION: {}\n", radius, outside ? 1 : 0);
    const Ran ran = bench.run(calibrate);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), ball, exact);
    for (const char axis : {'0', '1', '2'})
      bench.setup.beliefs.parameters.erase(fmt::format("MP618{}.{}", range, axis));
    const Ran missing = bench.run(calibrate);
    EXPECT_EQ(missing.alarm(), "Calibration workpiece not defined");
    EXPECT_NE(missing.why().find(fmt::format("MP618{}.0", range)), std::string::npos) << missing.why();
  }
}

TEST(FeatureContentLevel, EnablesTheCyclesThatBelongToIt) {
  const std::string cycle4 =
      "TCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q1\nTCH PROBE 4.2 IX+1 IY+0 IZ+0\n"
      "TCH PROBE 4.3 ABST+10 F100 MB5 REFERENCE SYSTEM:0\n";
  const Words ridge = {{321, 0}, {322, 0}, {311, 20}, {272, 1}, {261, -5}, {320, 0}, {260, 20}, {305, 1},
                       {405, 0}, {303, 1}, {381, 0},  {382, 0}, {383, 0},  {384, 0}, {333, 0}};
  const Words fast = {{396, 3000}, {397, 0}, {399, 0}, {400, 1}};
  struct Case {
    std::string blocks;
    int level;
  };
  for (const Case& one : {Case{cycle4, 3}, Case{probe(408, with(ridge, {{301, 0}})), 3}, Case{probe(409, ridge), 3},
                          Case{probe(441, fast), 2}}) {
    SCOPED_TRACE(one.blocks);
    for (int level = 0; level <= 3; ++level) {
      SCOPED_TRACE(level);
      Bench bench(ControlKind::iTNC530);
      bench.preset(1, {0, 0, -400});
      set(bench, "FCL", level);
      const Ran ran = bench.run(one.blocks);
      if (level < one.level) {
        EXPECT_EQ(ran.alarm(), "Function not enabled");
        EXPECT_NE(ran.why().find(fmt::format("feature content level {}", one.level)), std::string::npos) << ran.why();
      } else {
        EXPECT_NE(ran.alarm(), "Function not enabled") << ran.why();
      }
    }
    // The newer control has no such levels.
    Bench newer;
    newer.preset(1, {0, 0, -400});
    EXPECT_NE(newer.run(one.blocks).alarm(), "Function not enabled");
  }
}

}  // namespace
}  // namespace probewright::testing_support
