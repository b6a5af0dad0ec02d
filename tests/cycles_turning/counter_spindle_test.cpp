#include "control/sinumerik/tool_data.hpp"
#include "support/lathe_bench.hpp"

/// Probes that point to any side, and parts in the counter-spindle, whose workpiece system is mirrored.
namespace probewright {
namespace {

using namespace testing_support;

/// A bar that the counter-spindle holds: its face at Z `face` looks towards the main spindle.
void counterBar(setup::Setup& setup, double radius, double face) {
  place(setup.world.truth, simulation::RoundBar(radius, 0, 100), translation({0, 0, face}));
}

LatheProbe probeTowards(Planter& plant, int position) {
  LatheProbe probe;
  probe.position = position;
  probe.length = plant.number(80, 120);
  probe.ballRadius = plant.number(1, 3);
  probe.mount = position == 8 ? Vector3(0, 0, 0) : position == 6 ? Vector3(-60, 0, 0) : Vector3(-75, 0, 0);
  probe.pretravel = plant.number(0, 0.02);
  probe.axialPretravel = plant.number(0, 0.02);
  return probe;
}

TEST(ToolPositions, EachPointsWhereItsNumberSays) {
  // One surface for each position; calibrated on it in its direction, then measured.
  Planter plant(5678);
  for (int world = 0; world < 40; ++world) {
    const int position = 5 + world % 4;
    setup::Setup setup = latheSetup(probeTowards(plant, position));
    const double error = plant.number(-0.8, 0.8);
    std::string way, calibrate, measure;
    switch (position) {
      case 5:  // to +Z, against a face of the counter-spindle
        counterBar(setup, 30, 300 + error);
        way = "G0 Z-60\nG0 X40\nG0 Z-15\n";
        calibrate = fmt::format("CYCLE973(1100,1,,{:.12f},1,0,6,4,200,1,,2,0)\n", error);
        measure = "CYCLE974(0,,,1,0,1,6,4,,1,\"\",,0,0,0,0,0,1,0,,2,0)";
        break;
      case 6:  // to +X, against the wall of a bore
        place(setup.world.truth, simulation::Box({40 + error, -30, -80}, {70, 30, 0}), translation({0, 0, 300}));
        way = "G0 Z40\nG0 X50\nG0 Z-10\n";
        calibrate = fmt::format("CYCLE973(1100,1,,{:.12f},2,0,6,4,200,1,,2,0)\n", 80 + 2 * error);
        measure = "CYCLE974(1,,,1,80,2,6,4,,1,\"\",,0,0,0,0,0,1,0,,2,0)";
        break;
      case 7:  // to -Z, against a face
        place(setup.world.truth, simulation::RoundBar(30, -100, 0), translation({0, 0, 300 + error}));
        way = "G0 Z60\nG0 X40\nG0 Z15\n";
        calibrate = fmt::format("CYCLE973(1100,1,,{:.12f},1,1,6,4,200,1,,2,0)\n", error);
        measure = "CYCLE974(0,,,1,0,1,6,4,,1,\"\",,0,0,0,0,0,1,0,,2,0)";
        break;
      default:  // to -X, on an outside diameter
        place(setup.world.truth, simulation::RoundBar(40 + error, -100, 0), translation({0, 0, 300}));
        way = "G0 X140\nG0 Z-10\n";
        calibrate = fmt::format("CYCLE973(1100,1,,{:.12f},2,1,6,4,200,1,,2,0)\n", 80 + 2 * error);
        measure = "CYCLE974(2,,,1,80,2,6,4,,1,\"\",,0,0,0,0,0,1,0,,2,0)";
    }
    LatheBench bench(setup);
    EXPECT_EQ(bench.data("$TC_DP2", {1, 1}), position);
    plantFrame(bench, "$P_UIFR", 1, 0, 300);
    bench.run("DIAMON\nG0 X300\n" + way + calibrate + measure);
    const double set = position % 2 == 0 ? 80 : 0;
    EXPECT_NEAR(bench.ovr(4), set + (set > 0 ? 2 : 1) * error, 1e-8) << position;
    const double radius = setup.world.truth.tools[0].probe.ballRadius - setup.world.truth.tools[0].probe.axialPretravel;
    const bool plus = position < 7;
    const std::string name =
        fmt::format("$SNS_MEA_WP_TRIG_{}_DIR_AX{}", plus ? "PLUS" : "MINUS", position % 2 == 0 ? 2 : 1);
    EXPECT_NEAR(bench.data(name, {0}), plus ? radius : -radius, 1e-8) << position;
  }
}

TEST(CounterSpindle, MeasuresInTheMirroredSystem) {
  Planter plant(4711);
  for (int world = 0; world < 40; ++world) {
    setup::Setup setup = latheSetup(probeTowards(plant, 5));
    const double error = plant.number(-0.8, 0.8), set = plant.number(-1, 1);
    counterBar(setup, 30, 300 - error);  // 0.x too long, seen from the mirrored system
    LatheBench bench(setup);
    // The other direction's trigger point is none of its business.
    bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0}, -9);
    plantFrame(bench, "$P_UIFR", 1, 0, 300);
    bench.set("$P_UIFR", {1, "Z", "MI"}, 1);
    const std::string way = "DIAMON\nG0 X300\nG0 Z60\nG0 X40\nG0 Z15\n";
    const int knum = world % 2 == 0 ? 1 : 10001;
    bench.run(way + fmt::format("CYCLE974(100,{},,1,{:.12f},1,6,4,,1,\"\",,0,0,0,0,0,1,0,,2,0)", knum, set));
    EXPECT_NEAR(bench.ovr(4), error, 1e-8) << world;
    EXPECT_NEAR(bench.ovr(16), error - set, 1e-8);
    const Vector3 onFace = bench.control.machineFromWorkpiece().inverse() * Vector3(20, 0, 300 - error);
    EXPECT_NEAR(onFace.z(), set, 1e-8) << world;
    EXPECT_EQ(bench.data("$P_UIFR", {1, "Z", "MI"}), 1) << "still mirrored";
  }
}

