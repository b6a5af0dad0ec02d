#include <algorithm>
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

/// The same with texts that stand in QS parameters, so that only the run can read them.
Ran withComputedTexts(const std::map<int, std::string>& texts, const Words& words, int cycle) {
  Words rest = words;
  std::erase_if(rest, [&](const auto& word) { return texts.contains(word.first); });
  std::string before, more;
  for (const auto& [number, text] : texts) {
    before += fmt::format("QS{} = \"{}\"\n", number - 1000, text);
    more += fmt::format(" ~\n  QS{}=QS{} ;X", number, number - 1000);
  }
  return refusingBench().run(before + probe(cycle, rest, more));
}

/// The edge with some positions as texts.
Ran withTexts(const std::map<int, std::string>& texts, const Words& words = edgeWords, int cycle = 1410) {
  Words rest = words;
  std::erase_if(rest, [&](const auto& word) { return texts.contains(word.first); });
  std::string more;
  for (const auto& [number, text] : texts)
    more += fmt::format(" ~\n  QS{}=\"{}\" ;X", number, text);
  return refusingBench().run(probe(cycle, rest, more));
}

const Words circleWords = {{1100, -30}, {1101, 0}, {1102, -8}, {1116, 20}, {1103, 30},  {1104, 0}, {1105, -8},
                           {1117, 20},  {1115, 0}, {423, 4},   {325, 0},   {1119, 360}, {320, 0},  {260, 20},
                           {1125, 1},   {309, 0},  {1126, 0},  {1120, 0},  {1121, 0}};

struct RotationCycle {
  int number;
  const Words& words;
  const char* asks;  ///< how it asks the operator
};
const RotationCycle rotationCycles[] = {
    {1410, edgeWords, "1410 point 1"}, {1411, circleWords, "1411 object 1"}, {1420, planeWords, "1420 point 1"}};

/// Refused in these words, with no table changed.
void expectRefused(const Ran& ran, const std::string& code, const std::string& part) {
  EXPECT_EQ(ran.alarm(), code) << ran.why();
  EXPECT_NE(ran.why().find(part), std::string::npos) << ran.why();
  for (const auto& cycle : ran.outcome.journal.cycles)
    EXPECT_TRUE(cycle.writes.empty());
}

TEST(RotationCycles, MeasureTheEdgeThatTheRefusalsSpoil) {
  for (const RotationCycle& cycle : rotationCycles) {
    Bench bench = refusingBench();
    if (cycle.number == 1411) {
      bench.setup.world.truth.solids.clear();
      for (const double x : {-30.0, 30.0})
        bench.part(simulation::Ring(10, 15, -40), pose({x, 0, -400}));
    }
    const Ran ran = bench.run(probe(cycle.number, cycle.words));
    EXPECT_TRUE(ran.finished()) << ran.why();
  }
}

TEST(RotationCycles, RefuseTextsThatAreNoPositions) {
  struct Row {
    int parameter;
    const char* text;
    const char* reason;
  };
  const Row rows[] = {{1101, "fifty", "column 1"},
                      {1101, "?-50@-50.1", "cannot have an actual value"},
                      {1104, "10H19", "H19"},
                      {1104, "", "QS1104"}};
  for (const auto& [number, words, asks] : rotationCycles) {
    SCOPED_TRACE(number);
    for (const Row& row : rows) {
      SCOPED_TRACE(row.text);
      expectRefused(withComputedTexts({{row.parameter, row.text}}, words, number), "Nominal position wrong",
                    row.reason);
      // Where the text stands in the program, nothing moves.
      const Ran checked = withTexts({{row.parameter, row.text}}, words, number);
      EXPECT_EQ(checked.outcome.info.exit, records::ExitState::InputMistake);
      EXPECT_TRUE(checked.outcome.journal.cycles.empty());
      EXPECT_NE(checked.why().find(fmt::format("Q{} (", row.parameter)), std::string::npos) << checked.why();
      EXPECT_NE(checked.why().find(fmt::format("= \"{}\": ", row.text)), std::string::npos) << checked.why();
    }
    expectRefused(withTexts({{1101, "100000"}}, words, number), "Nominal position wrong", "-99999.9999 to 99999.9999");
    expectRefused(withTexts({{1101, "-50@Q12"}, {1100, "1@1"}, {1102, "1@1"}}, words, number), "Actual position wrong",
                  "Q1900 to Q1999");
  }
  for (const char* text : {"?20", "20@20.1", "0", "?"}) {
    SCOPED_TRACE(text);
    expectRefused(withTexts({{1116, text}}, circleWords, 1411), "Diameter wrong", "known and larger than 0");
  }
}

