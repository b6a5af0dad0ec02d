#include <numbers>

#include "control/sinumerik/measuring_data.hpp"
#include "cycles/sinumerik/turning_touches.hpp"
#include "sinumerik_tools/tool_bench.hpp"

/// What a call of CYCLE971 says: speeds and feeds, what is refused, the old form, what log and screen show.
namespace probewright {
namespace {

using namespace testing_support;

const NamedNumbers usual = {{"S_PRNUM", 1}, {"S_FA", 3}, {"S_TSA", 2}};

TEST(MeasureMilledTool, SpeedsAndFeedsByTheFormula) {
  control::sinumerik::DataStore data;
  control::sinumerik::setMeasuringDefaults(data);
  const auto set = [&](const char* name, double value) { data.set(name, {0}, value); };
  set("$SNS_MEA_CM_MAX_PERI_SPEED", 30);
  set("$SNS_MEA_CM_MAX_REVOLUTIONS", 2000);
  set("$SNS_MEA_CM_MAX_FEEDRATE", 40);
  set("$SNS_MEA_CM_MIN_FEEDRATE", 3);
  set("$SNS_MEA_CM_MEASURING_ACCURACY", 0.01);
  set("$SNS_MEA_CM_FEEDFACTOR_1", 3);
  const auto touches = [&](double radius) { return cycles::sinumerik::turningTouches(data, radius); };
  // 30 m/min on the circumference of a radius of 10 mm.
  const double speed = 30000 / (2 * std::numbers::pi * 10);
  auto all = touches(10);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NEAR(all[0].speed, speed, 1e-9);
  EXPECT_NEAR(all[0].feed, 3 * speed * 0.01, 1e-9);
  EXPECT_NEAR(all[1].speed, 300, 1e-9) << "half of 477 would make the smallest feed follow by more than 0.01";
  EXPECT_NEAR(all[1].feed, 3, 1e-9);
  set("$SNS_MEA_CM_MIN_FEEDRATE", 1);
  EXPECT_NEAR(touches(10)[1].speed, speed / 2, 1e-9);
  EXPECT_NEAR(touches(10)[1].feed, speed / 2 * 0.01, 1e-9);
  set("$SNS_MEA_CM_MIN_FEEDRATE", 3);
  data.set("$SNS_MEA_FUNCTION_MASK", {}, 524288.0);  // bit 19
  EXPECT_NEAR(touches(10)[1].speed, speed, 1e-9);
  EXPECT_NEAR(touches(10)[1].feed, speed * 0.01, 1e-9);
  EXPECT_NEAR(touches(1)[1].speed, 2000, 1e-9);
  EXPECT_NEAR(touches(1)[0].feed, 40, 1e-9) << "the largest feed";
  EXPECT_NEAR(touches(100)[1].feed, 3, 1e-9) << "the smallest feed";
  set("$SNS_MEA_CM_FEEDFACTOR_2", 2);
  all = touches(10);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_NEAR(all[1].feed, 2 * speed * 0.01, 1e-9);
  set("$SNS_MEA_CM_FEEDFACTOR_1", 0);
  EXPECT_EQ(touches(10).size(), 1U);
  set("$SNS_MEA_CM_MAX_PERI_SPEED", 0);
  set("$SNS_MEA_CM_MAX_REVOLUTIONS", 0);
  EXPECT_TRUE(touches(10).empty());
}

TEST(MeasureMilledTool, SpeedsAndFeedsOfTheCall) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80, 6, 3);
  bench.datum("$SNS_MEA_FUNCTION_MASK_TOOL", 32);  // bit 5
  const NamedNumbers radius = with(usual, {{"S_MVAR", 2}, {"S_MA", 1}, {"S_F1", 20}, {"S_S1", 1000}});
  const auto touches = [&](const NamedNumbers& more) {
    return bench.measure(beside, with(radius, more)).cycle().touches.size();
  };
  EXPECT_EQ(touches({}), 1U);
  EXPECT_EQ(touches({{"S_F2", 10}, {"S_S2", 1000}}), 2U);
  EXPECT_EQ(touches({{"S_F2", 10}, {"S_S2", 1000}, {"S_F3", 5}, {"S_S3", 800}}), 3U);
  EXPECT_EQ(touches({{"S_F3", 5}, {"S_S3", 800}}), 1U) << "S_S2 = 0: once only";
  // 20 mm/min at 1000 rev/min follow the edge by 0.02 / 3 at most.
  EXPECT_NEAR(bench.measure(beside, radius).ovr(10), 6, 0.0067);
  EXPECT_EQ(bench.alarmOf(beside, with(radius, {{"S_S2", 1000}})), "61350");
  bench.datum("$SNS_MEA_FUNCTION_MASK_TOOL", 0);
  bench.datum("$SNS_MEA_CM_MEASURING_ACCURACY[0]", 0);
  bench.datum("$SNS_MEA_CM_MIN_FEEDRATE[0]", 0);
  EXPECT_EQ(bench.alarmOf(beside, radius), "61350");
}

