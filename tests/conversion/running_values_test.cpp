#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// What only the running program knows (limits, rows, ways) is carried out as the original does, or named.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

/// A block with a hole about its origin, one top face at height 0, and four rows of presets there.
PlantedPart blockWithHole(double diameter) {
  PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
  part.machineFromPreset = pose({20, -10, -400}, {0, 0, 0});
  for (const int row : {1, 2, 3})
    part.bench.preset(row, {20.0 + 0.1 * row, -10, -400}, 0);
  part.bench.believedProbe().maximumTravel = 20;
  part.bench.probeOf(100, 2);
  part.machineFromPart = part.machineFromPreset;
  part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -30), part.machineFromPart);
  return part;
}

/// Cycle 421 with texts in place of the numbers named.
std::string inspectHole(const std::map<int, std::string>& texts) {
  static constexpr std::pair<int, int> words[] = {{273, 0}, {274, 0},  {262, 50}, {325, 0}, {247, 90}, {261, -8},
                                                  {320, 3}, {260, 30}, {301, 0},  {275, 0}, {276, 0},  {279, 0},
                                                  {280, 0}, {281, 0},  {309, 0},  {330, 0}, {423, 4},  {365, 1}};
  std::string text = "TCH PROBE 421 MEASURE HOLE";
  for (const auto& [number, value] : words) {
    const auto own = texts.find(number);
    text += fmt::format(" ~\n    Q{}={}", number, own == texts.end() ? fmt::format("{:+}", value) : own->second);
  }
  return text + "\nL Z+100 R0 FMAX\n";
}

std::string presetAtTop(const std::string& row) {
  return fmt::format(
      "TCH PROBE 417 PRESET IN TS AXIS ~\n    Q263=+35 ~\n    Q264=+0 ~\n    Q294=+0 ~\n    Q320=+8 ~\n    Q260=+30 "
      "~\n "
      "   Q305={} ~\n    Q333=+2 ~\n    Q303=+1\nL Z+100 R0 FMAX\n",
      row);
}

std::string messagesOf(const Diagnostics& listed) {
  std::string all;
  for (const Diagnostic& each : listed)
    if (isLoss(each)) all += each.message + '\n';
  return all;
}

/// The limits 0 and 0 are none, also where parameters hold them.
TEST(ConvertRunningValues, TakesLimitsThatParametersHold) {
  for (const auto& [limit, tolerance] :
       {std::pair("0", "0"), std::pair("50.1", "0"), std::pair("50.5", "0"), std::pair("0", "0.05")}) {
    for (const bool both : {false, true}) {
      SCOPED_TRACE(fmt::format("{} {} {}", limit, tolerance, both));
      const PlantedPart part = blockWithHole(50.3);
      const std::string lower = both ? "+Q6" : "+0";
      const Twin original = runKlartext(
          klartextProgram(fmt::format("Q5 = {}\nQ6 = Q5 * 0.9\nQ7 = {}\n", limit, tolerance) +
                          inspectHole({{273, "+0.2"}, {275, "+Q5"}, {276, lower}, {279, "+Q7"}, {309, "+1"}}) +
                          "L X+3 Y+4 FMAX\n"),
          part);
      const Twin there = runConverted(original, part);
      EXPECT_TRUE(there.lost.empty()) << messagesOf(there.lost) << there.text;
      const bool exceeds = limit == std::string("50.1") || tolerance != std::string("0");
      EXPECT_EQ(original.finished, !exceeds) << original.why;
      EXPECT_EQ(there.finished, original.finished) << there.why << there.text;
      if (original.finished) {
        EXPECT_TRUE(sameEnd(original, there));
      }
    }
  }
}

TEST(ConvertRunningValues, NamesSwitchesThatParametersHold) {
  EXPECT_THAT(messagesOf(toSinumerik(klartextProgram("Q5 = 0\n" + inspectHole({{309, "+Q5"}}))).notCarriedOver),
              HasSubstr("Q309 is known only when the program runs"));
  std::string preset = probe(
      412, {{321, 0}, {322, 0}, {262, 50}, {325, 0}, {247, 90}, {261, -8}, {320, 3}, {260, 30}, {301, 0}, {305, 1},
            {331, 0}, {332, 0}, {303, 1},  {381, 1}, {382, 35}, {383, 0},  {384, 0}, {333, 0},  {423, 4}, {365, 1}});
  const std::size_t at = preset.find("Q381=") + 5;
  preset.replace(at, preset.find_first_of(" \n", at) - at, "+Q5");
  EXPECT_THAT(messagesOf(toSinumerik(klartextProgram("Q5 = 0\n" + preset)).notCarriedOver),
              HasSubstr("Q381 is known only when the program runs"));
}

