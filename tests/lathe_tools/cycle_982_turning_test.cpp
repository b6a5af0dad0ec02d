#include "lathe_tools/tool_bench.hpp"
#include "support/result_screen.hpp"

/// CYCLE982: the tool touch probe of a lathe is calibrated, turning tools are
/// measured with it.
namespace probewright {
namespace {

using namespace testing_support;

/// The true faces of the contact, (Z, X): touched in minus direction, in plus
/// direction.
double face(int axis, double direction, const Vector3& middle = probeMiddle) {
  return (axis == 1 ? middle.z() : middle.x()) - direction * half;
}

constexpr int geometry = 0, wear = 1;

TEST(Cycle982Calibrates, AllFourSidesWithACalibratingTool) {
  Planter plant(9820);
  for (int world = 0; world < 3; ++world) {
    const double pretravel = plant.number(0, 0.02), radius = plant.number(3, 6);
    setup::Setup setup = toolSetup([&](auto& probe) { probe.pretravel = pretravel; });
    add(setup, calibrationPin(9, {plant.number(60, 90), plant.number(20, 50)}, radius), "calibration");
    LatheBench bench(setup);
    for (int axis = 1; axis <= 2; ++axis)
      for (const double direction : {-1.0, 1.0})
        bench.set(triggerName(axis, direction), {0}, face(axis, direction) + plant.number(-0.9, 0.9));
    // From the four sides, and once with the direction given from beside
    // another face.
    for (int axis = 1; axis <= 2; ++axis) {
      for (const double direction : {-1.0, 1.0}) {
        const double before = bench.control.data.number(triggerName(axis, direction), {0});
        Vector2 start(probeMiddle.z(), probeMiddle.x());
        start[axis - 1] -= direction * 40;
        bench.run(measuring(9, start, fmt::format("CYCLE982(0,,1,{},0,,5,2,240)", axis)));
        const double found = face(axis, direction) + direction * pretravel;
        EXPECT_NEAR(bench.data(triggerName(axis, direction), {0}), found, 1e-6);
        const int result = 4 + 4 * axis + (direction < 0 ? 0 : 2);
        EXPECT_NEAR(bench.ovr(result), found, 1e-6);
        EXPECT_NEAR(bench.ovr(result + 1), found - before, 1e-6);
        EXPECT_EQ(bench.ovr(28), 2);
        EXPECT_EQ(bench.ovi(2), 982);
        EXPECT_EQ(bench.ovi(3), 0);
        EXPECT_EQ(bench.ovi(5), 1);
        EXPECT_EQ(bench.ovi(9), 0);
        // The tool stands the measuring path in front of the face that was
        // expected.
        const Vector3 tip = bench.control.channel.position().vector();
        const double edge = (axis == 1 ? tip.z() : tip.x()) + radius + direction * radius;
        EXPECT_NEAR(edge, before - direction * 5, 1e-6);
      }
    }
    EXPECT_EQ(bench.data("$SNS_MEA_TP_FEED", {0}), 240);
  }
}

TEST(Cycle982Calibrates, TwoSidesWithATurningTool) {
  for (int position = 1; position <= 4; ++position) {
    setup::Setup setup = toolSetup();
    add(setup, turningTool(5, position, {80, 40}, 0.8), "turn");
    LatheBench bench(setup);
    for (int axis = 1; axis <= 2; ++axis) {
      const double direction = pointing(position)[axis - 1];
      bench.set(triggerName(axis, direction), {0}, face(axis, direction) + 0.3);
      bench.run(measuring(5, startOf(position), fmt::format("CYCLE982(0,,1,{},0,,5,2,,,,,,3)", axis)));
      EXPECT_NEAR(bench.data(triggerName(axis, direction), {0}), face(axis, direction), 1e-6) << position;
      // The other side of the axis is not its side.
      EXPECT_EQ(bench.alarmOf(measuring(5, startOf(position),
                                        fmt::format("CYCLE982(0,,1,{},{},,5,2)", axis, direction > 0 ? 2 : 1))),
                "61332");
    }
  }
}

TEST(Cycle982Calibrates, WrongByWhatTheCalibratingToolIsWrong) {
  // The control takes the ball for 0.01 mm larger than it is: sides that the
  // corner of the lengths is on come out right, the others wrong by the
  // diameter.
  setup::Setup setup = toolSetup();
  add(setup, calibrationPin(9, {70, 30}, 5), "calibration");
  LatheBench bench(setup);
  bench.set("$TC_DP6", {9, 1}, 5.01);
  bench.run(measuring(9, {440, 150}, "CYCLE982(0,,1,1,2,,5,2)"));
  bench.run(measuring(9, {360, 150}, "CYCLE982(0,,1,1,1,,5,2)"));
  EXPECT_NEAR(bench.data(triggerName(1, -1), {0}), face(1, -1), 1e-6);
  EXPECT_NEAR(bench.data(triggerName(1, 1), {0}), face(1, 1) + 0.02, 1e-6);
}

TEST(Cycle982Calibrates, FromWhereTheToolIsWithoutAnyApproximateValue) {
  setup::Setup setup = toolSetup();
  add(setup, turningTool(5, 3, {80, 40}, 0.8), "turn");
  LatheBench bench(setup);
  for (int axis = 1; axis <= 2; ++axis)
    for (const double direction : {-1.0, 1.0})
      bench.set(triggerName(axis, direction), {0}, 0);
  bench.run(measuring(5, {418, 150}, "CYCLE982(100000,,1,1,2,,5,0.5)"));
  EXPECT_NEAR(bench.data(triggerName(1, -1), {0}), 410, 1e-6);
  EXPECT_NEAR(bench.control.channel.position().z(), 418, 1e-6) << "back where it was";
  bench.run(measuring(5, {400, 166}, "CYCLE982(100000,,1,2,2,,5,0.5)"));
  EXPECT_NEAR(bench.data(triggerName(2, -1), {0}), 160, 1e-6);
  // Now there is a value, and the safe area counts.
  bench.set(triggerName(2, -1), {0}, 161);
  EXPECT_EQ(bench.alarmOf(measuring(5, {400, 166}, "CYCLE982(100000,,1,2,2,,5,0.5)")), "61303");
  EXPECT_EQ(bench.data(triggerName(2, -1), {0}), 161);
}

/// A turning tool of every cutting edge position whose lengths the control has
/// wrong.
struct Planted {
  int position = 3;
  Vector2 lengths = {80, 40};  ///< X, Z
  Vector2 wrong = Vector2::Zero();
  double nose = 0.8;
};

setup::Setup worldOf(const Planted& tool, const std::function<void(simulation::TrueToolProbe&)>& change = {}) {
  setup::Setup setup = toolSetup(change);
  add(setup, turningTool(5, tool.position, tool.lengths, tool.nose), "turn");
  return setup;
}

void believeWrong(LatheBench& bench, const Planted& tool) {
  bench.set("$TC_DP3", {5, 1}, tool.lengths.x() + tool.wrong.x());
  bench.set("$TC_DP4", {5, 1}, tool.lengths.y() + tool.wrong.y());
}

TEST(Cycle982Turning, FindsTheLengthsOfEveryCuttingEdgePosition) {
  Planter plant(9821);
  for (int position = 1; position <= 8; ++position) {
    for (int round = 0; round < 2; ++round) {
      Planted tool{position,
                   {plant.number(50, 90), plant.number(20, 60)},
                   {plant.number(-0.5, 0.5), plant.number(-0.5, 0.5)},
                   round == 0 ? plant.number(0.2, 1.6) : 0.0};
      // Tools that point to +X are held from below.
      if (pointing(position).y() > 0) tool.lengths.x() = -tool.lengths.x();
      LatheBench bench(worldOf(tool));
      believeWrong(bench, tool);
      const Vector2 start = startOf(position);
      bench.run(measuring(5, start, "CYCLE982(2,0,1,,,,5,1,,,,,,1,,,2)"));
      const Vector2 points = pointing(position);
      const bool x = points.y() != 0, z = points.x() != 0;
      SCOPED_TRACE(fmt::format("cutting edge position {}, nose {}", position, tool.nose));
      EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), tool.lengths.x() + (x ? 0 : tool.wrong.x()), 1e-6);
      EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), tool.lengths.y() + (z ? 0 : tool.wrong.y()), 1e-6);
      EXPECT_NEAR(bench.ovr(8), x ? tool.lengths.x() : 0, 1e-6);
      EXPECT_NEAR(bench.ovr(9), x ? -tool.wrong.x() : 0, 1e-6);
      EXPECT_NEAR(bench.ovr(10), z ? tool.lengths.y() : 0, 1e-6);
      EXPECT_NEAR(bench.ovr(11), z ? -tool.wrong.y() : 0, 1e-6);
      EXPECT_EQ(bench.ovi(0), 1);
      EXPECT_EQ(bench.ovi(8), 5);
      // Back at the start, by the lengths that the program began with.
      EXPECT_NEAR(bench.machine.position()[1], start.x() + tool.lengths.y() + tool.wrong.y(), 1e-6);
      EXPECT_NEAR(bench.machine.position()[0], start.y() + tool.lengths.x() + tool.wrong.x(), 1e-6);
      // Measured again, nothing is left.
      bench.run(measuring(5, start, "CYCLE982(2,0,1,,,,5,1)"));
      EXPECT_NEAR(bench.ovr(9), 0, 1e-6);
      EXPECT_NEAR(bench.ovr(11), 0, 1e-6);
    }
  }
}