TEST(RotationCycles, RefusePositionsWithoutNominal) {
  for (const auto& [number, words, asks] : rotationCycles) {
    SCOPED_TRACE(number);
    expectRefused(withTexts({{1103, "?"}, {1104, "?"}, {1105, "?"}}, words, number), "Nominal position not defined",
                  "Position 2 has no nominal position in any axis (Q1103 to Q1105)");
  }
  // The axes that the object needs: the probed one, both of the plane, or all three.
  expectRefused(withTexts({{1101, "?"}}), "Nominal position not defined", "minor axis, which the cycle needs (Q1101)");
  for (const int parameter : {1100, 1101, 1103, 1104}) {
    expectRefused(withTexts({{parameter, "?"}}, circleWords, 1411), "Nominal position not defined",
                  fmt::format("(Q{})", parameter));
  }
  for (int parameter = 1100; parameter <= 1108; ++parameter) {
    expectRefused(withTexts({{parameter, "?"}}, planeWords, 1420), "Nominal position not defined",
                  fmt::format("(Q{})", parameter));
  }
}

TEST(RotationCycles, RefuseActualPositionsInSomeAxesOnly) {
  for (const auto& [number, words, asks] : rotationCycles) {
    SCOPED_TRACE(number);
    expectRefused(withTexts({{1101, "-50@-50.1"}}, words, number), "Actual position incomplete", "in 1 of three axes");
    expectRefused(withTexts({{1103, "30@30"}, {1105, "-8@-8"}}, words, number), "Actual position incomplete",
                  "Position 2 has an actual position (@) in 2 of three axes");
  }
}

TEST(RotationCycles, RefuseToAskNobody) {
  for (const auto& [number, words, asks] : rotationCycles) {
    SCOPED_TRACE(number);
    const Ran ran = withTexts({{1100, "?-30"}}, words, number);
    expectRefused(ran, "Semi-automatic probing without operator", fmt::format("'{} = MAIN MINOR TOOL'", asks));
  }
}

/// The block of `cycle` with a first position that the operator shows.
std::string asking(const RotationCycle& cycle, int clearanceMode = 1) {
  Words words = with(cycle.words, {{1125, clearanceMode}});
  const auto first = std::ranges::find(words, 1100, &std::pair<int, double>::first);
  const std::string text = fmt::format(" ~\n  QS1100=\"?{}\" ;X", first->second);
  words.erase(first);
  return probe(cycle.number, words, text);
}

TEST(RotationCycles, RefuseAnswersThatAreNoPositions) {
  for (const RotationCycle& cycle : rotationCycles) {
    SCOPED_TRACE(cycle.number);
    for (const char* answer : {"over there", "1 2", "1 2 3 4", "1 2 up", "1 2 30; 5", "1 2 30 W-", "1 2 Y-",
                               "1 2 30 X+ 4", "1 2 30 X+; 1 2 5", "1 2 30 X+ Y+"}) {
      Bench bench = refusingBench();
      bench.answer = [answer](const std::string&) -> std::optional<std::string> { return answer; };
      expectRefused(bench.run(asking(cycle)), "Position of the probe wrong",
                    fmt::format("'{}' is not a position for {}", answer, cycle.asks));
    }
  }
}

