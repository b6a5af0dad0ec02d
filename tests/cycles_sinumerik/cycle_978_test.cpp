#include "support/sinumerik_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

/// A block with its top corner region about the origin of a pose: faces at x = 0, y = 0, z = 0 look into minus X, minus
/// Y and plus Z.
simulation::Truth blockAt(const Pose& tableFromBlock) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, 0, -60}, {120, 100, 0}), tableFromBlock);
  return truth;
}

TEST(Cycle978, ShiftsTheZeroOffsetSoThatTheFaceHasItsSetValue) {
  Planter plant(978);
  for (int world = 0; world < 60; ++world) {
    // The block stands as the workpiece system believes, but displaced; base and settable frame both turn.
    const double turn = plant.number(-40, 40);
    const Vector3 basePlace = Vector3(0, 0, -350) + plant.within(40);
    const Vector3 offset = plant.within(30);
    const Vector3 error = plant.within(2);
    const Pose believed = translation(basePlace) * rotation(Vector3::UnitZ(), turn) * translation(offset) *
                          rotation(Vector3::UnitZ(), 15);
    SinumerikBench bench(blockAt(believed * translation(error)));
    plantFrame(bench, "$P_CHBFR", 0, basePlace, {0, 0, turn});
    plantFrame(bench, "$P_UIFR", 2, offset, {0, 0, 15});
    const int axis = world % 3;
    const double set = plant.number(-5, 5);
    Vector3 start(20, 20, -10);
    start[axis] = axis == 2 ? 12 : -12;
    bench.start(start, 2);
    // Fine and coarse; settable frame by number, the active one, and the base frame further out.
    const int knum[] = {2, 10002, 9000, 1001, 11001, 19000};
    bench.run("CYCLE978", {{"S_MVAR", 100},
                           {"S_KNUM", static_cast<double>(knum[world % 6])},
                           {"S_PRNUM", 1},
                           {"S_SETV", set},
                           {"S_FA", 9},
                           {"S_TSA", 9},
                           {"S_MA", axis + 1.0},
                           {"S_MD", axis == 2 ? 2.0 : 1.0}});
    const Vector3 onFace = believed * translation(error) * (Vector3(30, 30, 0) - 30 * Vector3::Unit(axis) * (axis < 2));
    EXPECT_NEAR(inWorkpiece(bench, onFace)[axis], set, 1e-9) << "world " << world;
    EXPECT_NEAR(bench.ovr(4), error[axis], 1e-9);
    EXPECT_NEAR(bench.ovr(5 + axis), error[axis], 1e-9);
    EXPECT_NEAR(bench.ovr(16), error[axis] - set, 1e-9);
    EXPECT_EQ(bench.ovi(2), 978);
    EXPECT_EQ(bench.ovi(11), 1);
    // The other axes of the workpiece system stay where they are.
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      EXPECT_NEAR(inWorkpiece(bench, believed * Vector3::Zero())[other], 0, 1e-9);
    }
  }
}

TEST(Cycle978, WritesFineOrCoarseIntoTheFrameAskedFor) {
  SinumerikBench bench(blockAt(translation({1.25, 0, -350})));
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  plantFrame(bench, "$P_UIFR", 5, {0, 0, -350});
  const auto measure = [&](int knum) {
    bench.start({-12, 20, -10});
    bench.run(
        "CYCLE978",
        {{"S_MVAR", 100}, {"S_KNUM", static_cast<double>(knum)}, {"S_FA", 9}, {"S_TSA", 9}, {"S_MA", 1}, {"S_MD", 1}});
  };
  measure(5);
  EXPECT_NEAR(bench.data("$P_UIFR", {5, "X", "FI"}), 1.25, 1e-9);
  EXPECT_EQ(bench.data("$P_UIFR", {1, "X", "FI"}), 0) << "G54 is active but was not to be corrected";
  EXPECT_EQ(bench.ovi(0), 5);
  measure(2000);
  EXPECT_NEAR(bench.data("$P_SETFR", {"X", "FI"}), 1.25, 1e-9);
  measure(13002);
  EXPECT_NEAR(bench.data("$P_NCBFR", {1, "X", "TR"}), 0, 1e-9) << "the face is at its set value already";
  bench.set("$P_SETFR", {"X", "FI"}, 0);
  measure(13002);
  EXPECT_NEAR(bench.data("$P_NCBFR", {1, "X", "TR"}), 1.25, 1e-9);
  bench.set("$P_NCBFR", {1, "X", "TR"}, 0);
  bench.set("$MN_MM_FRAME_FINE_TRANS", {}, 0);
  measure(1);
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "X", "TR"}), 1.25, 1e-9) << "a machine without fine offsets corrects coarse";
}