TEST(Cycle982Turning, MeasuresOneLengthAlongOneAxisAndStandsInFrontOfTheFace) {
  const Planted tool{3, {80, 40}, {0.3, -0.2}, 0.8};
  for (const int axis : {1, 2}) {
    LatheBench bench(worldOf(tool));
    believeWrong(bench, tool);
    bench.run(measuring(5, startOf(3), fmt::format("CYCLE982(1,0,1,{},,,6,1)", axis)));
    EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), axis == 2 ? 80 : 80.3, 1e-6);
    EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), axis == 1 ? 40 : 39.8, 1e-6);
    // With the lengths that were believed when it was led there.
    const double tip = axis == 1 ? bench.machine.position()[1] - 39.8 : bench.machine.position()[0] - 80.3;
    EXPECT_NEAR(tip, face(axis, -1) + 6, 1e-6);
    // The nose's centre is on the middle of the contact.
    const double beside = axis == 1 ? bench.machine.position()[0] - 80.3 : bench.machine.position()[1] - 39.8;
    EXPECT_NEAR(beside + 0.8, axis == 1 ? probeMiddle.x() : probeMiddle.z(), 1e-6);
  }
}

TEST(Cycle982Turning, GeometryTakesTheWearWithItAndWearTheDifference) {
  const Planted tool{3, {80, 40}, {0.3, -0.2}, 0.8};
  for (const int target : {geometry, wear}) {
    LatheBench bench(worldOf(tool));
    believeWrong(bench, tool);
    bench.set("$TC_DP12", {5, 1}, -0.1);
    bench.run(measuring(5, startOf(3), fmt::format("CYCLE982(2,{},1,,,,5,1)", target)));
    EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), target == geometry ? 80 : 80.3, 1e-6);
    EXPECT_NEAR(bench.data("$TC_DP12", {5, 1}), target == geometry ? 0 : -0.3, 1e-6);
    EXPECT_NEAR(bench.data("$TC_DP13", {5, 1}), target == geometry ? 0 : 0.2, 1e-6);
    EXPECT_NEAR(bench.ovr(8), 80, 1e-6);
    EXPECT_NEAR(bench.ovr(9), -0.2, 1e-6);
  }
}