/// A row of 0 sets the preset at once; the number of the row may be in a parameter.
TEST(ConvertRunningValues, SetsRowsThatParametersHold) {
  for (const int row : {0, 1, 2}) {
    SCOPED_TRACE(row);
    const PlantedPart part = blockWithHole(50);
    const Twin original =
        runKlartext(klartextProgram(fmt::format("CYCL DEF 247 PRESET ~\n    Q339=+1\nQ5 = {}\n", row) +
                                    presetAtTop("+Q5") + "L X+3 Y+4 FMAX\nL Z+60 FMAX\n"),
                    part);
    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(original));
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameOrigin(original, there));
    EXPECT_TRUE(sameEnd(original, there));
  }
}

TEST(ConvertRunningValues, NamesRowsThatBecomeOneOffset) {
  const auto select = [](int row) { return fmt::format("CYCL DEF 247 PRESET ~\n    Q339=+{}\n", row); };
  const auto named = [](const std::string& blocks) {
    return messagesOf(toSinumerik(klartextProgram(blocks)).notCarriedOver);
  };
  EXPECT_THAT(named(select(99) + select(0)), HasSubstr("row 99 becomes G599"));
  EXPECT_THAT(named(presetAtTop("+0") + select(99)), HasSubstr("row 99 becomes G599"));
  EXPECT_EQ(named(select(99) + select(1)), "");
  EXPECT_EQ(named(select(0) + select(1)), "");
  // An iTNC 530 stays in the row that was in effect before Q305 = 0.
  EXPECT_THAT(named(select(1) + presetAtTop("+0") + presetAtTop("+1")), HasSubstr("an iTNC 530 in the row in effect"));
  EXPECT_EQ(named(select(1) + presetAtTop("+0") + select(1) + presetAtTop("+1")), "");
}

/// Where a cycle leaves the probe is each control's own, whichever way leads to the block that relies on it.
TEST(ConvertRunningValues, NamesWhatReliesOnWhereACycleLeavesTheProbe) {
  const auto named = [](const std::string& blocks) {
    return messagesOf(toSinumerik(klartextProgram(inspectHole({}) + blocks)).notCarriedOver);
  };
  EXPECT_THAT(named("FN 18: SYSREAD Q34 = ID270 NR1 IDX1\n"),
              HasSubstr("where the measuring cycle has left the probe"));
  EXPECT_EQ(named("FN 18: SYSREAD Q34 = ID270 NR1 IDX3\n"), "");
  EXPECT_EQ(named("L X+0 Y+0 FMAX\nFN 18: SYSREAD Q34 = ID270 NR1 IDX1\n"), "");
  EXPECT_THAT(named("FN 9: IF +Q1 EQU +0 GOTO LBL 1\nL X+0 Y+0 FMAX\nLBL 1\nL IX+5 FMAX\n"),
              HasSubstr("IX counts from where the measuring cycle has left the probe"));
  EXPECT_EQ(named("FN 9: IF +Q1 EQU +0 GOTO LBL 1\nL X+3 Y+0 FMAX\nLBL 1\nL X+0 Y+0 FMAX\nLBL 2\nL IX+5 FMAX\n"), "");
  EXPECT_THAT(named("TCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 IX+0 IY+0 IZ-1\n"
                    "TCH PROBE 4.3 ABST+20 F150 MB4 REFERENCE SYSTEM:0\n"),
              HasSubstr("this touch begins where the measuring cycle has left the probe"));
  const auto back = [](const std::string& blocks) {
    return messagesOf(toKlartext("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\nG0 X10 Y-10\nG1 Z-8 F3000\n"
                                 "CYCLE998(5,,0,1,0,0,,5,1,102,1,18,,,,,1)\n" +
                                 blocks + "M30\n")
                          .notCarriedOver);
  };
  EXPECT_THAT(back("R2=$AA_IW[X]\n"), HasSubstr("where the measuring cycle has left the probe"));
  EXPECT_EQ(back("G0 Z50\nG0 X0 Y0\nR2=$AA_IW[X]\n"), "");
  EXPECT_THAT(back("IF R1==1 GOTOF LAB\nG0 Z50\nG0 X0 Y0\nLAB:\nG0 X=IC(5)\n"),
              HasSubstr("where the measuring cycle has left the probe"));
}

TEST(ConvertRunningValues, NamesShiftsOnOneOfTheWaysToACycle) {
  EXPECT_THAT(messagesOf(toSinumerik(klartextProgram("FN 9: IF +Q1 EQU +0 GOTO LBL 1\n"
                                                     "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+5\nLBL 1\n" +
                                                     presetAtTop("+1")))
                             .notCarriedOver),
              HasSubstr("on one of the ways to this block a datum shift"));
}

