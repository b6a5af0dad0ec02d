#include <numbers>

#include "lathe_tools/tool_bench.hpp"

/// CYCLE982: mills and drills on a lathe, standing and turning, and tools on an
/// orientable tool carrier.
namespace probewright {
namespace {

using namespace testing_support;

/// A mill or drill whose lengths (X, Z) and radius the control has wrong.
struct Planted {
  bool radial = false;
  Vector2 lengths = {60, 90};
  Vector2 wrong = Vector2::Zero();
  double radius = 8, wrongRadius = 0;
};

Planted plantedMill(Planter& plant, bool radial) {
  return {radial,
          {plant.number(50, 80), plant.number(60, 100)},
          {plant.number(-0.4, 0.4), plant.number(-0.4, 0.4)},
          plant.number(4, 10),
          plant.number(-0.3, 0.3)};
}

LatheBench benchOf(const Planted& planted, const char* kind = "mill",
                   const std::function<void(simulation::TrueTool&)>& change = {}) {
  setup::Setup setup = toolSetup();
  simulation::TrueTool tool = rotatedTool(5, planted.radial, planted.lengths, planted.radius);
  if (change) change(tool);
  add(setup, tool, kind);
  return LatheBench(setup);
}

void believeWrong(LatheBench& bench, const Planted& tool) {
  bench.set("$TC_DP3", {5, 1}, tool.lengths.x() + tool.wrong.x());
  bench.set("$TC_DP4", {5, 1}, tool.lengths.y() + tool.wrong.y());
  bench.set("$TC_DP6", {5, 1}, tool.radius + tool.wrongRadius);
}

/// In front of the tip's side of the contact, beside it (Z, X).
Vector2 startOf(bool radial, double beside) {
  return radial ? Vector2(probeMiddle.z() + beside, 195) : Vector2(445, probeMiddle.x() + beside);
}

void expectTool(LatheBench& bench, double length1, double length2, double radius) {
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), length1, 1e-6);
  EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), length2, 1e-6);
  EXPECT_NEAR(bench.data("$TC_DP6", {5, 1}), radius, 1e-6);
}

TEST(Cycle982Mill, CompletelyBothLengthsAndTheRadius) {
  Planter plant(9830);
  for (const bool radial : {false, true}) {
    for (const bool fromMinus : {false, true}) {
      const Planted tool = plantedMill(plant, radial);
      LatheBench bench = benchOf(tool);
      believeWrong(bench, tool);
      const Vector2 start = startOf(radial, fromMinus ? -45 : 45);
      const int code = 2002 + (radial ? 10000 : 0);
      bench.run(measuring(5, start, fmt::format("CYCLE982({},0,1,,,,5,1,,,,,,1,,,{})", code, fromMinus ? 1102 : 102)));
      SCOPED_TRACE(fmt::format("radial {}, from minus {}", radial, fromMinus));
      expectTool(bench, tool.lengths.x(), tool.lengths.y(), tool.radius);
      EXPECT_NEAR(bench.ovr(8), tool.lengths.x(), 1e-6);
      EXPECT_NEAR(bench.ovr(9), -tool.wrong.x(), 1e-6);
      EXPECT_NEAR(bench.ovr(10), tool.lengths.y(), 1e-6);
      EXPECT_NEAR(bench.ovr(11), -tool.wrong.y(), 1e-6);
      EXPECT_NEAR(bench.ovr(12), tool.radius, 1e-6);
      EXPECT_NEAR(bench.ovr(13), -tool.wrongRadius, 1e-6);
      EXPECT_EQ(bench.ovi(3), code);
      const auto& touches = bench.control.journal.cycles.back().touches;
      ASSERT_EQ(touches.size(), 4u);
      // The 1st axis first; across the tool, first the side that it comes from.
      EXPECT_NEAR(std::abs(touches.front().direction.z()), 1, 1e-9);
      EXPECT_NEAR(touches[radial ? 0 : 2].direction[radial ? 2 : 0], fromMinus ? 1 : -1, 1e-9);
      EXPECT_NEAR(bench.machine.position()[1], start.x() + tool.lengths.y() + tool.wrong.y(), 1e-6);
      EXPECT_NEAR(bench.machine.position()[0], start.y() + tool.lengths.x() + tool.wrong.x(), 1e-6);
    }
  }
}