TEST(MeasureMilledTool, TheSpindleTurnsAsItTurnedBefore) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80, 6, 3);
  const std::string call = ToolBench::call(with(usual, {{"S_MVAR", 2}, {"S_MA", 1}}));
  EXPECT_EQ(bench.run(2, beside, call).code(), "") << "SD 54674: against the cutting direction";
  EXPECT_EQ(bench.run(2, beside, "S500 M4\n" + call).code(), "");
  EXPECT_EQ(bench.run(2, beside, "S500 M3\n" + call).code(), "61302") << "it cuts into the contact";
  bench.datum("$SNS_MEA_CM_SPIND_ROT_DIR[0]", 3);
  EXPECT_EQ(bench.run(2, beside, call).code(), "61302");
  EXPECT_EQ(bench.run(2, beside, "S500 M4\n" + call).code(), "");
}

TEST(MeasureMilledTool, TheDirectionOfRotationIsTakenWithoutIndex) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80, 6, 3);
  const std::string call = ToolBench::call(with(usual, {{"S_MVAR", 2}, {"S_MA", 1}}));
  EXPECT_EQ(bench.run(2, beside, call).code(), "");
  EXPECT_EQ(bench.run(2, beside, "$SNS_MEA_CM_SPIND_ROT_DIR=3\n" + call).code(), "61302")
      << "in the program: M3 cuts into the contact";
  bench.datum("$SNS_MEA_CM_SPIND_ROT_DIR", 3);
  EXPECT_EQ(bench.run(2, beside, call).code(), "61302") << "in the setup";
  EXPECT_EQ(bench.run(2, beside, "$SNS_MEA_CM_SPIND_ROT_DIR=4\n" + call).code(), "");
}

TEST(MeasureMilledTool, Refuses) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80, 6, 3);
  bench.add(9, 80, 5);
  const NamedNumbers radius = with(usual, {{"S_MVAR", 1}, {"S_MA", 1}});
  const auto alarm = [&](const NamedNumbers& call, const std::string& before = {}) {
    return bench.alarmOf(beside, with(radius, call), 2, before);
  };
  EXPECT_EQ(alarm({}), "");
  EXPECT_EQ(alarm({}, "G41\n"), "61300");
  EXPECT_EQ(alarm({}, "D0\n"), "61311");
  EXPECT_EQ(alarm({}, "SCALE X2\n"), "61310");
  EXPECT_EQ(alarm({}, "MIRROR X0\n"), "61310");
  EXPECT_EQ(alarm({{"S_PRNUM", 3}}), "61341");
  const auto computed = [&](const std::string& arguments, const std::string& before = {}) {
    return bench.run(2, beside, before + "CYCLE971(" + arguments + ")\n").code();
  };
  EXPECT_EQ(computed("R1,,1,1,,,3,2", "R1=101\n"), "61307");
  EXPECT_EQ(computed("R1,,1,1,,,3,2", "R1=100001\n"), "61307");
  EXPECT_EQ(computed("R1,,1,1,,,3,2", "R1=3\n"), "61307");
  EXPECT_EQ(computed("R1,,1,1,,,3,2", "R1=1000001\n"), "61307");
  EXPECT_EQ(computed("1,,R1,1,,,3,2", "R1=7\n"), "61313");
  EXPECT_EQ(computed("1,,1,R1,,,3,2", "R1=4\n"), "61325");
  EXPECT_EQ(computed("1,,1,R1,,,3,2", "R1=101\n"), "61325");
  EXPECT_EQ(computed("1,,1,1,R1,,3,2", "R1=3\n"), "61326");
  EXPECT_EQ(computed("1,,1,3,R1,,3,2", "R1=1\n"), "61326");
  EXPECT_EQ(computed("1,,1,1,,,R1,2", "R1=0\n"), "61308");
  EXPECT_EQ(computed("1,,1,1,,,3,2,,,,,,,,,,,R1", "R1=21\n"), "61319");
  EXPECT_EQ(alarm({{"S_MVAR", 102}}), "");
  bench.believed(2).teeth = 0;
  EXPECT_EQ(alarm({{"S_MVAR", 102}}), "61319");
  bench.datum("$TC_DP1[2,1]", 500);
  EXPECT_EQ(alarm({}), "61314");
  bench.datum("$TC_DP1[2,1]", 120);
  bench.datum("$TC_DP6[2,1]", 0);
  EXPECT_EQ(alarm({}), "61351");
  EXPECT_EQ(alarm({{"S_MVAR", 2}, {"S_MA", 3}}), "61351");
  bench.datum("$TC_DP6[2,1]", 6);
  bench.datum("$SCS_MEA_FEED_PLANE_VALUE", 0);
  EXPECT_EQ(alarm({}), "61338");
  bench.datum("$SCS_MEA_FEED_PLANE_VALUE", 1000);
  bench.probe().switchedOn = false;
  EXPECT_EQ(alarm({}), "61309");
  bench.probe().switchedOn = true;
  bench.misplace({0, 0, 30});
  EXPECT_EQ(alarm({{"S_MA", 3}}), "61301");
}

