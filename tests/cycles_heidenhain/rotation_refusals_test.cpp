#include <map>

#include "cycles_heidenhain/worlds.hpp"

/// What cycles 1410, 1411 and 1420 refuse, and in which words.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

/// A bench with a block under the probe, and an edge that could be measured.
Bench refusingBench(const std::string& machine = "mill3") {
  Bench bench(ControlKind::TNC640, machine);
  bench.preset(1, {0, 0, -400}, 0);
  bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), pose({0, 0, -400}));
  return bench;
}
const Words edgeWords = {{1100, -30}, {1101, -50}, {1102, -8}, {1103, 30}, {1104, -50}, {1105, -8}, {372, 2},
                         {320, 0},    {260, 20},   {1125, 1},  {309, 0},   {1126, 0},   {1120, 0},  {1121, 0}};
const Words planeWords = {{1100, -30}, {1101, -30}, {1102, 0}, {1103, 30}, {1104, -30}, {1105, 0},
                          {1106, 0},   {1107, 30},  {1108, 0}, {372, -3},  {320, 0},    {260, 20},
                          {1125, 1},   {309, 0},    {1126, 0}, {1120, 0},  {1121, 0}};

/// The edge with some positions as texts.
Ran withTexts(const std::map<int, std::string>& texts, const Words& words = edgeWords, int cycle = 1410) {
  Words rest = words;
  std::erase_if(rest, [&](const auto& word) { return texts.contains(word.first); });
  std::string more;
  for (const auto& [number, text] : texts)
    more += fmt::format(" ~\n  QS{}=\"{}\" ;X", number, text);
  return refusingBench().run(probe(cycle, rest, more));
}

TEST(RotationCycles, MeasureTheEdgeThatTheRefusalsSpoil) {
  const Ran edge = refusingBench().run(probe(1410, edgeWords));
  EXPECT_TRUE(edge.finished()) << edge.why();
  const Ran plane = refusingBench().run(probe(1420, planeWords));
  EXPECT_TRUE(plane.finished()) << plane.why();
}

TEST(RotationCycles, RefuseTextsThatAreNoPositions) {
  EXPECT_EQ(withTexts({{1101, "fifty"}}).alarm(), "Nominal position wrong");
  EXPECT_EQ(withTexts({{1101, "?-50@-50.1"}}).alarm(), "Nominal position wrong");
  EXPECT_EQ(withTexts({{1101, "100000"}}).alarm(), "Nominal position wrong");
  EXPECT_EQ(withTexts({{1101, "-50@Q12"}, {1100, "1@1"}, {1102, "1@1"}}).alarm(), "Actual position wrong");
}

TEST(RotationCycles, RefusePositionsWithoutNominal) {
  EXPECT_EQ(withTexts({{1100, "?"}, {1101, "?"}, {1102, "?"}}).alarm(), "Nominal position not defined");
  // The probed axis is needed.
  EXPECT_EQ(withTexts({{1101, "?"}}).alarm(), "Nominal position not defined");
  EXPECT_EQ(withTexts({{1100, "?"}}, planeWords, 1420).alarm(), "Nominal position not defined");
}

TEST(RotationCycles, RefuseActualPositionsInOneAxisOnly) {
  const Ran ran = withTexts({{1101, "-50@-50.1"}});
  EXPECT_EQ(ran.alarm(), "Actual position incomplete");
}

TEST(RotationCycles, RefuseToAskNobody) {
  const Ran ran = withTexts({{1101, "?-50"}});
  EXPECT_EQ(ran.alarm(), "Semi-automatic probing without operator");
  EXPECT_NE(ran.why().find("1410 point 1"), std::string::npos) << ran.why();
}

TEST(RotationCycles, RefuseAlignmentWithoutRotation) {
  const Ran ran = refusingBench().run(probe(1410, with(edgeWords, {{1126, 1}})));
  EXPECT_EQ(ran.alarm(), "Rotary axes cannot be aligned");
}

TEST(RotationCycles, RefuseAlignmentWithoutAxes) {
  EXPECT_EQ(refusingBench().run(probe(1410, with(edgeWords, {{1121, 2}}))).alarm(), "Rotary axes cannot be aligned");
  EXPECT_EQ(refusingBench().run(probe(1410, with(edgeWords, {{1126, 1}, {1121, 1}}))).alarm(),
            "Rotary axes cannot be aligned");
  EXPECT_EQ(refusingBench().run(probe(1420, with(planeWords, {{1126, 1}, {1121, 1}}))).alarm(),
            "Rotary axes cannot be aligned");
}