TEST(Cycle982Mill, CompletelyWithoutARadiusTheLengthsAlone) {
  // A needle: what is entered as 0 is 0.
  Planted tool{false, {60, 90}, {0.2, -0.3}, 0.001, -0.001};
  LatheBench bench = benchOf(tool);
  believeWrong(bench, tool);
  bench.run(measuring(5, startOf(false, 45), "CYCLE982(2,0,1,,,,5,1,,,,,,1,,,102)"));
  EXPECT_EQ(bench.control.journal.cycles.back().touches.size(), 2u);
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 60, 0.0011);
  EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 90, 1e-6);
  EXPECT_EQ(bench.data("$TC_DP6", {5, 1}), 0);
}

TEST(Cycle982Mill, AlongAxisWhatIsAskedFor) {
  Planter plant(9831);
  for (const bool radial : {false, true}) {
    const Planted tool = plantedMill(plant, radial);
    const double l1 = tool.lengths.x(), l2 = tool.lengths.y(), w1 = l1 + tool.wrong.x(), w2 = l2 + tool.wrong.y();
    const int lies = radial ? 10000 : 0, across = radial ? 1 : 2, along = radial ? 2 : 1;
    const auto after = [&](int code, int axis, double radius) {
      LatheBench bench = benchOf(tool);
      believeWrong(bench, tool);
      bench.set("$TC_DP6", {5, 1}, radius);
      bench.run(measuring(5, startOf(radial, 30), fmt::format("CYCLE982({},0,1,{},,,5,1)", code + lies, axis)));
      return std::array{bench.data("$TC_DP3", {5, 1}), bench.data("$TC_DP4", {5, 1}), bench.data("$TC_DP6", {5, 1})};
    };
    const auto expect = [](const std::array<double, 3>& found, double length1, double length2, double radius) {
      EXPECT_NEAR(found[0], length1, 1e-6);
      EXPECT_NEAR(found[1], length2, 1e-6);
      EXPECT_NEAR(found[2], radius, 1e-6);
    };
    const double wrong = tool.radius + tool.wrongRadius;
    // The length along the tool, whatever its radius is.
    expect(after(1, along, wrong), radial ? l1 : w1, radial ? w2 : l2, wrong);
    // The length across it needs the radius; a wrong one is found in the
    // length.
    expect(after(1, across, tool.radius), radial ? w1 : l1, radial ? l2 : w2, tool.radius);
    const double shifted = (radial ? l2 : l1) - tool.wrongRadius;
    expect(after(1, across, wrong), radial ? w1 : shifted, radial ? shifted : w2, wrong);
    expect(after(1001, across, wrong), w1, w2, tool.radius);
    expect(after(2001, across, wrong), radial ? w1 : l1, radial ? l2 : w2, tool.radius);
  }
}

TEST(Cycle982Mill, StandsInFrontOfTheFaceThatItTouchedLast) {
  const Planted tool{false, {60, 90}, Vector2::Zero(), 8, 0};
  LatheBench bench = benchOf(tool);
  bench.run(measuring(5, startOf(false, 30), "CYCLE982(2001,0,1,2,2,3,5,1)"));
  EXPECT_NEAR(bench.machine.position()[0] - 60, probeMiddle.x() - half - 8 - 5, 1e-6);
  EXPECT_NEAR(bench.machine.position()[1] - 90, probeMiddle.z() - 3, 1e-6) << "S_ID beyond the middle";
  // From beside the contact the way to its other side would lead through it.
  LatheBench beside = benchOf(tool);
  EXPECT_EQ(beside.alarmOf(measuring(5, {probeMiddle.z(), probeMiddle.x() + 30}, "CYCLE982(2001,0,1,2,1,3,5,1)")),
            "61332");
}