TEST(CounterSpindle, Cycle978SetsTheFaceInTheMirroredSystem) {
  // With the tool type of lathes; every target, from every side of 0.
  Planter plant(4712);
  constexpr const char* targets[] = {"1", "10001", "9000", "1001", "11001", "3001", "13001"};
  for (int world = 0; world < 42; ++world) {
    setup::Setup setup = latheSetup(probeTowards(plant, 5));
    const double error = plant.number(-0.8, 0.8), set = plant.number(-1, 1);
    counterBar(setup, 30, 300 - error);
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, 300);
    bench.set("$P_UIFR", {1, "Z", "MI"}, 1);
    bench.run(fmt::format("DIAMON\nG0 X300\nG0 Z60\nG0 X40\nG0 Z15\nCYCLE978(100,{},,1,{:.12f},6,4,1,2)",
                          targets[world % 7], set));
    EXPECT_NEAR(bench.ovr(4), error, 1e-8) << world;
    EXPECT_NEAR(bench.ovr(16), error - set, 1e-8);
    const Vector3 onFace = bench.control.machineFromWorkpiece().inverse() * Vector3(20, 0, 300 - error);
    EXPECT_NEAR(onFace.z(), set, 1e-8) << world << " into " << targets[world % 7];
  }
}

TEST(CounterSpindle, CorrectsTheToolTheOtherWayRound) {
  // In the main spindle a face too far out means a tool longer than its data say; mirrored, a shorter one.
  for (const bool mirrored : {false, true}) {
    LatheProbe probe;
    probe.position = mirrored ? 5 : 7;
    probe.mount = {-75, 0, 0};
    setup::Setup setup = latheSetup(probe);
    if (mirrored) {
      counterBar(setup, 30, 300 - 0.04);
    } else {
      place(setup.world.truth, simulation::RoundBar(30, -100, 0), translation({0, 0, 300.04}));
    }
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, 300);
    if (mirrored) bench.set("$P_UIFR", {1, "Z", "MI"}, 1);
    bench.run(
        "DIAMON\nG0 X300\nG0 Z60\nG0 X40\nG0 Z15\n"
        "CYCLE974(200,,1,1,0,1,6,4,,1,\"FINISH\",,0,0,0,0,0,1,0,,2,0)");
    EXPECT_NEAR(bench.ovr(4), 0.04, 1e-9);
    EXPECT_NEAR(bench.data("$TC_DP13", {2, 1}), mirrored ? 0.04 : -0.04, 1e-9) << "length 2 acts in Z";
    EXPECT_EQ(bench.data("$TC_DP12", {2, 1}), 0);
  }
}