TEST(Cycle978, CorrectsTheToolThatMadeTheFace) {
  // The face in plus direction lies 0.04 too far: the cutter's radius is larger than its data say.
  SinumerikBench bench(blockAt(translation({0.04, 0, -350.03})));
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  bench.set("$TC_TP2", {7}, 0);
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL_20"));
  bench.set("$TC_DP1", {7, 1}, 120);
  bench.set("$TC_DP3", {7, 1}, 80);
  bench.set("$TC_DP6", {7, 1}, 10);
  bench.set("$TC_DP12", {7, 1}, -0.01);
  bench.start({-12, 20, -10});
  bench.run("CYCLE978", {{"S_MVAR", 200}, {"S_KNUM1", 1}, {"S_FA", 9}, {"S_TSA", 1}, {"S_MA", 1}, {"S_MD", 1}},
            {{"S_TNAME", "mill_20"}});
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 1}), 0.04, 1e-9);
  EXPECT_NEAR(bench.ovr(20), 0.04, 1e-9);
  EXPECT_EQ(bench.ovi(8), 7);
  // The top lies 0.03 too low: the tool is longer than its data say.
  bench.start({30, 30, 12});
  bench.run("CYCLE978", {{"S_MVAR", 200}, {"S_KNUM1", 4000001}, {"S_FA", 9}, {"S_TSA", 1}, {"S_MA", 3}, {"S_MD", 2}},
            {{"S_TNAME", "MILL_20"}});
  EXPECT_NEAR(bench.data("$TC_DP3", {7, 1}), 80.03, 1e-9);
  EXPECT_NEAR(bench.data("$TC_DP12", {7, 1}), -0.01, 1e-12);
}

TEST(Cycle978, JudgesTheFaceByItsTolerance) {
  // Where the face is touched in plus direction, what lies short of the set value is material left.
  const auto judged = [](double error, const NamedNumbers& values) {
    SinumerikBench bench(blockAt(translation({error, 0, -350})));
    plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
    bench.control.data.set("$TC_TP2", {7}, std::string("MILL_20"));
    bench.set("$TC_DP1", {7, 1}, 120);
    bench.set("$TC_DP6", {7, 1}, 10);
    bench.set("$SCS_MEA_EMPIRIC_VALUE", {2}, 0.3);
    bench.start({-12, 20, -10});
    NamedNumbers call = {{"S_MVAR", 200}, {"S_KNUM1", 1}, {"S_FA", 9},    {"S_TSA", 1},   {"S_MA", 1},
                         {"S_MD", 1},     {"_AMODE", 1},  {"S_TUL", 0.1}, {"S_TLL", -0.3}};
    for (const auto& each : values)
      call.push_back(each);
    bench.run("CYCLE978", call, {{"S_TNAME", "MILL_20"}});
    return bench.control.journal.cycles.back();
  };
  EXPECT_EQ(judged(0.05, {}).verdict, control::Verdict::Good);
  EXPECT_EQ(judged(0.15, {}).verdict, control::Verdict::Scrap);
  EXPECT_EQ(judged(-0.35, {}).verdict, control::Verdict::Rework);
  EXPECT_EQ(judged(0.15, {{"S_EVNUM", 3}}).verdict, control::Verdict::Good) << "0.3 of it are the empirical value";
  // The tool is worn out, the part still good.
  EXPECT_EQ(judged(0.05, {{"S_TDIF", 0.02}}).verdict, control::Verdict::Good);
  const control::CycleRecord record = judged(0.15, {});
  const auto actual = std::ranges::find(record.results, "_OVR[4]", &control::ResultRecord::name);
  ASSERT_NE(actual, record.results.end());
  EXPECT_NEAR(actual->lowerLimit.value_or(99), -0.3, 1e-12);
  EXPECT_NEAR(actual->upperLimit.value_or(99), 0.1, 1e-12);
}