/// GLOBAL DEF takes what its parameter holds there.
TEST(ConvertRunningValues, KeepsWhatGlobalDefHasTaken) {
  const PlantedPart part = blockWithHole(50);
  const Twin original =
      runKlartext(klartextProgram("Q5 = 3\nGLOBAL DEF 120 PROBING ~\n    Q320=+Q5 ~\n    Q260=+30 ~\n    Q301=+0\n"
                                  "Q5 = 15\n" +
                                  inspectHole({{320, "PREDEF"}}) + "L X+3 Y+4 FMAX\n"),
                  part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(original.finished) << original.why;
  ASSERT_TRUE(there.finished) << there.why << there.text;
  EXPECT_THAT(there.text, HasSubstr("_GLOBAL_320=R5"));
  EXPECT_TRUE(sameEnd(original, there));
}

/// A rotation lies within half a turn, whichever way the line through two spigots points.
TEST(ConvertRunningValues, TurnsByLessThanATurn) {
  const PlantedPart part = [] {
    PlantedPart plain{Bench(ControlKind::TNC640, "mill3")};
    plain.bench.preset(1, {20, -10, -400}, 0);
    plain.bench.believedProbe().maximumTravel = 20;
    plain.bench.probeOf(100, 2);
    for (const double y : {0.0, 40.0})
      plain.bench.part(simulation::RoundBar(10, -30, 0), pose({20, -10 + y, -400}, {0, 0, 0}));
    return plain;
  }();
  // From the upper one down: -90 degrees, against a set angle of 270.
  const Twin original = runKlartext(klartextProgram("CYCL DEF 247 PRESET ~\n    Q339=+1\n" +
                                                    probe(402, {{268, 0},
                                                                {269, 40},
                                                                {313, 20},
                                                                {261, -8},
                                                                {270, 0},
                                                                {271, 0},
                                                                {314, 20},
                                                                {315, -8},
                                                                {320, 8},
                                                                {260, 30},
                                                                {301, 1},
                                                                {307, 270},
                                                                {305, 1},
                                                                {402, 0},
                                                                {337, 0}}) +
                                                    "L X+3 Y+4 FMAX\n"),
                                    part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(ranWhole(original));
  ASSERT_TRUE(ranWhole(there));
  EXPECT_TRUE(sameOrigin(original, there));
  const std::string& frames = there.files.at("FRAMES.UFR");
  EXPECT_EQ(frames.find("360"), std::string::npos) << frames;
  const Twin back = runConverted(there, part);
  EXPECT_TRUE(back.finished) << back.why << back.text;
}

/// Parameters that stand for variables on the way there are nobody else's on the way back.
TEST(ConvertRunningValues, SharesNoParameterWithWhatItDefines) {
  const PlantedPart part = blockWithHole(50);
  const Twin original = runKlartext(
      klartextProgram("Q1600 = 5\nQ1601 = 6\nQ1604 = 7\nQ1605 = 8\nQ1705 = 9\nQ1900 = 10\nL X+35 Y+0 R0 FMAX\n"
                      "L Z+8 R0 FMAX\nTCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q10\n"
                      "TCH PROBE 4.2 IX+0 IY+0 IZ-1\nTCH PROBE 4.3 ABST+20 F150 MB4 REFERENCE SYSTEM:0\n"
                      "L Z+100 R0 FMAX\n" +
                      inspectHole({}) +
                      "Q3 = Q151 + 2\nL X+Q1600 Y+Q1601 R0 FMAX\nL X+Q1604 Y+Q1605 FMAX\nL Z+90 FMAX\n"
                      "L X+Q1705 Y+Q3 FMAX\nL Z+Q1900 FMAX\n"),
      part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(ranWhole(original));
  ASSERT_TRUE(ranWhole(there));
  const Twin back = runConverted(there, part);
  ASSERT_TRUE(ranWhole(back));
  EXPECT_TRUE(sameEnd(original, there));
  EXPECT_TRUE(sameEnd(original, back));
  // A variable whose name only begins like one of them.
  const Twin quality = runSinumerik(
      "DEF REAL _QUALITY=4\nDEF REAL _Q5=3\nG17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\nR5=7\n"
      "G0 X=_QUALITY Y=_Q5\nG0 X=IC(R5)\nM30\n",
      part);
  const Twin klartext = runConverted(quality, part);
  ASSERT_TRUE(ranWhole(klartext));
  EXPECT_TRUE(sameEnd(quality, klartext));
}

/// Touch probe cycles fill Q150 to Q199 and take Q200 and on; a variable that is named after one of them keeps its
/// value.
TEST(ConvertRunningValues, KeepsVariablesThatCyclesWouldOverwrite) {
  const PlantedPart part = blockWithHole(50.2);
  const Twin original = runSinumerik(
      "DEF REAL _Q151=7\nDEF REAL _Q180\nDEF REAL _Q262=9\nDEF REAL _Q600=11\nG17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n"
      "G0 X0.3 Y0\nG0 Z-8\nCYCLE977(1,,,1,50,,,5,10,0,,,,,1)\nG0 Z100\nIF _Q180==1 GOTOF OVER\nG0 Z=90+_Q600\nOVER:\n"
      "G0 X=_Q151 Y=_Q262\nM30\n",
      part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(ranWhole(original));
  EXPECT_TRUE(there.lost.empty()) << messagesOf(there.lost);
  EXPECT_TRUE(ranWhole(there));
  EXPECT_TRUE(sameEnd(original, there)) << there.text;
  EXPECT_NE(there.text.find("Q600 = 11"), std::string::npos) << there.text;
  const Twin back = runConverted(there, part);
  EXPECT_TRUE(ranWhole(back));
  EXPECT_TRUE(sameEnd(original, back)) << back.text;
}

/// A limit of 0 is none, whatever the other one is.
TEST(ConvertRunningValues, MonitorsNoLimitOfZero) {
  for (const double hole : {49.8, 50.2}) {
    const PlantedPart part = blockWithHole(hole);
    for (const bool upper : {true, false}) {
      for (const char* limit : {"+50", "+Q5"}) {
        SCOPED_TRACE(fmt::format("hole {} upper {} limit {}", hole, upper, limit));
        const Twin original = runKlartext(
            klartextProgram("Q5 = 50\n" + inspectHole({{upper ? 275 : 276, limit}, {309, "+1"}}) + "L X+3 Y+4 FMAX\n"),
            part);
        EXPECT_EQ(original.finished, upper == (hole < 50)) << original.why;
        const Twin there = runConverted(original, part);
        EXPECT_TRUE(there.lost.empty()) << messagesOf(there.lost);
        EXPECT_EQ(there.finished, original.finished) << there.why << there.text;
      }
    }
  }
}

/// Which of two limits is 0 only the running program knows.
TEST(ConvertRunningValues, MonitorsNoSideWhoseLimitIsZeroInTheRun) {
  struct Case {
    double upper, lower;
    bool upperHeld, lowerHeld;  ///< by a parameter
  };
  for (const double hole : {49.8, 50.2}) {
    const PlantedPart part = blockWithHole(hole);
    for (const Case& each : std::vector<Case>{{50, 0, true, true},
                                              {0, 50, true, true},
                                              {0, 0, true, true},
                                              {50.1, 49.9, true, true},
                                              {50.5, 49.5, true, true},
                                              {0, 49.9, true, false},
                                              {50.1, 0, false, true},
                                              {50.1, 49.9, false, true}}) {
      SCOPED_TRACE(
          fmt::format("hole {}, limits {} {}, {} {}", hole, each.upper, each.lower, each.upperHeld, each.lowerHeld));
      const auto limit = [](const char* parameter, double value, bool held) {
        return held ? std::string(parameter) : fmt::format("{:+}", value);
      };
      const Twin original = runKlartext(klartextProgram(fmt::format("Q5 = {}\nQ6 = {}\n", each.upper, each.lower) +
                                                        inspectHole({{275, limit("+Q5", each.upper, each.upperHeld)},
                                                                     {276, limit("+Q6", each.lower, each.lowerHeld)},
                                                                     {309, "+1"}}) +
                                                        "L X+3 Y+4 FMAX\n"),
                                        part);
      const bool exceeded = (each.upper != 0 && hole > each.upper) || (each.lower != 0 && hole < each.lower);
      EXPECT_EQ(original.finished, !exceeded) << original.why;
      const Twin there = runConverted(original, part);
      EXPECT_TRUE(there.lost.empty()) << messagesOf(there.lost);
      EXPECT_EQ(there.finished, !exceeded) << there.why << there.text;
    }
  }
}

/// S_KNUM without a number corrects nothing.
TEST(ConvertRunningValues, CorrectsNothingWithoutANumber) {
  const PlantedPart part = blockWithHole(50.2);
  for (const char* number : {"0", "10000"}) {
    const Twin original = runSinumerik(fmt::format("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\nG0 X0.3 Y0\nG0 Z-8\n"
                                                   "CYCLE977(101,{},,1,50,,,5,10,0,,,,,1)\nG0 Z100\nG0 X3 Y4\nM30\n",
                                                   number),
                                       part);
    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(original));
    EXPECT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameOrigin(original, there));
    EXPECT_TRUE(sameEnd(original, there));
  }
}

}  // namespace
}  // namespace probewright::testing_support