TEST(CounterSpindle, MeasuresDiametersByOneAndByTwoPoints) {
  // X is not mirrored: trigger points and tool corrections across stay as they are; the way round leads along the
  // mirrored Z, off the face.
  Planter plant(4712);
  for (int world = 0; world < 30; ++world) {
    LatheProbe probe = probeTowards(plant, 5);
    probe.mount = {plant.number(-90, -80), 0, 0};
    setup::Setup setup = latheSetup(probe);
    const double radius = plant.number(15, 22), wrong = plant.number(-0.3, 0.3);
    counterBar(setup, radius, 300);
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, 300);
    bench.set("$P_UIFR", {1, "Z", "MI"}, 1);
    const bool two = world % 2 == 0, tool = world % 3 == 0;
    const std::string call =
        two ? fmt::format("CYCLE994({},,{},1,{:.12f},2,0,30,4,3,1,\"{}\",,0.0001,0,0,0,0,1,0,,2,0)", tool ? 202 : 2,
                          tool ? 1 : 0, 2 * (radius - wrong), tool ? "FINISH" : "")
            : fmt::format("CYCLE974({},,{},1,{:.12f},2,4,3,,1,\"{}\",,0.0001,0,0,0,0,1,0,,2,0)", tool ? 202 : 2,
                          tool ? 1 : 0, 2 * (radius - wrong), tool ? "FINISH" : "");
    bench.run("DIAMON\nG0 X300\nG0 Z60\nG0 X90\nG0 Z-10\n" + call);
    EXPECT_NEAR(bench.ovr(4), 2 * radius, 1e-8) << world;
    EXPECT_NEAR(bench.ovr(16), 2 * wrong, 1e-8);
    if (tool) {
      EXPECT_NEAR(bench.data("$TC_DP12", {2, 1}), std::abs(2 * wrong) > 0.0001 ? -wrong : 0, 1e-8);
    }
  }
}

TEST(CounterSpindle, CalibratesInTheDirectionsOfTheMachine) {
  LatheProbe probe;
  probe.position = 5;
  probe.mount = {-75, 0, 0};
  probe.axialPretravel = 0.015;
  setup::Setup setup = latheSetup(probe);
  counterBar(setup, 30, 300);
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, 300);
  bench.set("$P_UIFR", {1, "Z", "MI"}, 1);
  bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 1.5);
  const double other = bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0});
  bench.run("DIAMON\nG0 X300\nG0 Z60\nG0 X40\nG0 Z15\nCYCLE973(1100,1,,0,1,1,6,4,200,1,,2,0)");
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}), 2 - 0.015, 1e-8);
  EXPECT_EQ(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0}), other);
  EXPECT_NEAR(bench.ovr(10), 2 - 0.015, 1e-8);
}

TEST(ToolData, Md20360CountsLengthsOfTheTransverseAxisAsDiameters) {
  for (const int mask : {0, 1, 2, 3}) {
    LatheProbe probe;
    setup::Setup setup = latheSetup(probe);
    place(setup.world.truth, simulation::RoundBar(20.03, -100, 0), translation({0, 0, 150}));
    LatheBench bench(setup);
    bench.set("$MC_TOOL_PARAMETER_DEF_MASK", {}, mask);
    plantFrame(bench, "$P_UIFR", 1, 0, 150);
    const auto lengthInX = [&] { return control::sinumerik::toolEdge(bench.control.data, 2, 1)->totalLength()[0]; };
    for (const int memory : {0, 4}) {
      const double before = lengthInX();
      bench.run(fmt::format("DIAMON\nG0 X120\nG0 Z-10\nCYCLE974(202,,{},1,40,2,4,1,,1,\"FINISH\",,0,0,0,0,0,1,0,,2,0)",
                            1000000 * memory + 1));
      EXPECT_NEAR(lengthInX() - before, -0.03, 1e-9) << "what acts, whatever the data count";
      const char* name = memory == 0 ? "$TC_DP12" : "$TC_DP3";
      const double start = memory == 0 ? 0 : 80;
      EXPECT_NEAR(bench.data(name, {2, 1}) - start, (mask >> (memory == 0 ? 0 : 1) & 1) != 0 ? -0.06 : -0.03, 1e-9);
    }
  }
}

}  // namespace
}  // namespace probewright
