#include "tool_touch_probe/tool_worlds.hpp"

/// A tool is as long in inches as in millimetres, and under every preset, shift and rotation.
namespace probewright::testing_support {
namespace {

struct Mill {
  explicit Mill(ControlKind control) : world(control) {
    world.disc(30);
    simulation::TrueTool mill;
    mill.length = 80.25;
    mill.radius = 7.75;
    mill.cutter.cutLength = 25;
    for (int i = 0; i < 3; ++i)
      mill.cutter.teeth.push_back({.angle = 120.0 * i + 11, .radial = -0.02 * i, .axial = -0.01 * (2 - i)});
    world.add(mill, 12, 80, 8);
    world.parameter("stopOnCheck", "", 0);
  }
  Ran run(const std::string& blocks, const std::string& unit = "MM") const {
    Bench bench = world.bench;
    bench.setup.beliefs.toolProbes = setup::believedToolProbes(bench.setup.world);
    return bench.runBare("TOOL CALL 12 Z\n" + blocks, unit);
  }

  ToolWorld world;
};

std::string cycles(int mode, double unit, bool old) {
  if (!old) return probe(483, {{340, mode}, {260, 60 / unit}, {341, 0}});
  return fmt::format(
      "TCH PROBE 33.0 TOOL\nTCH PROBE 33.1 CHECK: {} Q5\nTCH PROBE 33.2 HEIGHT: {:+.4f}\nTCH PROBE 33.3 PROBING THE "
      "TEETH: 0\n",
      mode, 60 / unit);
}

/// What the record of a touch says of the place that was expected: there the tool as it is believed would touch. It is
/// longer by 0.25 mm and narrower by as much, and its teeth run out by up to 0.04 mm.
TEST(ToolTouches, AreExpectedWhereTheBelievedToolTouches) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    const Mill mill(control);
    const Ran ran = mill.run(cycles(0, 1, false));
    ASSERT_TRUE(ran.finished()) << ran.why();
    std::size_t touched = 0;
    for (const control::TouchRecord& touch : ran.outcome.journal.cycles.back().touches) {
      if (touch.outcome != "touched") continue;
      ++touched;
      const Vector3 off = touch.surface - touch.target;
      EXPECT_LT(off.norm(), 0.35) << touched;
      EXPECT_LT((off - touch.direction * off.dot(touch.direction)).norm(), 1e-6) << touched;
    }
    EXPECT_GE(touched, 2U);
  }
}

/// FN 18 tells where the spindle stood at the last touch: the axes, seen from the preset at Z-420.
TEST(ToolTouches, TellWhereTheSpindleStood) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    const Mill mill(control);
    const Ran ran = mill.run(cycles(1, 1, false) +
                             "FN 18: SYSREAD Q61 = ID360 NR2 IDX1\nFN 18: SYSREAD Q63 = ID360 NR2 IDX3\n"
                             "FN 18: SYSREAD Q71 = ID360 NR3 IDX1\nFN 18: SYSREAD Q73 = ID360 NR3 IDX3\n");
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_GT(ran.q(61), 90);
    EXPECT_NEAR(ran.q(71), ran.q(61), 1e-9);
    EXPECT_NEAR(ran.q(73), ran.q(63) + 420, 1e-9);
  }
}

TEST(ToolUnits, AToolIsAsLongInInches) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const bool old : {false, true}) {
      const Mill mill(control);
      const Ran metric = mill.run(cycles(0, 1, old)), inch = mill.run(cycles(0, 25.4, old), "INCH");
      ASSERT_TRUE(metric.finished()) << metric.why();
      ASSERT_TRUE(inch.finished()) << inch.why();
      for (const char* column : {"L", "R"})
        EXPECT_NEAR(inch.cell("TOOL.T", "12", column), metric.cell("TOOL.T", "12", column), 1.1e-4) << column;
      const Ran checked = mill.run(cycles(1, 1, old)), checkedInch = mill.run(cycles(1, 25.4, old), "INCH");
      ASSERT_TRUE(checkedInch.finished()) << checkedInch.why();
      EXPECT_GT(std::abs(checked.q(115)), 0.2);
      for (const int q : {115, 116})
        EXPECT_NEAR(checkedInch.q(q) * 25.4, checked.q(q), 1e-4) << q;
      for (const char* column : {"DL", "DR"})
        EXPECT_NEAR(checkedInch.cell("TOOL.T", "12", column), checked.cell("TOOL.T", "12", column), 1.1e-4) << column;
    }
  }
}

TEST(ToolFrames, AToolIsAsLongUnderEveryPresetAndShift) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    const Mill mill(control);
    const auto expectSame = [&](const Ran& ran, const std::string& what) {
      ASSERT_TRUE(ran.finished()) << what << ran.why();
      EXPECT_NEAR(ran.cell("TOOL.T", "12", "L"), 80.25, 0.006) << what;
      EXPECT_NEAR(ran.cell("TOOL.T", "12", "R"), 7.75, 0.006) << what;
    };
    // Turning tools follow their edges by the feed of a turn.
    expectSame(mill.run(cycles(0, 1, false)), "plain");
    Mill turned = mill;
    turned.world.bench.setup.beliefs.presets.clear();
    turned.world.bench.preset(1, {37, -91, -431}, 33);
    expectSame(turned.run(cycles(0, 1, false)), "basic rotation");
    expectSame(mill.run("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+55\nCYCL DEF 7.2 Y-20\nCYCL DEF 7.3 Z+11\n" +
                        cycles(0, 1, false)),
               "datum shift");
    Mill tabled(control);
    const TableFolder folder(tabled.world.bench);
    folder.put("ZERO.D",
               "BEGIN ZERO.D MM\nD     X         Y         Z\n0     +0        +0        +0\n"
               "3     +12.5     -43.25    +7.5\n[END]\n");
    expectSame(tabled.run("SEL TABLE \"ZERO.D\"\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #3\n" + cycles(0, 1, false)),
               "datum table");
    expectSame(mill.run("CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+70\n" + cycles(0, 1, false)), "rotation");
    const Ran mirrored = mill.run("CYCL DEF 8.0 MIRRORING\nCYCL DEF 8.1 X\n" + cycles(0, 1, false));
    if (control == ControlKind::TNC640) {
      EXPECT_NE(mirrored.why().find("Coordinate transformation not permitted"), std::string::npos) << mirrored.why();
    } else {
      expectSame(mirrored, "mirroring");
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