TEST(Cycle982Mill, ReversalTakesTheMeanOfTwoTeeth) {
  const Planted tool{false, {60, 90}, Vector2::Zero(), 8, 0};
  // Tooth 1 at 20 degrees, the other not quite opposite.
  const auto teeth = [](simulation::TrueTool& mill) {
    mill.cutter.teeth = {{.angle = 20, .radial = 0.05}, {.angle = 210, .radial = -0.03, .axial = 0.04}};
  };
  // The side at +X of the contact is touched by the tooth at 180 degrees: SPOS
  // = 160.
  LatheBench bench = benchOf(tool, "mill", teeth);
  bench.run("SETMS(2)\n" + measuring(5, startOf(false, 30), "CYCLE982(101,0,1,2,2,,5,1,,160,-10)"));
  // The axis is met 8.05 and 7.97 from the face.
  EXPECT_NEAR(bench.ovr(9), 0.01, 1e-6);
  EXPECT_EQ(bench.control.journal.cycles.back().touches.size(), 2u);
}

TEST(Cycle982Mill, StartAngleChoosesTheTooth) {
  const Planted tool{false, {60, 90}, Vector2::Zero(), 14, 0};  // so large that its middle is beside the contact
  const auto teeth = [](simulation::TrueTool& mill) {
    mill.cutter.teeth = {{.angle = 0}, {.angle = 180, .radial = -0.2, .axial = -0.1}};
  };
  for (const double angle : {0.0, 180.0}) {
    LatheBench bench = benchOf(tool, "mill", teeth);
    // From +X: the tooth that looks to -X touches the side of the contact.
    bench.run("SETMS(2)\n" +
              measuring(5, startOf(false, 30), fmt::format("CYCLE982(1000001,0,1,2,2,,5,1,,{})", angle)));
    EXPECT_NEAR(bench.ovr(9), angle == 180 ? 0 : -0.2, 1e-6);
    EXPECT_EQ(bench.machine.toolSpindle().angle, angle);
    // The face is touched with the edge that is nearer to the middle, on the
    // side of the start.
    bench.run("SETMS(2)\n" + measuring(5, startOf(false, 30), fmt::format("CYCLE982(1000001,0,1,1,,,5,1,,{})", angle)));
    EXPECT_NEAR(bench.ovr(11), angle == 180 ? 0 : -0.1, 1e-6);
  }
}

TEST(Cycle982Mill, TurningItIsAsLargeAsItsLargestTooth) {
  const Planted tool{true, {60, 90}, {0.1, -0.2}, 8, 0.1};
  const auto teeth = [](simulation::TrueTool& mill) {
    for (int i = 0; i < 3; ++i)
      mill.cutter.teeth.push_back({.angle = 120.0 * i, .radial = i == 1 ? 0.02 : -0.01, .axial = i == 2 ? 0.03 : 0});
  };
  LatheBench bench = benchOf(tool, "mill", teeth);
  believeWrong(bench, tool);
  // At 2 mm/min and 2000 rev/min the axes travel 1 um a turn.
  bench.set("$SNS_MEA_TP_FEED", {0}, 2);
  bench.run(measuring(5, startOf(true, 45), "SETMS(2)\nS2000 M4\nCYCLE982(12002,0,1,,,,1,0.9,,,,,,1,,,102)"));
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 60.03, 1.1e-3);
  EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 90, 1.1e-3);
  EXPECT_NEAR(bench.data("$TC_DP6", {5, 1}), 8.02, 1.1e-3);
  EXPECT_EQ(
      bench.alarmOf(measuring(5, startOf(true, 45), "SETMS(2)\nS2000 M3\nCYCLE982(12002,0,1,,,,1,0.9,,,,,,1,,,102)")),
      "61302");
}