TEST(Cycle978, SpindleReversalNeedsNoCalibratedDeviation) {
  simulation::Truth truth = blockAt(translation({0.5, -0.25, -350}));
  truth.tools[0].probe.tipOffset = {0.08, -0.05};
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  const auto measure = [&](int variant, int axis) {
    bench.start(axis == 1 ? Vector3(-12, 20, -10) : Vector3(20, -12, -10));
    bench.run("CYCLE978", {{"S_MVAR", static_cast<double>(variant)},
                           {"S_FA", 9},
                           {"S_TSA", 9},
                           {"S_MA", static_cast<double>(axis)},
                           {"S_MD", 1}});
    return bench.ovr(4);
  };
  EXPECT_NEAR(measure(0, 1), 0.5 - 0.08, 1e-9) << "the standard method trusts the calibration";
  EXPECT_NEAR(measure(0, 2), -0.25 + 0.05, 1e-9);
  EXPECT_NEAR(measure(10000, 1), 0.5, 1e-9);
  EXPECT_NEAR(measure(10000, 2), -0.25, 1e-9);
  EXPECT_NEAR(bench.machine.spindle().angle, 0, 1e-12) << "the spindle goes back";
  // Aligned, the same side of the ball touches in all directions.
  bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 2.08);
  EXPECT_NEAR(measure(20000, 1), 0.5, 1e-9);
  EXPECT_NEAR(measure(20000, 2), -0.25, 1e-9);
}

TEST(Cycle978, AveragesRepeatedMeasurements) {
  simulation::Truth truth = blockAt(translation({0, 0, -350}));
  truth.tools[0].probe.repeatability = 0.01;
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  double once = 0, often = 0;
  const int runs = 40;
  for (int i = 0; i < runs; ++i) {
    bench.start({-12, 20, -10});
    bench.run("CYCLE978", {{"S_FA", 3}, {"S_TSA", 1}, {"S_MA", 1}, {"S_MD", 1}});
    once += bench.ovr(16) * bench.ovr(16);
    bench.run("CYCLE978", {{"S_FA", 3}, {"S_TSA", 1}, {"S_MA", 1}, {"S_MD", 1}, {"S_NMSP", 9}});
    often += bench.ovr(16) * bench.ovr(16);
  }
  // Nine measurements scatter a third as much: variance a ninth.
  EXPECT_NEAR(std::sqrt(once / runs), 0.01, 0.004);
  EXPECT_NEAR(std::sqrt(often / runs), 0.01 / 3, 0.0014);
}

TEST(Cycle978, ReturnsToMeasuringPathFromTheSurface) {
  SinumerikBench bench(blockAt(translation({0, 0, -350})));
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  bench.start({-20, 20, -10});
  bench.run("CYCLE978", {{"S_FA", 5}, {"S_TSA", 1}, {"S_MA", 1}, {"S_MD", 1}});
  EXPECT_NEAR(bench.control.channel.position().x(), -5 - 2, 1e-9);
}

TEST(Cycle978, TakesTheEmpiricalValueOffTheDifference) {
  SinumerikBench bench(blockAt(translation({0.3, 0, -350})));
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  bench.set("$SCS_MEA_EMPIRIC_VALUE", {2}, 0.1);
  bench.start({-12, 20, -10});
  bench.run("CYCLE978",
            {{"S_MVAR", 100}, {"S_KNUM", 1}, {"S_FA", 9}, {"S_TSA", 1}, {"S_MA", 1}, {"S_MD", 1}, {"S_EVNUM", 3}});
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "X", "FI"}), 0.2, 1e-9);
  EXPECT_EQ(bench.ovi(7), 3);
}

TEST(Cycle978, MeasuresInTheOtherPlanes) {
  SinumerikBench bench(blockAt(translation({0.1, 0.2, -350})));
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  // G17 is asked for by the call while G18 is active: X stays the first axis.
  bench.start({-12, 20, -10});
  bench.run("CYCLE978", {{"S_FA", 9}, {"S_TSA", 1}, {"S_MA", 1}, {"S_MD", 1}, {"_DMODE", 1}}, {}, "G18\n");
  EXPECT_NEAR(bench.ovr(4), 0.1, 1e-9);
}