TEST(Cycle982Turning, Length1ThatCountsAsADiameterIsCorrectedTwice) {
  const Planted tool{3, {80, 40}, {0.3, 0}, 0.8};
  LatheBench bench(worldOf(tool));
  bench.set("$MC_TOOL_PARAMETER_DEF_MASK", {}, 2);
  bench.set("$TC_DP3", {5, 1}, 2 * 80.3);
  bench.run(measuring(5, startOf(3), "CYCLE982(1,0,1,2,,,5,1)"));
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 160, 1e-6);
  EXPECT_NEAR(bench.ovr(8), 80, 1e-6);
}

TEST(Cycle982Turning, LimitsDecideWhatIsCorrected) {
  const Planted tool{3, {80, 40}, {0.3, 0.02}, 0.8};
  LatheBench bench(worldOf(tool));
  const auto call = [&](const char* limits) {
    believeWrong(bench, tool);
    return measuring(5, startOf(3), fmt::format("CYCLE982(2,0,1,,,,5,{})", limits));
  };
  // Length 2 is within the zero offset range.
  bench.run(call("1,,,,0.05,0.5"));
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 80, 1e-6);
  EXPECT_EQ(bench.data("$TC_DP4", {5, 1}), 40.02);
  EXPECT_EQ(bench.ovr(27), 0.05);
  EXPECT_EQ(bench.ovr(29), 0.5);
  // Length 1 exceeds the dimensional difference: a message, and neither is
  // corrected.
  bench.run(call("1,,,,0,0.2"));
  EXPECT_EQ(bench.ovi(9), 61306);
  EXPECT_EQ(bench.data("$TC_DP3", {5, 1}), 80.3);
  EXPECT_EQ(bench.data("$TC_DP4", {5, 1}), 40.02);
  EXPECT_NEAR(bench.ovr(9), -0.3, 1e-6);
  // The safe area stops the program.
  EXPECT_EQ(bench.alarmOf(call("0.25")), "61303");
  EXPECT_EQ(bench.data("$TC_DP4", {5, 1}), 40.02);
}