/// Another direction than Q372 asks for a nominal value along it, and may not end the rotation that is taken over.
TEST(RotationCycles, RefuseDirectionsThatTheProgramCannotUse) {
  const auto shown = [](const std::string& place, const Words& changes, const std::map<int, std::string>& texts) {
    Bench bench = refusingBench();
    bench.answer = [place](const std::string& question) -> std::optional<std::string> {
      return question == "1410 point 1" ? std::optional(place) : std::nullopt;
    };
    Words rest = with(edgeWords, changes);
    std::erase_if(rest, [&](const auto& word) { return texts.contains(word.first); });
    std::string more;
    for (const auto& [parameter, text] : texts)
      more += fmt::format(" ~\n  QS{}=\"{}\" ;X", parameter, text);
    return bench.run(probe(1410, rest, more));
  };
  expectRefused(shown("-60 0 50; -60 0 -8 X+", {}, {{1100, "?"}, {1101, "?-50"}}), "Nominal position not defined",
                "main axis, which the cycle needs (Q1100)");
  expectRefused(shown("0 0 6 Z-", {{1121, 1}}, {{1100, "?"}, {1102, "?0"}}), "Probing direction not permitted",
                "say nothing about the rotation");
  Bench circles = refusingBench();
  circles.answer = [](const std::string&) -> std::optional<std::string> { return "0 0 50 X+"; };
  expectRefused(circles.run(asking(rotationCycles[1])), "Position of the probe wrong", "1411 object 1");
}

TEST(RotationCycles, StopWhereTheOperatorGivesUpOrStandsWrong) {
  for (const RotationCycle& cycle : rotationCycles) {
    SCOPED_TRACE(cycle.number);
    Bench bench = refusingBench();
    bench.answer = [](const std::string&) -> std::optional<std::string> { return "200 200 50"; };
    // Far from the part nothing is touched within DIST.
    expectRefused(bench.run(asking(cycle)), "Touch point inaccessible", "not deflected within");
    bench.onStop = control::OnStop::Abort;
    const Ran cancelled = bench.run(asking(cycle));
    EXPECT_EQ(cancelled.outcome.result.end, execution::RunEnd::Cancelled);
    EXPECT_EQ(cancelled.touches(), 0U);
  }
}

/// With Q1125 = 1 or 2 the operator is told to retract by hand; with -1 and 0 he is not.
TEST(RotationCycles, TellTheOperatorToRetract) {
  for (const int mode : {-1, 0, 1, 2}) {
    SCOPED_TRACE(mode);
    Bench bench = refusingBench();
    bench.answer = [](const std::string& question) -> std::optional<std::string> {
      if (question == "1420 point 1") return "-30 -30 5";
      return std::nullopt;
    };
    const Ran ran = bench.run(asking(rotationCycles[2], mode));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto screens = ran.screens();
    ASSERT_EQ(screens.size(), mode > 0 ? 2U : 1U);
    EXPECT_NE(screens.front().find("1420 point 1: move the probe in front of the point"), std::string::npos);
    if (mode > 0) {
      EXPECT_NE(screens.back().find("no automatic retraction to the clearance height"), std::string::npos);
    }
  }
}

/// After a point that the operator has shown the manual has Q1125 = 1 and 2 ignored: nothing moves by itself, also
/// where the program knows the next points. Q1125 = 0 counts: at the end of the cycle the probe goes to the clearance
/// height.
TEST(RotationCycles, LeaveTheProbeWhereTheOperatorHasItUntilTheEnd) {
  for (const int number : {1410, 1420}) {
    for (const int mode : {-1, 0, 1, 2}) {
      SCOPED_TRACE(fmt::format("{}, Q1125 {}", number, mode));
      std::map<int, std::string> texts = {{1103, "30@30"}, {1105, number == 1410 ? "-8@-8" : "0@0"}};
      texts[1104] = number == 1410 ? "-50@-50" : "-30@-30";
      if (number == 1420) texts.insert({{1106, "0@0"}, {1107, "30@30"}, {1108, "0@0"}});
      texts[1100] = "?-30";
      Words rest = with(number == 1410 ? edgeWords : planeWords, {{1125, mode}});
      std::erase_if(rest, [&](const auto& word) { return texts.contains(word.first); });
      std::string more;
      for (const auto& [parameter, text] : texts)
        more += fmt::format(" ~\n  QS{}=\"{}\" ;X", parameter, text);
      Bench bench = refusingBench();
      const std::string first = std::to_string(number) + " point 1";
      bench.answer = [&](const std::string& question) -> std::optional<std::string> {
        if (question != first) return std::nullopt;
        return number == 1410 ? "-30 -60 30; -30 -60 -8" : "-30 -30 6";
      };
      const Ran ran = bench.run(probe(number, rest, more));
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_EQ(ran.touches(), 1U);
      // The spindle nose stands above the tip by the length of the probe.
      const auto stands = ran.machine->position();
      const double tip = mode == 0 ? 20 : number == 1410 ? -8 : 6;
      EXPECT_NEAR(stands[2], -400 + 100 + tip, exact);
    }
  }
}