TEST(RotationCycles, RefuseRotaryAxesThatDoNotMatchTheTilt) {
  Bench bench = refusingBench("mill5-table-table");
  bench.setup.parameters["chkTiltingAxes"] = {1.0, {}};
  EXPECT_TRUE(bench.run(probe(1420, planeWords)).finished());
  const std::string tilt = "PLANE SPATIAL SPA+0 SPB+10 SPC+0 STAY\n";
  EXPECT_EQ(bench.run(tilt + probe(1420, planeWords)).alarm(), "Rotary axes and tilt do not match");
}

TEST(RotationCycles, RefuseAPlaneThroughALine) {
  const Ran ran = refusingBench().run(probe(1420, with(planeWords, {{1106, 0}, {1107, -30}})));
  EXPECT_EQ(ran.alarm(), "Plane wrongly defined");
}

TEST(RotationCycles, RefuseCoincidingPositions) {
  const Ran ran = refusingBench().run(probe(1410, with(edgeWords, {{1103, -30}})));
  EXPECT_EQ(ran.alarm(), "Angle not determined");
}

TEST(RotationCycles, RefuseOtherTransformations) {
  const std::string mirror = "CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\n";
  const std::string scale = "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 1.1\n";
  for (const std::string& before : {mirror, scale}) {
    const Ran ran = refusingBench().run(before + probe(1410, edgeWords));
    EXPECT_EQ(ran.alarm(), "Coordinate transformation not permitted");
  }
}

TEST(RotationCycles, RefuseWithoutToolCallAndInTurningMode) {
  EXPECT_EQ(refusingBench().runBare(probe(1410, edgeWords)).alarm(), "Touch probe axis not defined");
  EXPECT_EQ(refusingBench().run("FUNCTION MODE TURN\n" + probe(1410, edgeWords)).alarm(), "Function not permitted");
}

TEST(RotationCycles, RefuseWhatIsNotThere) {
  const Ran ran = refusingBench().run(probe(1410, with(edgeWords, {{1101, -80}, {1104, -80}})));
  EXPECT_EQ(ran.alarm(), "Touch point inaccessible");
}

TEST(RotationCycles, RefuseTheToolAxisForARotation) {
  const Ran ran = refusingBench().run(
      probe(1410, with(edgeWords, {{372, -3}, {1101, -30}, {1102, 0}, {1104, -30}, {1105, 0}, {1121, 1}})));
  EXPECT_EQ(ran.alarm(), "Probing direction not permitted");
}

TEST(RotationCycles, RefuseParametersOutOfRange) {
  EXPECT_FALSE(refusingBench().run(probe(1410, with(edgeWords, {{372, 0}}))).finished());
  EXPECT_FALSE(refusingBench().run(probe(1410, with(edgeWords, {{1125, 3}}))).finished());
  EXPECT_FALSE(refusingBench().run(probe(1420, with(planeWords, {{1121, 2}}))).finished());
}

TEST(RotationCycles, DoNotExistOnTheOlderControl) {
  Bench bench(ControlKind::iTNC530);
  bench.preset(1, {0, 0, -400}, 0);
  const Ran ran = bench.run(probe(1410, edgeWords));
  EXPECT_FALSE(ran.finished());
  EXPECT_NE(ran.why().find("does not exist on the iTNC530"), std::string::npos) << ran.why();
}

TEST(RotationCycles, StopOnlyIfTheOperatorGoesOn) {
  Bench bench = refusingBench();
  bench.onStop = control::OnStop::Abort;
  std::map<int, std::string> texts;
  Words rest = edgeWords;
  std::erase_if(rest, [](const auto& word) { return word.first == 1101; });
  const std::string tolerance = " ~\n  QS1101=\"-50.5+-0.1\" ;X";
  const Ran stopped = bench.run(probe(1410, with(rest, {{309, 1}, {1120, 1}}), tolerance));
  EXPECT_EQ(stopped.outcome.result.end, language::RunEnd::Cancelled);
  EXPECT_EQ(stopped.q(183), 2);
  EXPECT_NEAR(stopped.cell("PRESET.PR", "1", "Y"), 0, exact);
  bench.onStop = control::OnStop::Continue;
  const Ran wentOn = bench.run(probe(1410, with(rest, {{309, 1}, {1120, 1}}), tolerance));
  ASSERT_TRUE(wentOn.finished()) << wentOn.why();
  EXPECT_NEAR(wentOn.cell("PRESET.PR", "1", "Y"), 0.5, exact);
}

}  // namespace
}  // namespace probewright::testing_support