TEST(Cycle982Turning, EmpiricalValueIsTakenOffTheDifference) {
  const Planted tool{3, {80, 40}, {0.3, 0}, 0.8};
  LatheBench bench(worldOf(tool));
  believeWrong(bench, tool);
  bench.set("$SCS_MEA_EMPIRIC_VALUE", {4}, 0.01);
  bench.run(measuring(5, startOf(3), "CYCLE982(1,0,1,2,,,5,1,,,,,,1,5)"));
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 79.99, 1e-6);
  EXPECT_NEAR(bench.ovr(9), -0.31, 1e-6);
  EXPECT_EQ(bench.ovr(30), 0.01);
  EXPECT_EQ(bench.ovi(7), 5);
}

TEST(Cycle982Turning, RepeatsFromWhereItStartedIfTheMachineDoes) {
  const Planted tool{3, {80, 40}, {0.3, 0}, 0.8};
  LatheBench bench(worldOf(tool));
  believeWrong(bench, tool);
  bench.set("$SNS_MEA_FUNCTION_MASK", {}, 1 << 16);
  EXPECT_EQ(bench.alarmOf(measuring(5, startOf(3), "CYCLE982(1,0,1,2,,,5,0.1)")), "61303");
  EXPECT_EQ(bench.control.journal.cycles.back().touches.size(), 5u) << "four times again";
}

TEST(Cycle982Turning, LengthsAreWrongByWhatTheTriggerPointsAreWrong) {
  const Planted tool{3, {80, 40}, Vector2::Zero(), 0.8};
  LatheBench bench(worldOf(tool));
  bench.set(triggerName(1, -1), {0}, 410.03);
  bench.set(triggerName(2, -1), {0}, 159.96);
  bench.run(measuring(5, startOf(3), "CYCLE982(2,0,1,,,,5,1)"));
  // The tip is believed where the face is not.
  EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 40 - 0.03, 1e-6);
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 80 + 0.04, 1e-6);
}

TEST(Cycle982Turning, ATiltedContactIsTouchedBesideItsMiddleByTheNose) {
  // The face leans by 1 degree about Y. The nose's centre runs to the middle of
  // the contact: the nose meets the face r (1 / cos - 1) later than the flat
  // one, h (1 / cos - 1) from the middle of the face away.
  constexpr double degrees = 1;
  setup::Setup setup = latheSetup({});
  placeCube(setup.world.truth, probeMiddle, "TT", rotation(Vector3::UnitY(), degrees));
  add(setup, turningTool(5, 3, {80, 40}, 0.8), "turn");
  LatheBench bench(setup);
  for (int axis = 1; axis <= 2; ++axis)
    for (const double direction : {-1.0, 1.0})
      bench.set(triggerName(axis, direction), {0}, face(axis, direction));
  bench.run(measuring(5, startOf(3), "CYCLE982(1,0,1,1,,,5,1)"));
  const double stretched = 1 / std::cos(radiansFromDegrees(degrees)) - 1;
  EXPECT_NEAR(bench.ovr(11), (half + 0.8) * stretched, 1e-6);
}