TEST(Cycle978, TheSpindleFollowsATurnedSystemIfAskedTo) {
  // A ball 0.1 beside the spindle axis in X; the workpiece system is turned by 40 degrees.
  const Pose part = translation({0, 0, -350}) * rotation(Vector3::UnitZ(), 40);
  simulation::Truth truth = blockAt(part);
  truth.tools[0].probe.tipOffset = {0.1, 0};
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350}, {0, 0, 40});
  bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 2.1);
  bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0}, -1.9);
  bench.set("$SNS_MEA_WP_POS_DEV_AX1", {0}, 0.1);
  const auto measured = [&] {
    bench.start({-12, 20, -10});
    bench.run("CYCLE978", {{"S_FA", 9}, {"S_TSA", 1}, {"S_MA", 1}, {"S_MD", 1}});
    return bench.ovr(4);
  };
  // As the spindle stands, the ball leads by 0.1 cos 40 only.
  EXPECT_NEAR(measured(), 0.1 - 0.1 * std::cos(radiansFromDegrees(40)), 1e-9);
  bench.set("$SCS_MEA_FUNCTION_MASK", {}, 3);
  EXPECT_NEAR(measured(), 0, 1e-9);
  EXPECT_NEAR(bench.machine.spindle().angle, 40, 1e-9);
  // Bit 2 is for spindles that count clockwise. This one does not: the ball goes the wrong way and leads by 0.1 cos 80.
  bench.set("$SCS_MEA_FUNCTION_MASK", {}, 7);
  EXPECT_NEAR(measured(), 0.1 - 0.1 * std::cos(radiansFromDegrees(80)), 1e-9);
  EXPECT_NEAR(bench.machine.spindle().angle, -40, 1e-9);
}

TEST(Cycle978, MeasuresAlongTheToolAsFarAsItIsCalibrated) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, 0, -60}, {80, 80, 0}), translation({0, 0, -350}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  const NamedNumbers call = {{"S_FA", 6}, {"S_TSA", 2}, {"S_MA", 3}, {"S_MD", 2}};
  // The length ends at the south pole: nothing is left for a trigger point.
  bench.start({30, 30, 12});
  bench.run("CYCLE978", call);
  EXPECT_NEAR(bench.ovr(4), 0, 1e-9);
  bench.set("$MNS_MEA_FUNCTION_MASK", {}, 1);  // the length ends at the centre
  bench.set("$TC_DP3", {1, 1}, 98);
  bench.start({30, 30, 12});
  EXPECT_EQ(bench.alarmOf("CYCLE978", call), "61341");
  bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}, -2);
  bench.start({30, 30, 12});
  bench.run("CYCLE978", call);
  EXPECT_NEAR(bench.ovr(4), 0, 1e-9);
  bench.start({30, 30, 12});
  EXPECT_EQ(bench.alarmOf("CYCLE978", with(call, {{"S_MD", 1}, {"S_SETV", 20}})), "61341");
  bench.set("$MNS_MEA_FUNCTION_MASK", {}, 0);  // nothing is watched
  bench.start({30, 30, 12});
  EXPECT_EQ(bench.alarmOf("CYCLE978", with(call, {{"S_MD", 1}, {"S_SETV", 20}})), "61301");
}

TEST(Cycle978, CountsInTheProgramsUnit) {
  SinumerikBench bench(blockAt(translation({0.254, 0, -350})));
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  bench.start({-12, 20, -10});
  bench.run(
      "CYCLE978",
      {{"S_MVAR", 100}, {"S_KNUM", 1}, {"S_SETV", -0.02}, {"S_FA", 0.4}, {"S_TSA", 0.1}, {"S_MA", 1}, {"S_MD", 1}}, {},
      "G70\n");
  EXPECT_NEAR(bench.ovr(0), -0.02, 1e-12);
  EXPECT_NEAR(bench.ovr(4), 0.01, 1e-9) << "inches";
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "X", "FI"}), 0.03 * 25.4, 1e-9) << "frames are in mm";
}

TEST(Cycle978, IsSkippedInDryRun) {
  SinumerikBench bench(blockAt(translation({0.254, 0, -350})));
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  bench.control.dryRun = true;
  bench.start({-12, 20, -10});
  bench.run("CYCLE978", {{"S_MVAR", 100}, {"S_KNUM", 1}, {"S_FA", 9}, {"S_TSA", 1}, {"S_MA", 1}, {"S_MD", 1}});
  EXPECT_TRUE(bench.control.journal.cycles.empty());
  EXPECT_EQ(bench.data("$P_UIFR", {1, "X", "FI"}), 0);
}