TEST(RotationCycles, RefuseAlignmentWithoutRotation) {
  for (const auto& [number, words, asks] : rotationCycles) {
    for (const int aligns : {1, 2}) {
      SCOPED_TRACE(number);
      for (const char* machine : {"mill3", "mill5-table-table"}) {
        expectRefused(refusingBench(machine).run(probe(number, with(words, {{1126, aligns}}))),
                      "Rotary axes cannot be aligned", "Q1121 takes over no rotation");
      }
    }
  }
}

TEST(RotationCycles, RefuseAlignmentWithoutAxes) {
  const std::string nearest = "nearest to the workpiece does not turn about the tool axis";
  for (const auto& [number, words] : {std::pair(1410, edgeWords), {1411, circleWords}}) {
    SCOPED_TRACE(number);
    for (const Words& wish : {Words{{1121, 2}}, Words{{1126, 1}, {1121, 1}}, Words{{1126, 2}, {1121, 2}}}) {
      // No table, and a table that has been tilted: its C axis stands askew to the tool.
      expectRefused(refusingBench().run(probe(number, with(words, wish))), "Rotary axes cannot be aligned", nearest);
      expectRefused(refusingBench("mill5-head-head").run(probe(number, with(words, wish))),
                    "Rotary axes cannot be aligned", nearest);
      const std::string tilted = "L Z-1 R0 FMAX M91\nL A+30 R0 FMAX\n";
      expectRefused(refusingBench("mill5-table-table").run(tilted + probe(number, with(words, wish))),
                    "Rotary axes cannot be aligned", nearest);
    }
  }
  expectRefused(refusingBench().run(probe(1420, with(planeWords, {{1126, 1}, {1121, 1}}))),
                "Rotary axes cannot be aligned", "fewer than two rotary axes");
}

TEST(RotationCycles, RefuseRotaryAxesThatDoNotMatchTheTilt) {
  Bench bench = refusingBench("mill5-table-table");
  bench.setup.beliefs.parameters["chkTiltingAxes"] = {1.0, {}};
  EXPECT_TRUE(bench.run(probe(1420, planeWords)).finished());
  const std::string tilt = "PLANE SPATIAL SPA+0 SPB+10 SPC+0 STAY\n";
  expectRefused(bench.run(tilt + probe(1420, planeWords)), "Rotary axes and tilt do not match", "chkTiltingAxes");
}

TEST(RotationCycles, RefuseWhatDeterminesNothing) {
  expectRefused(refusingBench().run(probe(1420, with(planeWords, {{1106, 0}, {1107, -30}}))), "Plane wrongly defined",
                "one straight line");
  for (const int along : {-2, -1, 1, 2}) {
    expectRefused(refusingBench().run(probe(1420, with(planeWords, {{372, along}}))), "Plane wrongly defined",
                  "lies along the probing direction");
  }
  expectRefused(refusingBench().run(probe(1410, with(edgeWords, {{1103, -30}}))), "Angle not determined",
                "coincide in the working plane");
  // Known positions of two circles in one place.
  const Ran same = withTexts(
      {{1100, "5@5"}, {1101, "5@5"}, {1102, "0@0"}, {1103, "30@5"}, {1104, "0@5"}, {1105, "0@1"}}, circleWords, 1411);
  expectRefused(same, "Angle not determined", "coincide in the working plane");
  expectRefused(refusingBench().run(probe(1411, with(circleWords, {{1119, 0}}))), "Angular length wrong", "Q1119 = 0");
}

TEST(RotationCycles, RefuseHolesThatTheBallDoesNotFitInto) {
  expectRefused(refusingBench().run(probe(1411, with(circleWords, {{1116, 3.9}}))), "Hole too small",
                "does not fit into a hole of diameter 3.9000 mm");
}