TEST(Cycle982Turning, WorkpieceCoordinatesAlsoOfTheCounterSpindle) {
  const Planted tool{4, {80, -40}, {0.2, -0.15}, 0.8};
  for (const bool mirrored : {false, true}) {
    // Cutting edge position 4 points to +Z: seen from the counter-spindle to
    // -Z.
    LatheBench bench(worldOf(tool));
    believeWrong(bench, tool);
    plantFrame(bench, "$P_UIFR", 1, 0, 300);
    if (mirrored) bench.set("$P_UIFR", {1, "Z", "MI"}, 1);
    const auto seen = [&](double z) { return mirrored ? 300 - z : z - 300; };
    bench.set(triggerName(1, -1, "TPW"), {1}, mirrored ? seen(390) : seen(410));
    bench.set(triggerName(1, 1, "TPW"), {1}, mirrored ? seen(410) : seen(390));
    bench.set(triggerName(2, -1, "TPW"), {1}, 160);
    bench.set(triggerName(2, 1, "TPW"), {1}, 140);
    bench.run(fmt::format("DIAMOF\nT5 D1\nG0 Z{}\nG0 X190\nCYCLE982(12,0,2,,,,5,1)", seen(360)));
    EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 80, 1e-6) << mirrored;
    EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), -40, 1e-6) << mirrored;
    EXPECT_EQ(bench.ovi(5), 2);
  }
}

TEST(Cycle982Turning, EachSpindleHasAProbeAndADataField) {
  const Vector3 second(150, 0, 620);
  setup::Setup setup = latheSetup({});
  placeCube(setup.world.truth, probeMiddle, "main");
  placeCube(setup.world.truth, second, "counter");
  setup.beliefs.toolProbes = setup::believedToolProbes(setup.world);
  add(setup, turningTool(5, 3, {80, 40}, 0.8), "turn");
  LatheBench bench(setup);
  EXPECT_EQ(bench.data(triggerName(1, -1), {1}), 630);
  for (const int field : {1, 2}) {
    bench.set("$TC_DP4", {5, 1}, 40.1);
    const Vector2 start(field == 1 ? 440 : 660, 190);
    bench.run(measuring(5, start, fmt::format("CYCLE982(2,0,{},,,,5,1)", field)));
    EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 40, 1e-6);
    EXPECT_EQ(bench.ovi(5), field);
  }
}

TEST(Cycle982Turning, IncrementallyFromWhereTheToolStands) {
  const Planted tool{8, {80, 40}, {0.3, 0}, 0.8};
  LatheBench bench(worldOf(tool));
  believeWrong(bench, tool);
  bench.run(measuring(5, {404, 166}, "CYCLE982(100001,0,1,2,2,,6,1)"));
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 80, 1e-6);
  EXPECT_NEAR(bench.machine.position()[1], 404 + 40, 1e-6) << "no motion along the other axis";
}

TEST(Cycle982Turning, ScreensAndLogsTellWhatWasFound) {
  const Planted tool{3, {80, 40}, {0.3, -0.2}, 0.8};
  for (const int code : {0, 2}) {
    LatheBench bench(worldOf(tool));
    showAndLog(bench.control);
    bench.set(triggerName(1, -1), {0}, code == 0 ? 410.2 : 410);
    if (code == 2) believeWrong(bench, tool);
    bench.run(measuring(5, startOf(3), fmt::format("CYCLE982({},0,1,{},,,5,1)", code, code == 0 ? "1" : "")));
    expectScreenAndLogs(bench.control, "CYCLE982", code);
    const ResultScreen screen(bench.control.journal.cycles.back().screens.back());
    using Words = std::vector<std::string>;
    if (code == 0) {
      EXPECT_EQ(screen.row("trigger point, minus direction, 1st axis [mm]"), (Words{"410.0000", "-0.2000"}));
    } else {
      EXPECT_EQ(screen.row("length 1 [mm]"), (Words{"80.0000", "-0.3000"}));
      EXPECT_EQ(screen.row("length 2 [mm]"), (Words{"40.0000", "0.2000"}));
    }
  }
}

TEST(Cycle982Turning, OldCallHasTheSameVariables) {
  const Planted tool{3, {80, 40}, {0.3, -0.2}, 0.8};
  LatheBench bench(worldOf(tool));
  believeWrong(bench, tool);
  bench.run(measuring(5, startOf(3),
                      "_CHBIT[3]=1\n_MVAR=1 _MA=2 _FA=5 _TSA=1 _PRNUM=1 _TZL=0.01 "
                      "_TDIF=0.5\nCYCLE982"));
  EXPECT_NEAR(bench.data("$TC_DP12", {5, 1}), -0.3, 1e-6);
  EXPECT_EQ(bench.data("$TC_DP3", {5, 1}), 80.3);
  EXPECT_EQ(bench.ovr(27), 0.01);
}

}  // namespace
}  // namespace probewright