TEST(Cycle982Mill, RearSideOfADiscCutter) {
  Planter plant(9832);
  for (const bool radial : {false, true}) {
    Planted tool = plantedMill(plant, radial);
    tool.radius = 20;
    constexpr double width = 6;
    LatheBench bench = benchOf(tool, "mill", [](simulation::TrueTool& disc) {
      disc.cutter.cutLength = width;
      disc.cutter.shankRadius = 4;
    });
    believeWrong(bench, tool);
    // The edge's length goes to the rear side, the width of the disc above its
    // end.
    const char* length = radial ? "$TC_DP3" : "$TC_DP4";
    bench.set(length, {5, 1}, bench.control.data.number(length, {5, 1}) - width);
    const Vector2 start = radial ? Vector2(460, 205) : Vector2(455, 210);
    bench.run(measuring(5, start, fmt::format("CYCLE982({},0,1,,,,5,1,,,,,,1,,,102)", radial ? 13002 : 3002)));
    expectTool(bench, tool.lengths.x() - (radial ? width : 0), tool.lengths.y() - (radial ? 0 : width), 20);
  }
}

TEST(Cycle982Drill, LengthAlongAndAcross) {
  Planter plant(9833);
  for (const bool radial : {false, true}) {
    Planted tool = plantedMill(plant, radial);
    tool.wrongRadius = 0;
    tool.radius = 5;
    const auto point = [](simulation::TrueTool& drill) { drill.cutter.pointAngle = 118; };
    const int lies = radial ? 10000 : 0;
    for (const int axis : {1, 2}) {
      LatheBench bench = benchOf(tool, "drill", point);
      believeWrong(bench, tool);
      bench.run(
          measuring(5, startOf(radial, 30), fmt::format("CYCLE982({},0,1,{},,,5,1,,,,,,1,,,202)", 1 + lies, axis)));
      EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), tool.lengths.x() + (axis == 2 ? 0 : tool.wrong.x()), 1e-6);
      EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), tool.lengths.y() + (axis == 1 ? 0 : tool.wrong.y()), 1e-6);
    }
    LatheBench bench = benchOf(tool, "drill", point);
    bench.set("$TC_DP6", {5, 1}, 0);
    EXPECT_EQ(bench.alarmOf(measuring(5, startOf(radial, 30),
                                      fmt::format("CYCLE982({},0,1,{},,,5,1)", 1 + lies, radial ? 1 : 2))),
              "61351");
  }
}

TEST(Cycle982Drill, LengthsAsOnMills) {
  // SD 42950 = 0: length 1 lies along Z in G17, along X in G19.
  for (const bool radial : {false, true}) {
    const Planted tool{radial, radial ? Vector2(70, 0) : Vector2(0, 70), Vector2::Zero(), 5, 0};
    LatheBench bench = benchOf(tool, "drill", [](simulation::TrueTool& drill) { drill.cutter.pointAngle = 118; });
    bench.set("$SC_TOOL_LENGTH_TYPE", {}, 0);
    bench.set("$TC_DP3", {5, 1}, 70.3);
    bench.set("$TC_DP4", {5, 1}, 0);
    const Vector2 start = startOf(radial, 30);
    bench.run(fmt::format("{}\nDIAMOF\nT5 D1\nG0 X{}\nG0 Z{}\nCYCLE982(1,0,1,1,,,5,1)", radial ? "G19" : "G17",
                          start.y(), start.x()));
    EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 70, 1e-6);
    EXPECT_EQ(bench.alarmOf(measuring(5, startOf(false, 30), "CYCLE982(1,0,1,1,,,5,1)")), "61314") << "in G18";
  }
}

/// The lathe with a swivel axis B about Y that carries the tool spindle.
setup::Setup swivelling(setup::Setup setup) {
  machine::MachineDescription& machine = setup.world.truth.machine;
  machine.axes.push_back({.name = "B", .kind = machine::AxisKind::Rotary, .minimum = -120, .maximum = 120});
  machine.spindleChain.push_back(
      {.axis = machine.axes.size() - 1, .direction = Vector3::UnitY(), .point = Vector3(10, 0, 20)});
  return setup;
}