TEST(MeasureMilledTool, CheckNamesWhatDoesNotFitTogether) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80, 6, 3);
  const auto complaint = [&](const NamedNumbers& call) {
    const ToolRun left = bench.run(2, beside, ToolBench::call(with(usual, call)));
    EXPECT_TRUE(left.journal().cycles.empty()) << "nothing has run";
    return left.run.outcome.diagnostics.empty() ? std::string() : left.run.outcome.diagnostics.front().message;
  };
  const auto names = [&](const NamedNumbers& call, const std::string& what) {
    const std::string said = complaint(call);
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  names({{"S_MVAR", 101}, {"S_MA", 1}}, "spindle turning only");
  names({{"S_MVAR", 100001}, {"S_MA", 1}}, "is a calibration");
  names({{"S_MVAR", 1000002}, {"S_MA", 1}}, "reversed");
  names({{"S_MVAR", 1}}, "S_MA");
  names({{"S_MVAR", 1}, {"S_MA", 101}}, "offset axis");
  names({{"S_MVAR", 1}, {"S_MA", 3}, {"S_MD", 1}}, "from above");
  names({{"S_MVAR", 1}, {"S_MA", 5}}, "S_MA");
  names({{"S_MVAR", 1}, {"S_MA", 1}, {"S_EVNUM", 21}}, "S_EVNUM");
  // What does nothing is named, and the call runs.
  const ToolRun idle = bench.run(2, beside, ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 1}, {"S_F1", 20}})));
  EXPECT_EQ(idle.code(), "");
  EXPECT_TRUE(bench.measure(beside, with(usual, {{"S_MVAR", 2}, {"S_MA", 1}, {"S_F1", 20}, {"S_S1", 900}}))
                  .told("bit 5 of SD 54762"));
}

TEST(MeasureMilledTool, TheOldFormTakesItsVariables) {
  ToolBench bench;
  bench.disc(20);
  bench.add(9, 80, 5);
  bench.add(2, 80.2, 6);
  bench.believed(2).length = 80;
  const ToolRun left =
      bench.run(2, above,
                "_MVAR=1 _PRNUM=1 _MA=3 _ID=0 _FA=3 _TSA=2 _TZL=0.01 _TDIF=0.5 _NMSP=2 _EVNUM=0 _VMS=0\n"
                "CYCLE971\n");
  ASSERT_EQ(left.code(), "");
  EXPECT_NEAR(left.written("$TC_DP3[2,1]"), 80.2, 1e-5);
  EXPECT_EQ(left.ovr(29), 0.5);
  const ToolRun wear = bench.run(2, above, "_CHBIT[3]=1\n_MVAR=1 _MA=3 _FA=3 _TSA=2\nCYCLE971\n");
  EXPECT_NEAR(wear.written("$TC_DP12[2,1]"), 0.2, 1e-5);
  const ToolRun calibrated = bench.run(9, above, "_MVAR=100000 _PRNUM=1 _FA=3 _TSA=2\nCYCLE971\n");
  ASSERT_EQ(calibrated.code(), "");
  EXPECT_NEAR(calibrated.ovr(16), bench.contact.z(), 1e-5);
  EXPECT_EQ(bench.run(2, above, "_MVAR=102 _MA=3 _FA=3 _TSA=2\nCYCLE971\n").code(), "61307");
}

TEST(MeasureMilledTool, LogAndScreenShowTheEdges) {
  ToolBench bench;
  bench.disc(8);
  auto& mill = bench.add(2, 80, 12, 3);
  mill.cutter.teeth[1].axial = -0.2;
  mill.cutter.teeth[0].radial = 0.02;
  const ToolRun left = bench.run(
      2, beside, "CYCLE150(31,1,\"TOOLS\")\n" + ToolBench::call(with(usual, {{"S_MVAR", 102}, {"S_MA", 103}})));
  ASSERT_EQ(left.code(), "");
  coverage::logRead(control::ControlKind::Sinumerik840Dsl, left.journal(), "TOOLS.TXT");
  std::string all;
  for (const auto& [name, text] : left.run.outcome.files)
    all += text;
  for (const auto& screen : left.cycle().screens)
    all += screen;
  EXPECT_NE(all.find("length 1, edge 3"), std::string::npos) << all;
  EXPECT_NE(all.find("79.8000"), std::string::npos) << all;
}

}  // namespace
}  // namespace probewright
