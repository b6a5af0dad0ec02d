#include "sinumerik_tools/tool_bench.hpp"

/// CYCLE971 calibrates: the trigger points of a probe that stands elsewhere than the data say are found, and with a
/// tool that is not as believed they are wrong by just that.
namespace probewright {
namespace {

using namespace testing_support;

const NamedNumbers usual = {{"S_PRNUM", 1}, {"S_FA", 4}, {"S_TSA", 3}};

constexpr const char* triggers[] = {"$SNS_MEA_TP_TRIG_MINUS_DIR_AX1[0]", "$SNS_MEA_TP_TRIG_PLUS_DIR_AX1[0]",
                                    "$SNS_MEA_TP_TRIG_MINUS_DIR_AX2[0]", "$SNS_MEA_TP_TRIG_PLUS_DIR_AX2[0]",
                                    "$SNS_MEA_TP_TRIG_MINUS_DIR_AX3[0]"};

/// The true trigger points, in the order of `triggers`.
std::vector<double> truth(const ToolBench& bench, double pretravel) {
  const Vector3& at = bench.contact;
  return {at.x() + bench.half1 - pretravel, at.x() - bench.half1 + pretravel, at.y() + bench.half2 - pretravel,
          at.y() - bench.half2 + pretravel, at.z() - pretravel};
}

TEST(CalibrateToolProbe, CompletelyFindsEachTriggerPoint) {
  Planter plant(9711);
  for (int world = 0; world < 5; ++world) {
    SCOPED_TRACE(world);
    ToolBench bench;
    world % 3 == 0 ? bench.cuboid(plant.number(15, 40), plant.number(15, 40)) : bench.disc(plant.number(8, 40));
    bench.probe().pretravel = coin(plant) ? plant.number(0, 0.01) : 0;
    bench.misplace({plant.number(-0.8, 0.8), plant.number(-0.8, 0.8), plant.number(-0.8, 0.8)});
    bench.add(9, plant.number(60, 110), plant.number(3, 12));
    const ToolRun left = bench.measure(above, with(usual, {{"S_MVAR", 100000}, {"S_NMSP", world == 0 ? 2 : 1}}), 9);
    const auto expected = truth(bench, bench.probe().pretravel);
    const int places[] = {8, 10, 12, 14, 16};
    for (int i = 0; i < 5; ++i) {
      EXPECT_NEAR(left.written(triggers[i]), expected[i], 1e-5) << triggers[i];
      EXPECT_NEAR(left.ovr(places[i]), expected[i], 1e-5) << triggers[i];
    }
    EXPECT_EQ(left.ovi(2), 971);
    EXPECT_EQ(left.ovi(3), 100000);
    EXPECT_EQ(left.ovi(5), 1);
    EXPECT_EQ(left.ovr(28), 3);
    // The tool stands DFA above the middle of the contact.
    const auto tip = left.run.machine->position().values;
    EXPECT_NEAR(tip[0], bench.contact.x(), 1e-5);
    EXPECT_NEAR(tip[1], bench.contact.y(), 1e-5);
  }
}

TEST(CalibrateToolProbe, InOneAxisAtTheMiddleOfTheOther) {
  Planter plant(9712);
  const struct {
    double axes, way;
    int trigger;
  } cases[] = {{102, 2, 2}, {102, 1, 3}, {201, 2, 0}, {201, 1, 1}, {3, 2, 4}, {3, 0, 4}};
  for (const auto& each : cases) {
    SCOPED_TRACE(each.axes);
    ToolBench bench;
    bench.disc(plant.number(10, 30));
    bench.misplace({plant.number(-0.8, 0.8), plant.number(-0.8, 0.8), plant.number(-0.8, 0.8)});
    // The heights count from the upper face, which is known well enough.
    bench.add(9, plant.number(60, 110), plant.number(3, 12));
    const ToolRun left = bench.measure(above, with(usual, {{"S_MA", each.axes}, {"S_MD", each.way}}), 9);
    EXPECT_NEAR(left.written(triggers[each.trigger]), truth(bench, 0)[static_cast<std::size_t>(each.trigger)], 1e-5);
    const auto& writes = left.cycle().writes;
    EXPECT_EQ(
        std::ranges::count_if(writes, [](const auto& write) { return write.table.find("TRIG") != std::string::npos; }),
        1);
  }
}

TEST(CalibrateToolProbe, BesideTheMiddleFindsTheDiscTooNarrow) {
  // Without the middle in Y a disc of radius 10 and a pin of radius 5 touch on a chord.
  ToolBench bench;
  bench.disc(20);
  bench.misplace({0, 0.6, 0});
  bench.add(9, 80, 5);
  const ToolRun left = bench.measure(beside, with(usual, {{"S_MA", 1}, {"S_MD", 0}}), 9);
  const double chord = std::sqrt(15 * 15 - 0.6 * 0.6) - 5;
  EXPECT_NEAR(left.written(triggers[1]), bench.contact.x() - chord, 1e-5) << "the tool stands on the minus side";
}

TEST(CalibrateToolProbe, WithAToolOfAnotherSizeIsWrongByThat) {
  ToolBench bench;
  bench.disc(20);
  bench.add(9, 80, 5);
  bench.believed(9).length = 80.03;
  bench.believed(9).radius = 5.02;
  const ToolRun left = bench.measure(above, with(usual, {{"S_MVAR", 100000}}), 9);
  const auto expected = truth(bench, 0);
  const double wrong[] = {-0.02, 0.02, -0.02, 0.02, -0.03};
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(left.written(triggers[i]), expected[static_cast<std::size_t>(i)] + wrong[i], 1e-5) << triggers[i];
}

TEST(CalibrateToolProbe, SpindleReversalTakesOutTheEccentricity) {
  for (const bool reverses : {false, true}) {
    ToolBench bench;
    bench.cuboid(20, 30);
    bench.misplace({0.2, 0.1, 0});
    bench.add(9, 80, 5).cutter.eccentricity = {0.04, 0};
    const ToolRun left =
        bench.run(9, above, "SPOS=0\n" + ToolBench::call(with(usual, {{"S_MVAR", reverses ? 1100000 : 100000}})));
    EXPECT_EQ(left.code(), "");
    // The axis of the pin is 0.04 further towards plus than the spindle's.
    EXPECT_NEAR(left.written(triggers[0]), bench.contact.x() + 10 - (reverses ? 0 : 0.04), 1e-5);
    EXPECT_NEAR(left.written(triggers[1]), bench.contact.x() - 10 - (reverses ? 0 : 0.04), 1e-5);
  }
}

TEST(CalibrateToolProbe, InWorkpieceCoordinates) {
  Planter plant(9713);
  ToolBench bench;
  bench.disc(24);
  bench.zeroOffset({30.5, -12.25, -400});
  bench.misplace({0.4, -0.3, 0.2});
  bench.add(9, 90, 6);
  const ToolRun left =
      bench.program(fmt::format("G17 G90 G71 G54\nT9 D1 M6\nG0 X{0:.6f} Y{1:.6f}\nG0 Z{2:.6f}\n",
                                bench.contact.x() - 30.5, bench.contact.y() + 12.25, bench.contact.z() + 400 + 20) +
                    ToolBench::call(with(usual, {{"S_MVAR", 100010}})) + "R1=$SNS_MEA_TP_TRIG_MINUS_DIR_AX1[0]\nM30\n");
  EXPECT_EQ(left.code(), "");
  EXPECT_NEAR(left.written("$SNS_MEA_TPW_TRIG_MINUS_DIR_AX1[0]"), bench.contact.x() - 30.5 + 12, 1e-5);
  EXPECT_NEAR(left.written("$SNS_MEA_TPW_TRIG_PLUS_DIR_AX2[0]"), bench.contact.y() + 12.25 - 12, 1e-5);
  EXPECT_NEAR(left.written("$SNS_MEA_TPW_TRIG_MINUS_DIR_AX3[0]"), bench.contact.z() + 400, 1e-5);
  EXPECT_NEAR(left.r(1), bench.contact.x() + 12.4, 1e-9) << "the machine's field stays";
}

TEST(CalibrateToolProbe, TouchesOnlyWhereItMay) {
  ToolBench bench;
  bench.disc(20);
  bench.datum("$SNS_MEA_TP_AX_DIR_AUTO_CAL[0]", 112);
  bench.add(9, 80, 5);
  const ToolRun left = bench.measure(above, with(usual, {{"S_MVAR", 100000}}), 9);
  EXPECT_TRUE(std::isnan(left.ovr(8)));
  EXPECT_NEAR(left.ovr(10), bench.contact.x() - 10, 1e-5);
  EXPECT_NEAR(left.ovr(12), bench.contact.y() + 10, 1e-5);
  EXPECT_TRUE(std::isnan(left.ovr(14)));
  EXPECT_NEAR(left.ovr(16), bench.contact.z(), 1e-5);
}

TEST(CalibrateToolProbe, LargeToolsTouchTheTopBesideTheirAxis) {
  // By the radius less V towards the side that the tool comes from; small ones in the middle.
  const struct { double radius, axes, aside; } cases[] = {{20, 103, -17}, {20, 203, 17}, {20, 3, 0}, {4, 103, 0}};
  for (const auto& each : cases) {
    SCOPED_TRACE(each.axes);
    ToolBench bench;
    bench.disc(10);
    bench.add(9, 80, each.radius);
    const ToolRun left = bench.measure({-45, 3, 35}, with(usual, {{"S_MA", each.axes}, {"S_MD", 2}, {"S_ID", 3}}), 9);
    EXPECT_NEAR(left.ovr(16), bench.contact.z(), 1e-5);
    const Vector3 tip = left.cycle().touches.back().ballCentre - bench.contact;
    EXPECT_NEAR(tip.x(), each.axes == 103 ? each.aside : 0, 1e-6);
    EXPECT_NEAR(tip.y(), each.axes == 203 ? each.aside : 0, 1e-6);
  }
}

TEST(CalibrateToolProbe, KeepsTheFeedItTouchedWith) {
  ToolBench bench;
  bench.disc(20);
  bench.add(9, 80, 5);
  const ToolRun asked = bench.measure(above, with(usual, {{"S_MA", 3}, {"S_VMS", 120}}), 9);
  EXPECT_EQ(asked.written("$SNS_MEA_TP_FEED[0]"), 120);
  bench.datum("$SCS_MEA_TP_FEED_MEASURE", 250);
  const ToolRun usually = bench.measure(above, with(usual, {{"S_MA", 3}}), 9);
  EXPECT_EQ(usually.run.outcome.journal.cycles.back().alarm, "");
  const ToolRun read = bench.run(9, above, ToolBench::call(with(usual, {{"S_MA", 3}})) + "R1=$SNS_MEA_TP_FEED[0]\n");
  EXPECT_EQ(read.r(1), 250);
}

TEST(CalibrateToolProbe, Refuses) {
  ToolBench bench;
  bench.disc(20);
  bench.add(9, 80, 5);
  const auto alarm = [&](const NamedNumbers& call, const ToolBench& of) {
    return of.alarmOf(above, with(usual, call), 9);
  };
  EXPECT_EQ(alarm({{"S_MVAR", 100000}}, bench), "");
  ToolBench away = bench;
  away.misplace({0, 0, 3.5});
  EXPECT_EQ(alarm({{"S_MVAR", 100000}}, away), "61303");
  ToolBench far = bench;
  far.misplace({0, 0, 9});
  EXPECT_EQ(alarm({{"S_MVAR", 100000}}, far), "61301");
  ToolBench fromBelow = bench;
  fromBelow.datum("$SNS_MEA_TP_AX_DIR_AUTO_CAL[0]", 33);
  EXPECT_EQ(alarm({{"S_MVAR", 100000}}, fromBelow), "61319");
  EXPECT_EQ(alarm({{"S_MA", 1}, {"S_PRNUM", 2}}, bench), "61341");
  ToolBench drill = bench;
  drill.believed(9).kind = "drill";
  EXPECT_EQ(alarm({{"S_MVAR", 100000}}, drill), "61314");
  ToolBench thin = bench;
  thin.believed(9).radius = 0;
  EXPECT_EQ(alarm({{"S_MA", 1}}, thin), "61351");
}

}  // namespace
}  // namespace probewright
