#include "sinumerik_tools/tool_bench.hpp"

/// CYCLE971 counts in the unit of the program; a tool and its probe are the same in inches.
namespace probewright {
namespace {

using namespace testing_support;

ToolBench bench() {
  ToolBench bench;
  bench.disc(24);
  bench.add(2, 80, 8, 2);
  bench.add(9, 75, 6);
  bench.believed(2).length = 79.75;
  bench.believed(2).radius = 8.125;
  return bench;
}

/// R1 becomes a copy of the result `copied`. Records of results are millimetres whatever the program counts in.
ToolRun in(const ToolBench& bench, double unit, int tool, const NamedNumbers& numbers, int copied) {
  NamedNumbers scaled = numbers;
  for (auto& [name, value] : scaled)
    if (name == "S_FA" || name == "S_TSA" || name == "S_ID" || name == "S_TZL" || name == "S_TDIF") value /= unit;
  const Vector3 start = bench.contact + beside;
  ToolRun left = bench.program(fmt::format(
      "G17 G90 {} G500\nT{} D1 M6\nG0 X{:.9f} Y{:.9f}\nG0 Z{:.9f}\n{}R1=_OVR[{}]\nM30\n", unit == 1 ? "G710" : "G700",
      tool, start.x() / unit, start.y() / unit, start.z() / unit, ToolBench::call(scaled), copied));
  EXPECT_EQ(left.code(), "");
  return left;
}

/// Whatever their size, numbers of a setup are those of the control.
TEST(ToolUnits, SmallAndLargeNumbersOfTheSetupAreRead) {
  ToolBench bench;
  bench.disc(20);
  bench.add(9, 80, 5);
  bench.datum("$TC_DP12[9,1]", -4.653276821522945e-05);
  bench.datum("$TC_DP15[9,1]", 1e-17);
  bench.datum("$SNS_MEA_TP_FEED[0]", 1e17);
  const ToolRun left = bench.program("R1=$TC_DP12[9,1] R2=$TC_DP15[9,1] R3=$SNS_MEA_TP_FEED[0]\nM30\n");
  EXPECT_EQ(left.code(), "");
  EXPECT_EQ(left.r(1), -4.653276821522945e-05);
  EXPECT_EQ(left.r(2), 1e-17);
  EXPECT_EQ(left.r(3), 1e17);
}

TEST(ToolUnits, AToolIsAsLongInInches) {
  const NamedNumbers usual = {{"S_PRNUM", 1}, {"S_FA", 5}, {"S_TSA", 2}, {"S_TDIF", 1}};
  for (const NamedNumbers& more : {NamedNumbers{{"S_MVAR", 2}, {"S_MA", 3}}, NamedNumbers{{"S_MVAR", 2}, {"S_MA", 1}},
                                   NamedNumbers{{"S_MVAR", 1}, {"S_MA", 103}, {"S_ID", 1}}}) {
    const NamedNumbers call = with(usual, more);
    const ToolBench world = bench();
    const bool length = more[1].second != 1;
    const int copied = length ? 9 : 11;
    const ToolRun metric = in(world, 1, 2, call, copied), inch = in(world, 25.4, 2, call, copied);
    EXPECT_NEAR(metric.r(1), metric.ovr(copied), 1e-9);
    EXPECT_NEAR(inch.r(1) * 25.4, metric.r(1), 1e-6);
    EXPECT_NEAR(metric.ovr(length ? 9 : 11), length ? 0.25 : -0.125, 0.006);
    for (const int result : {length ? 8 : 10, length ? 9 : 11, 27, 28, 29})
      EXPECT_NEAR(inch.ovr(result), metric.ovr(result), 1e-6) << result;
    // Tool data are millimetres, as the control is set up.
    const std::string datum = length ? "$TC_DP3[2,1]" : "$TC_DP6[2,1]";
    EXPECT_NEAR(inch.written(datum), metric.written(datum), 1e-6);
  }
}

TEST(ToolUnits, AProbeIsWhereItIsInInches) {
  const NamedNumbers call = {{"S_MVAR", 100000}, {"S_PRNUM", 1}, {"S_FA", 5}, {"S_TSA", 2}};
  ToolBench world = bench();
  world.misplace({0.3, -0.2, 0.4});
  const ToolRun metric = in(world, 1, 9, call, 8), inch = in(world, 25.4, 9, call, 8);
  EXPECT_NEAR(metric.r(1), metric.ovr(8), 1e-9);
  EXPECT_NEAR(inch.r(1) * 25.4, metric.r(1), 1e-6);
  for (const char* datum :
       {"$SNS_MEA_TP_TRIG_MINUS_DIR_AX1[0]", "$SNS_MEA_TP_TRIG_PLUS_DIR_AX2[0]", "$SNS_MEA_TP_TRIG_MINUS_DIR_AX3[0]"}) {
    EXPECT_FALSE(std::isnan(metric.written(datum))) << datum;
    EXPECT_NEAR(inch.written(datum), metric.written(datum), 1e-6) << datum;
  }
  for (const int result : {8, 10, 12, 14, 16})
    EXPECT_NEAR(inch.ovr(result), metric.ovr(result), 1e-6) << result;
}

}  // namespace
}  // namespace probewright