TEST(RotationCycles, RefuseOtherTransformations) {
  const std::string mirror = "CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\n";
  const std::string scale = "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 1.1\n";
  const std::string axes = "CYCL DEF 26.0 AXIS-SPEC. SCALING\nCYCL DEF 26.1 X1.1 CCX+0 CCY+0\n";
  for (const auto& [number, words, asks] : rotationCycles) {
    for (const std::string& before : {mirror, scale, axes}) {
      expectRefused(refusingBench().run(before + probe(number, words)), "Coordinate transformation not permitted",
                    "cycle 8, 11 or 26");
    }
  }
}

TEST(RotationCycles, RefuseWithoutToolCallAndInTurningMode) {
  for (const auto& [number, words, asks] : rotationCycles) {
    expectRefused(refusingBench().runBare(probe(number, words)), "Touch probe axis not defined", "TOOL CALL");
    expectRefused(refusingBench().run("FUNCTION MODE TURN\n" + probe(number, words)), "Function not permitted",
                  "FUNCTION MODE MILL");
  }
}

TEST(RotationCycles, RefuseWhatIsNotThere) {
  expectRefused(refusingBench().run(probe(1410, with(edgeWords, {{1101, -80}, {1104, -80}}))),
                "Touch point inaccessible", "not deflected within");
}

TEST(RotationCycles, RefuseTheToolAxisForARotation) {
  for (const int rotation : {1, 2}) {
    expectRefused(
        refusingBench("mill5-table-table")
            .run(probe(1410,
                       with(edgeWords, {{372, -3}, {1101, -30}, {1102, 0}, {1104, -30}, {1105, 0}, {1121, rotation}}))),
        "Probing direction not permitted", "say nothing about the rotation");
  }
}

TEST(RotationCycles, RefuseParametersOutOfRange) {
  const auto mistake = [](int number, const Words& words, const std::string& part) {
    const Ran ran = refusingBench().run(probe(number, words));
    EXPECT_EQ(ran.outcome.info.exit, records::ExitState::InputMistake);
    EXPECT_NE(ran.why().find(part), std::string::npos) << ran.why();
  };
  for (const int number : {1410, 1420}) {
    const Words& words = number == 1410 ? edgeWords : planeWords;
    mistake(number, with(words, {{372, 0}}), "Q372");
    mistake(number, with(words, {{372, 4}}), "Q372");
  }
  for (const auto& [number, words, asks] : rotationCycles) {
    mistake(number, with(words, {{1125, 3}}), "Q1125");
    mistake(number, with(words, {{309, 3}}), "Q309");
    mistake(number, with(words, {{1126, 3}}), "Q1126");
    mistake(number, with(words, {{1120, 5}}), "Q1120");
    mistake(number, with(words, {{1121, 3}}), "Q1121");
    mistake(number, with(words, {{1100, 100000}}), "Q1100");
    mistake(number, with(words, {{320, -1}}), "Q320");
  }
  mistake(1420, with(planeWords, {{1121, 2}}), "Q1121");
  mistake(1411, with(circleWords, {{423, 9}}), "Q423");
  mistake(1411, with(circleWords, {{1115, 4}}), "Q1115");
  const Ran kind = withTexts({{1115, "1"}}, circleWords, 1411);
  EXPECT_EQ(kind.outcome.info.exit, records::ExitState::InputMistake);
  EXPECT_NE(kind.why().find("takes a number, not a text"), std::string::npos) << kind.why();
  mistake(1411, with(circleWords, {{1119, 361}}), "Q1119");
  mistake(1411, with(circleWords, {{1116, 10000}}), "Q1116");
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
  EXPECT_EQ(stopped.outcome.result.end, execution::RunEnd::Cancelled);
  EXPECT_EQ(stopped.q(183), 2);
  EXPECT_NEAR(stopped.cell("PRESET.PR", "1", "Y"), 0, exact);
  bench.onStop = control::OnStop::Continue;
  const Ran wentOn = bench.run(probe(1410, with(rest, {{309, 1}, {1120, 1}}), tolerance));
  ASSERT_TRUE(wentOn.finished()) << wentOn.why();
  EXPECT_NEAR(wentOn.cell("PRESET.PR", "1", "Y"), 0.5, exact);
}

}  // namespace
}  // namespace probewright::testing_support