TEST(Cycle978, RefusesWithTheControlsAlarms) {
  SinumerikBench bench(blockAt(translation({0, 0, -350})));
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL_20"));
  bench.set("$TC_DP1", {7, 1}, 120);
  const auto alarm = [&](const NamedNumbers& changed, const char* tool = "") {
    bench.start({-12, 20, -10});
    return bench.alarmOf("CYCLE978", with({{"S_FA", 9}, {"S_TSA", 1}, {"S_MA", 1}, {"S_MD", 1}}, changed),
                         {{"S_TNAME", tool}});
  };
  EXPECT_EQ(alarm({}), "");
  EXPECT_EQ(alarm({{"S_MVAR", 3}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 300}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 30000}}), "61307");
  EXPECT_EQ(alarm({{"S_MVAR", 10000}, {"S_MA", 3}}), "61307");
  EXPECT_EQ(alarm({{"S_FA", 0}}), "61308");
  EXPECT_EQ(alarm({{"S_MA", 4}}), "61325");
  EXPECT_EQ(alarm({{"S_MD", 3}}), "61326");
  EXPECT_EQ(alarm({{"S_MD", 0}, {"S_SETV", -12}}), "61326") << "the probe is already at the set value";
  EXPECT_EQ(alarm({{"S_PRNUM", 13}}), "61313");
  EXPECT_EQ(alarm({{"S_PRNUM", 2}}), "61341");
  EXPECT_EQ(alarm({{"S_SETV", 1.5}}), "61303");
  EXPECT_EQ(alarm({{"S_SETV", 1.5}, {"S_MVAR", 100}, {"S_KNUM", 1}}), "61303");
  EXPECT_EQ(bench.data("$P_UIFR", {1, "X", "FI"}), 0) << "an alarm writes nothing";
  EXPECT_EQ(alarm({{"S_SETV", -12}, {"S_FA", 2}}), "61301");
  EXPECT_EQ(alarm({{"S_MVAR", 100}, {"S_KNUM", 4001}}), "61322");
  EXPECT_EQ(alarm({{"S_MVAR", 100}, {"S_KNUM", 1017}}), "61321");
  EXPECT_EQ(alarm({{"S_MVAR", 100}, {"S_KNUM", 101}}), "61321");
  EXPECT_EQ(alarm({{"S_MVAR", 100}, {"S_KNUM", 20001}}), "61323");
  EXPECT_EQ(alarm({{"S_MVAR", 100}, {"S_KNUM", 100001}}), "61324");
  EXPECT_EQ(alarm({{"S_MVAR", 200}, {"S_KNUM1", 1}}), "61343");
  EXPECT_EQ(alarm({{"S_MVAR", 200}, {"S_KNUM1", 1}}, "NONE"), "61343");
  EXPECT_EQ(alarm({{"S_MVAR", 200}, {"S_KNUM1", 2}}, "MILL_20"), "61328");
  EXPECT_EQ(alarm({{"S_MVAR", 200}, {"S_KNUM1", 500001}}, "MILL_20"), "61314");
  EXPECT_EQ(alarm({{"S_MVAR", 200}, {"S_KNUM1", 1000001}}, "MILL_20"), "61319");
  EXPECT_EQ(alarm({{"S_MVAR", 200}, {"S_KNUM1", 1}, {"S_EVNUM", 10000}}, "MILL_20"), "61318");
  EXPECT_EQ(alarm({{"S_MVAR", 200}, {"S_KNUM1", 1}, {"S_EVNUM", 210000}}, "MILL_20"), "61319");
  bench.set("$TC_DP1", {1, 1}, 712);
  EXPECT_EQ(alarm({{"S_MVAR", 10000}}), "61309");
  bench.set("$TC_DP1", {1, 1}, 120);
  EXPECT_EQ(alarm({}), "61309");
  bench.set("$TC_DP1", {1, 1}, 710);
  bench.set("$P_UIFR", {1, "X", "SC"}, 2);
  EXPECT_EQ(alarm({}), "61310");
  bench.set("$P_UIFR", {1, "X", "SC"}, 1);
  EXPECT_EQ(alarm({}), "");
}

}  // namespace
}  // namespace probewright