TEST(Cycle982Carrier, TurningToolAtAnyAngleInBothAxes) {
  // Cutting edge position 3 in the basic position; turned about Y it points
  // elsewhere.
  for (const double angle : {0.0, -15.0, 20.0, 90.0}) {
    setup::Setup setup = swivelling(toolSetup());
    simulation::TrueTool tool = turningTool(5, 3, {25, 60}, 0.8);
    tool.cutter.insert->firstNormal -= 25;
    tool.cutter.insert->secondNormal += 25;
    add(setup, tool, "turn");
    LatheBench bench(setup);
    bench.set("$MNS_MEA_FUNCTION_MASK", {}, (1 << 16) + 11);
    bench.set("$TC_DP3", {5, 1}, 25.3);
    bench.set("$TC_DP4", {5, 1}, 59.8);
    // Where the tip is believed at B: the cycle takes it to the faces by
    // itself.
    bench.run(
        fmt::format("DIAMOF\nT5 D1\nG0 B{}\nSUPA G0 Z{} D0\nSUPA G0 X{} "
                    "D0\nD1\nCYCLE982(2,0,1,,,,5,1)",
                    angle, angle == 90 ? 290 : 560, angle == 90 ? 270 : 250));
    SCOPED_TRACE(angle);
    EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 25, 1e-6);
    EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 60, 1e-6);
  }
}

TEST(Cycle982Carrier, TurningToolsInG18AtHalfTurnsOfTheirSpindleOnly) {
  setup::Setup setup = swivelling(toolSetup());
  add(setup, turningTool(5, 3, {25, 60}, 0.8), "turn");
  LatheBench bench(setup);
  bench.set("$MNS_MEA_FUNCTION_MASK", {}, (1 << 16) + 11);
  const auto at = [](const char* before) {
    return fmt::format(
        "DIAMOF\nT5 D1\nSETMS(2)\nG0 B10\nSUPA G0 Z560 D0\nSUPA G0 X250 D0\nD1\n{}"
        "CYCLE982(2,0,1,,,,5,1)",
        before);
  };
  EXPECT_EQ(bench.alarmOf(at("SPOS=90\n")), "61329");
  EXPECT_EQ(bench.alarmOf(at("SPOS=0\nG17\n")), "61319");
  // Where carriers do not count, nobody looks at them.
  bench.set("$MNS_MEA_FUNCTION_MASK", {}, 11);
  EXPECT_NE(bench.alarmOf(at("SPOS=90\n")), "61329");
}

TEST(Cycle982Carrier, MillsAtRightAnglesOnly) {
  setup::Setup setup = swivelling(toolSetup());
  add(setup, rotatedTool(5, false, {0, 70}, 6, 4), "mill");
  LatheBench bench(setup);
  bench.set("$MNS_MEA_FUNCTION_MASK", {}, (1 << 16) + 11);
  const auto at = [](double angle, const char* call) {
    return fmt::format("DIAMOF\nT5 D1\nG0 B{}\nSUPA G0 Z500 D0\nSUPA G0 X320 D0\nD1\n{}", angle, call);
  };
  bench.set("$TC_DP4", {5, 1}, 70.4);
  bench.set("$TC_DP6", {5, 1}, 6.2);
  // Turned to -X it lies radially; length 2 is the one along it.
  bench.run(at(90, "CYCLE982(12002,0,1,,,,5,1,,,,,,1,,,102)"));
  EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 70, 1e-6);
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 0, 1e-6);
  EXPECT_NEAR(bench.data("$TC_DP6", {5, 1}), 6, 1e-6);
  EXPECT_EQ(bench.alarmOf(at(80, "CYCLE982(12002,0,1,,,,5,1,,,,,,1,,,102)")), "61329");
  EXPECT_EQ(bench.alarmOf(at(90, "CYCLE982(13002,0,1,,,,5,1,,,,,,1,,,102)")), "61037");
}

}  // namespace
}  // namespace probewright
