#include <gmock/gmock.h>

#include "conversion/parameter_texts.hpp"
#include "conversion/twins.hpp"
#include "session/check.hpp"

/// Exit code 0 means that nothing was lost: what is hard to carry over is carried over, or named.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

PlantedPart plainTable() {
  PlantedPart part;
  part.bench.preset(1, {10, 20, -300});
  return part;
}

/// A block with a hole about its origin, where the program expects it but for `off`.
PlantedPart blockWithHole(double diameter, const Vector3& off = Vector3::Zero()) {
  PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
  part.machineFromPreset = pose({20, -10, -400}, {0, 0, 0});
  part.bench.preset(1, {20, -10, -400}, 0);
  part.bench.believedProbe().maximumTravel = 20;
  part.bench.probeOf(100, 2);
  part.machineFromPart = part.machineFromPreset * pose(off, {0, 0, 0});
  part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -30), part.machineFromPart);
  return part;
}

std::string inspectHole(double nominal, double upper, double lower, double centre1 = 0, double centre2 = 0) {
  return probe(421, {{273, 0},
                     {274, 0},
                     {262, nominal},
                     {325, 0},
                     {247, 90},
                     {261, -8},
                     {320, 1},
                     {260, 30},
                     {301, 0},
                     {275, upper},
                     {276, lower},
                     {279, centre1},
                     {280, centre2},
                     {281, 0},
                     {309, 0},
                     {330, 0},
                     {423, 4},
                     {365, 1}});
}

std::string sinumerikProgram(const std::string& blocks) {
  return "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + blocks + "M30\n";
}

/// The cycle of the other control does not judge the place of a hole.
TEST(ConvertPromises, TellsThatTheCentreIsJudgedByTheProgram) {
  struct Case {
    double centre1, centre2;
    bool told;
  };
  for (const Case& each : {Case{0, 0, false}, {0.1, 0, true}, {0, 0.1, true}, {0.1, 0.2, true}}) {
    const conversion::Conversion there =
        toSinumerik(klartextProgram(inspectHole(40, 0, 0, each.centre1, each.centre2)));
    const bool told = std::ranges::any_of(there.notCarriedOver, [](const Diagnostic& mistake) {
      return mistake.message.find("Q279, Q280") != std::string::npos;
    });
    EXPECT_EQ(told, each.told) << each.centre1 << ", " << each.centre2;
  }
}

/// The program judges each coordinate of a bolt circle that has a tolerance, and no other.
TEST(ConvertPromises, JudgesTheCentreOfABoltCircle) {
  const auto inspected = [](double centre1, double centre2) {
    return toSinumerik(klartextProgram(probe(430, {{273, 0},
                                                   {274, 0},
                                                   {262, 80},
                                                   {291, 0},
                                                   {292, 120},
                                                   {293, 240},
                                                   {261, -8},
                                                   {260, 30},
                                                   {288, 0},
                                                   {289, 0},
                                                   {279, centre1},
                                                   {280, centre2},
                                                   {281, 0},
                                                   {309, 1},
                                                   {330, 0}})))
        .text;
  };
  EXPECT_THAT(inspected(0.4, 0), HasSubstr(">0.4)"));
  EXPECT_THAT(inspected(0.4, 0), Not(HasSubstr(">0)")));
  EXPECT_THAT(inspected(0, 0.3), HasSubstr(">0.3)"));
  EXPECT_THAT(inspected(0, 0.3), Not(HasSubstr(">0)")));
  EXPECT_THAT(inspected(0, 0), Not(HasSubstr("ABS(")));
}

/// CYCLE998 takes a required angle up to 45 degrees, that one with it.
TEST(ConvertPromises, AlignsEdgesByUpTo45Degrees) {
  for (const auto& [angle, carried] : {std::pair(45.0, true), {-45.0, true}, {45.001, false}, {-45.001, false}}) {
    const conversion::Conversion there = toSinumerik(klartextProgram(probe(400, {{263, 10},
                                                                                 {264, 0},
                                                                                 {265, 40},
                                                                                 {266, 0},
                                                                                 {272, 2},
                                                                                 {267, 1},
                                                                                 {261, -5},
                                                                                 {320, 2},
                                                                                 {260, 20},
                                                                                 {301, 0},
                                                                                 {307, angle},
                                                                                 {305, 1}})));
    EXPECT_EQ(there.text.find("CYCLE998(") != std::string::npos, carried) << angle;
    EXPECT_EQ(there.text.find("; NOT CARRIED OVER: ") == std::string::npos, carried) << angle;
  }
}

control::Verdict verdictOf(const Twin& twin) {
  control::Verdict verdict = control::Verdict::None;
  for (const control::CycleRecord& cycle : twin.journal.cycles)
    verdict = std::max(verdict, cycle.verdict);
  return verdict;
}

TEST(ConvertPromises, SubprogramsReturnEarly) {
  const PlantedPart part = plainTable();
  for (const char* blocks :
       {// Two LBL 0, and a jump over the first one.
        "Q3 = 1\nCALL LBL 1\nQ3 = 2\nCALL LBL 1\nL X+Q1 Y+Q2 R0 FMAX M30\n"
        "LBL 1\nFN 9: IF +Q3 EQU +1 GOTO LBL 10\nQ1 = Q1 + 1\nLBL 0\nLBL 10\nQ2 = Q2 + 5\nLBL 0\n",
        // A jump out, and back from there.
        "CALL LBL \"AB\"\nL X+Q1 Y+Q2 R0 FMAX M30\nLBL \"AB\"\nQ1 = Q1 + 1\nFN 12: IF +Q1 LT +5 GOTO LBL \"AC\"\n"
        "Q2 = Q2 + 7\nLBL 0\nLBL \"AC\"\nQ2 = Q2 + 1\nFN 9: IF +0 EQU +0 GOTO LBL \"AB\"\n",
        // A repetition that is left counts on when it is met again.
        "LBL 2\nQ1 = Q1 + 1\nFN 9: IF +Q1 EQU +2 GOTO LBL 3\nCALL LBL 2 REP 3\nLBL 3\nQ2 = Q2 + 1\n"
        "FN 12: IF +Q2 LT +3 GOTO LBL 2\nL X+Q1 Y+Q2 R0 FMAX M30\n"}) {
    const Twin original = runKlartext(klartextProgram("Q1 = 0\nQ2 = 0\n" + std::string(blocks)), part);
    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(original));
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameEnd(original, there));
  }
}

TEST(ConvertPromises, LabelsThatStandTwiceGetNamesOfTheirOwn) {
  const PlantedPart part = plainTable();
  const std::string blocks =
      "R1=0\nR2=0\nAGAIN: R1=R1+1\nIF R1<3 GOTOB AGAIN\nGOTOF AGAIN\nR2=50\nAGAIN: R2=R2+1\nIF R2<4 GOTOB AGAIN\n"
      "G0 X=R1 Y=R2\n";
  const Twin original = runSinumerik(sinumerikProgram(blocks), part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(ranWhole(original));
  ASSERT_TRUE(ranWhole(there));
  EXPECT_TRUE(sameEnd(original, there));
  EXPECT_THAT(there.text, HasSubstr("LBL \"AGAIN_2\""));
}

TEST(ConvertPromises, OverlappingSectionsComeBack) {
  const PlantedPart part = plainTable();
  const std::string blocks =
      "R1=0\nR2=0\nBEGINA: R1=R1+1\nBEGINB: R2=R2+1\nENDB: R1=R1+10\nENDA: R2=R2+100\n"
      "REPEAT BEGINA ENDA P=2\nREPEAT BEGINB ENDB P=5\nR9=R9+1\nG0 X=R1/10 Y=R2/10\n";
  const Twin original = runSinumerik(sinumerikProgram(blocks), part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(ranWhole(original));
  ASSERT_TRUE(ranWhole(there));
  EXPECT_TRUE(sameEnd(original, there));
}

/// What a way sets that not all ways set is named where it counts.
TEST(ConvertPromises, NamesWhatDependsOnTheWay) {
  const conversion::Conversion doubtful = toKlartext(sinumerikProgram("IF R1==1\nG91\nENDIF\nG0 X5\nG90\nG0 X7\n"));
  ASSERT_EQ(doubtful.notCarriedOver.size(), 1U) << doubtful.text;
  EXPECT_THAT(doubtful.notCarriedOver[0].message, HasSubstr("G90 or G91"));
  EXPECT_EQ(doubtful.notCarriedOver[0].place.line, 8U);
  const conversion::Conversion agreed = toKlartext(sinumerikProgram("IF R1==1\nG91\nELSE\nG91\nENDIF\nG0 X5\n"));
  EXPECT_TRUE(agreed.notCarriedOver.empty()) << format(agreed.notCarriedOver.front());
  EXPECT_THAT(agreed.text, HasSubstr("L IX+5"));
  const conversion::Conversion shifted = toSinumerik(
      klartextProgram("LBL 1\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 IX+10\nL X+0 R0 FMAX\nCALL LBL 1 REP 2\n"));
  ASSERT_EQ(shifted.notCarriedOver.size(), 1U) << shifted.text;
  EXPECT_THAT(shifted.notCarriedOver[0].message, HasSubstr("which shift"));
}

TEST(ConvertPromises, CountsShiftsIntoTouchProbeCycles) {
  const PlantedPart part = blockWithHole(40, {0.3, -0.2, 0});
  for (const char* frame : {"TRANS X-30 Y12\n", "R1=-30\nTRANS X=R1 Y12 Z3\nR1=7\n", "TRANS X-30 Y12\nAROT Z20\n"}) {
    SCOPED_TRACE(frame);
    const bool turned = std::string_view(frame).find("AROT") != std::string_view::npos;
    // The hole lies at 0, 0 of the zero offset.
    const double c = std::cos(radians(20)), s = std::sin(radians(20));
    const Vector2 place = turned ? Vector2(30 * c - 12 * s, -30 * s - 12 * c) : Vector2(30, -12);
    const double z = std::string_view(frame).find("Z3") != std::string_view::npos ? -13 : -10;
    const std::string blocks = std::string(frame) +
                               fmt::format("G0 X{:.9f} Y{:.9f}\nG0 Z{}\n", place.x(), place.y(), z) +
                               sinumerikCall("CYCLE977", {{"S_MVAR", turned ? 1 : 101},
                                                          {"S_KNUM", turned ? 0 : 10001},
                                                          {"S_PRNUM", 1},
                                                          {"S_SETV", 40},
                                                          {"S_FA", 4},
                                                          {"S_TSA", 8},
                                                          {"S_NMSP", 1}}) +
                               "R5=_OVR[5]\nR6=_OVR[6]\nG0 Z50\nG0 X=R5 Y=R6\n";
    const Twin original = runSinumerik(sinumerikProgram(blocks), part);
    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(original));
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameEnd(original, there));
    EXPECT_TRUE(sameOrigin(original, there));
  }
  // The first touch of the hole lies in the direction of the turned axis, and so it does without the rotation.
  const conversion::Conversion hole = toKlartext(sinumerikProgram(
      "ROT Z20\n" +
      sinumerikCall("CYCLE977", {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_STA1", 15}, {"S_FA", 5}, {"S_TSA", 8}})));
  EXPECT_THAT(hole.text, HasSubstr("Q325=+35 "));
  // A pocket along turned axes has no touch probe cycle.
  const conversion::Conversion pocket = toKlartext(sinumerikProgram(
      "ROT Z5\n" +
      sinumerikCall("CYCLE977", {{"S_MVAR", 5}, {"S_SETV0", 30}, {"S_SETV1", 20}, {"S_FA", 5}, {"S_TSA", 8}})));
  ASSERT_EQ(warningsOf(pocket).size(), 1U) << pocket.text;
  EXPECT_THAT(warningsOf(pocket)[0].message, HasSubstr("permit no rotation"));
}

TEST(ConvertPromises, PresetsKeepTheFramesOfTheOtherControl) {
  PlantedPart part = plainTable();
  part.bench.preset(2, {-30, 5, -280}, 0);
  const Twin original = runSinumerik(sinumerikProgram("TRANS X11 Y3\nG55\nG0 X1 Y2\n"), part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(ranWhole(there));
  EXPECT_TRUE(sameEnd(original, there));
  const Twin klartext = runKlartext(
      klartextProgram(
          "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+11\nCYCL DEF 247 PRESET ~\n  Q339=+2\nL X+1 Y+2 R0 FMAX\n"),
      part);
  const Twin sinumerik = runConverted(klartext, part);
  ASSERT_TRUE(ranWhole(sinumerik));
  EXPECT_TRUE(sameEnd(klartext, sinumerik));
}

TEST(ConvertPromises, JudgesByLimitsThatNobodyReads) {
  for (const double size : {40.05, 40.005, 39.9}) {
    const PlantedPart part = blockWithHole(size);
    const Twin original = runKlartext(klartextProgram(inspectHole(40, 40.02, 39.99)), part);
    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(original));
    ASSERT_TRUE(ranWhole(there));
    EXPECT_EQ(verdictOf(original), size > 40.02   ? control::Verdict::Scrap
                                   : size < 39.99 ? control::Verdict::Rework
                                                  : control::Verdict::Good);
    EXPECT_EQ(verdictOf(there), verdictOf(original)) << there.text;
    const Twin back = runConverted(there, part);
    ASSERT_TRUE(ranWhole(back));
    EXPECT_EQ(verdictOf(back), verdictOf(original)) << back.text;
  }
  // Limits that the cycle cannot judge by are named.
  const std::string pocket = probe(423, {{273, 0},
                                         {274, 0},
                                         {282, 30},
                                         {283, 20},
                                         {261, -8},
                                         {320, 1},
                                         {260, 30},
                                         {301, 0},
                                         {284, 30.1},
                                         {285, 29.9},
                                         {286, 20.3},
                                         {287, 19.9},
                                         {279, 0},
                                         {280, 0},
                                         {281, 0},
                                         {309, 0},
                                         {330, 0}});
  const conversion::Conversion there = toSinumerik(klartextProgram(pocket));
  ASSERT_EQ(warningsOf(there).size(), 1U) << there.text;
  EXPECT_THAT(warningsOf(there)[0].message, HasSubstr("limits"));
  EXPECT_THAT(there.text, HasSubstr("SETAL(67000"));
}

/// CYCLE977 goes over the middle of a spigot at the clearance height, cycles of a HEIDENHAIN control beside it.
TEST(ConvertPromises, NamesClearanceHeightsBesideSpigots) {
  const auto spigot = [](double clearance) {
    return toSinumerik(klartextProgram(probe(424, {{273, 0},
                                                   {274, 0},
                                                   {282, 20},
                                                   {283, 30},
                                                   {261, -8},
                                                   {320, 6},
                                                   {260, clearance},
                                                   {301, 0},
                                                   {284, 0},
                                                   {285, 0},
                                                   {286, 0},
                                                   {287, 0},
                                                   {279, 0},
                                                   {280, 0},
                                                   {281, 0},
                                                   {309, 0},
                                                   {330, 0}})));
  };
  EXPECT_FALSE(lists(spigot(5), "Q260"));
  EXPECT_TRUE(lists(spigot(-8), "Q260"));
  EXPECT_TRUE(lists(spigot(-20), "Q260"));
}

TEST(ConvertPromises, MeasuresSmallHolesFromTheirMiddle) {
  const PlantedPart part = blockWithHole(8.03, {0.3, 0.2, 0});
  const Twin original = runKlartext(klartextProgram(inspectHole(8, 0, 0) + "L X+Q151 Y+Q152 R0 FMAX\n"), part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(ranWhole(original));
  ASSERT_TRUE(ranWhole(there));
  EXPECT_TRUE(sameEnd(original, there));
}

TEST(ConvertPromises, WritesTheParameterTextsOfTheControl) {
  const conversion::Conversion there = toKlartext(sinumerikProgram(
      "G0 X0 Y0\nG0 Z5\n" +
      sinumerikCall(
          "CYCLE978",
          {{"S_MVAR", 100}, {"S_KNUM", 10001}, {"S_SETV", 0}, {"S_FA", 4}, {"S_TSA", 8}, {"S_MA", 3}, {"S_MD", 2}})));
  EXPECT_THAT(there.text, HasSubstr("Q263=+0 ;1ST POINT 1ST AXIS ~\n"));
  EXPECT_THAT(there.text, HasSubstr("Q264=+0 ;1ST POINT 2ND AXIS ~\n"));
  EXPECT_THAT(there.text, HasSubstr("Q294=+0 ;1ST POINT 3RD AXIS ~\n"));
  for (const control::ControlKind kind : {control::ControlKind::TNC640, control::ControlKind::iTNC530}) {
    for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(kind)) {
      for (const cycles::Parameter& parameter : cycle->parameters) {
        if (!parameter.name.starts_with("Q") || parameter.name.size() < 4) continue;
        for (const control::DialogLanguage language : control::allDialogLanguages) {
          const auto text = conversion::parameterText(cycle->number, static_cast<int>(parameter.address), language);
          EXPECT_NE(text, "PARAMETER") << cycle->name << " " << parameter.name;
        }
      }
    }
  }
}

TEST(ConvertPromises, KeepsCommentsOfSeveralLines) {
  const conversion::Conversion there = toSinumerik(klartextProgram("; FIRST ~\n  SECOND ~\n  THIRD\nL X+1 R0 FMAX\n"));
  EXPECT_THAT(there.text, HasSubstr("; FIRST\n; SECOND\n; THIRD\n")) << there.text;
}

TEST(ConvertPromises, NamesWhatItDrops) {
  const conversion::Conversion shortest = toSinumerik(klartextProgram("L X+1 R0 FMAX M126\n"));
  ASSERT_EQ(shortest.notCarriedOver.size(), 1U);
  EXPECT_THAT(shortest.notCarriedOver[0].message, HasSubstr("M126"));
  EXPECT_THAT(shortest.text, HasSubstr("G0 X1\n"));
  for (const char* call : {"CYCLE971()", "CYCLE982()", "CYCLE996()", "CYCLE116()", "CYCLE982", "CUST_CLAMP()"}) {
    const conversion::Conversion there = toKlartext(sinumerikProgram(std::string(call) + "\n"));
    ASSERT_EQ(there.notCarriedOver.size(), 1U) << there.text;
    EXPECT_THAT(there.text, HasSubstr(fmt::format("; NOT CARRIED OVER: {}", call)));
    EXPECT_THAT(there.text, Not(HasSubstr("CALL PGM")));
  }
  const conversion::Conversion fine = toKlartext(sinumerikProgram(
      sinumerikCall("CYCLE977", {{"S_MVAR", 101}, {"S_KNUM", 1}, {"S_SETV", 40}, {"S_FA", 4}, {"S_TSA", 8}})));
  EXPECT_THAT(fine.text, HasSubstr("; S_KNUM: THE FINE OFFSET"));
}

/// Nothing is written that the check of the other control refuses.
TEST(ConvertPromises, NamesFeaturesWithoutASize) {
  for (const double nominal : {0.0, 30.0}) {
    const conversion::Conversion there = toSinumerik(klartextProgram(inspectHole(nominal, 0, 0)));
    EXPECT_EQ(warningsOf(there).empty(), nominal > 0) << there.text;
    EXPECT_EQ(there.text.find("\nCYCLE977(") == std::string::npos, nominal == 0) << there.text;
  }
}

/// REP 0 of a HEIDENHAIN control calls a subprogram, P=0 of a SINUMERIK repeats nothing.
TEST(ConvertPromises, RepeatsNothingNoTimes) {
  const PlantedPart part = plainTable();
  for (const char* times : {"0", "-1", "R2", "1", "3"}) {
    SCOPED_TRACE(times);
    const Twin original = runSinumerik(
        sinumerikProgram(fmt::format("R1=0\nR2=0\nPART: R1=R1+1\nREPEAT PART P={}\nG0 X=R1 Y0\n", times)), part);
    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(original));
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameEnd(original, there));
  }
  const std::string blocks =
      "Q1 = 0\nFN 9: IF +0 EQU +0 GOTO LBL 2\nLBL 1\nQ1 = Q1 + 1\nLBL 0\nLBL 2\nCALL LBL 1 REP 0\n";
  const Twin klartext = runKlartext(klartextProgram(blocks + "L X+Q1 Y+0 R0 FMAX\n"), part);
  const Twin sinumerik = runConverted(klartext, part);
  ASSERT_TRUE(ranWhole(klartext));
  ASSERT_TRUE(ranWhole(sinumerik));
  EXPECT_TRUE(sameEnd(klartext, sinumerik));
}

TEST(ConvertPromises, NamesWhatHasNoTwinOfItsOwn) {
  const conversion::Conversion skip = toKlartext(sinumerikProgram("/G0 X1\n/1 G0 X2\n/1 G0 X3\n/7 G0 X4\n"));
  ASSERT_EQ(skip.notCarriedOver.size(), 2U);  // each level once
  EXPECT_THAT(skip.notCarriedOver[0].message, HasSubstr("/1"));
  EXPECT_EQ(skip.notCarriedOver[0].place.line, 6U);
  EXPECT_THAT(skip.notCarriedOver[1].message, HasSubstr("/7"));
  // A message that is shown only does not become an error that stops.
  const conversion::Conversion shown = toKlartext(sinumerikProgram("SETAL(67001)\nSETAL(65001)\n"));
  ASSERT_EQ(shown.notCarriedOver.size(), 1U) << shown.text;
  EXPECT_THAT(shown.notCarriedOver[0].message, HasSubstr("goes on"));
  EXPECT_THAT(shown.text, HasSubstr("FN 14: ERROR = 1001"));
  EXPECT_THAT(shown.text, Not(HasSubstr("ERROR = 3001")));
  // Fine offset and preset are one: a note says so.
  const conversion::Conversion fine = toKlartext(sinumerikProgram(
      sinumerikCall("CYCLE977", {{"S_MVAR", 101}, {"S_KNUM", 1}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 8}})));
  EXPECT_TRUE(warningsOf(fine).empty());
  EXPECT_TRUE(std::ranges::any_of(fine.notCarriedOver, [](const Diagnostic& each) {
    return each.message.find("fine offset") != std::string::npos;
  })) << fine.text;
}

/// Whether the program reads the status or not, the verdict of uneven limits is listed.
TEST(ConvertPromises, NamesVerdictsThatTheCycleDoesNotTell) {
  for (const char* read : {"", "Q1 = Q180\n"}) {
    for (const int tolerance : {279, 280, 275}) {
      std::string block = inspectHole(40, 40.9, tolerance == 275 ? 40.6 : 39.1);
      if (tolerance != 275) {
        const std::string name = fmt::format("Q{}=+0", tolerance);
        block.replace(block.find(name), name.size(), fmt::format("Q{}=+1", tolerance));
      }
      const conversion::Conversion there = toSinumerik(klartextProgram(block + read));
      ASSERT_EQ(warningsOf(there).size(), 1U) << there.text;
      EXPECT_THAT(warningsOf(there)[0].message, HasSubstr("verdict"));
      EXPECT_THAT(there.text, HasSubstr("SETAL(67000"));
    }
  }
}

/// Words that the other control does not have, or that mean something else there, are named.
TEST(ConvertPromises, NamesWordsThatWouldLeadElsewhere) {
  const auto toKlartext = [](const std::string& text) {
    return converted(text, ProgramLanguage::Sinumerik).notCarriedOver;
  };
  // D0 takes the length of the tool out of every height that follows.
  EXPECT_TRUE(toKlartext(sinumerikProgram("SUPA G0 Z0 D0\nG0 X5 Y5\nD1\nG0 Z60\n")).empty());
  EXPECT_TRUE(toKlartext(sinumerikProgram("SUPA G0 Z0 D0\nG0 Z60 D1\n")).empty());
  EXPECT_TRUE(toKlartext(sinumerikProgram("SUPA G0 Z0 D0\nT1 M6\nG0 Z60\n")).empty());
  for (const char* blocks : {"SUPA G0 Z0 D0\nG0 X5 Y5\nG0 Z60\n", "D0\nG0 Z60\n", "IF R1>2\nD0\nENDIF\nG0 Z60\n"}) {
    const Diagnostics named = toKlartext(sinumerikProgram(blocks));
    ASSERT_EQ(named.size(), 1U) << blocks;
    EXPECT_THAT(named[0].message, HasSubstr("D0"));
  }
  // MEAS=2 waits for the other probe.
  EXPECT_TRUE(toKlartext(sinumerikProgram("G0 X0 Y0\nMEAS=1 G1 X5 F100\nG0 X0 Y0\n")).empty());
  const Diagnostics other = toKlartext(sinumerikProgram("G0 X0 Y0\nMEAS=2 G1 X5 F100\nG0 X0 Y0\n"));
  ASSERT_FALSE(other.empty());
  EXPECT_THAT(other[0].message, HasSubstr("MEAS=1"));
  // The whole Klartext program is in inches.
  EXPECT_TRUE(toKlartext("G17 G90 G700\nT1 M6 D1\nG54\nG0 Z4\nM30\n").empty());
  const Diagnostics late = toKlartext("G17 G90\nT1 M6 D1\nG54\nG0 Z100\nG700\nG0 Z3\nM30\n");
  ASSERT_EQ(late.size(), 1U);
  EXPECT_THAT(late[0].message, HasSubstr("INCH"));
}

TEST(ConvertPromises, NamesWordsOfPathsThatASinumerikDoesNotHave) {
  for (const char* block :
       {"L X+5 FU0.2", "L X+5 FZ0.1", "L X+5 FAUTO", "LN X+5 Y+5 NX0 NY0 NZ1", "L X+5 R+", "TOOL CALL 1 Z S(VC=120)"}) {
    const conversion::Conversion there =
        toSinumerik(klartextProgram("L X+0 Y+0 R0 F500\n" + std::string(block) + "\n"));
    EXPECT_FALSE(there.notCarriedOver.empty()) << block;
  }
  const conversion::Conversion corner =
      toSinumerik(klartextProgram("L X+0 Y+0 R0 F500\nL X+20\nRND R3 F200\nL Y+20\nCHF 2 F150\nL X+0\n"));
  EXPECT_TRUE(corner.notCarriedOver.empty());
  EXPECT_THAT(corner.text, HasSubstr("RND=3 FRC=200"));
  EXPECT_THAT(corner.text, HasSubstr("CHR=2 FRC=150"));
  const conversion::Conversion back = converted(corner.text, ProgramLanguage::Sinumerik);
  EXPECT_TRUE(back.notCarriedOver.empty());
  EXPECT_THAT(back.text, HasSubstr("RND R3 F200"));
  EXPECT_THAT(back.text, HasSubstr("CHF 2 F150"));
  // Where an axis stands: linear axes have numbers, others have not.
  for (const auto& [axis, index] : {std::pair("X", "IDX1"), std::pair("Y", "IDX2"), std::pair("Z", "IDX3")})
    EXPECT_THAT(converted(fmt::format("R2=$AA_IW[{}]\n", axis), ProgramLanguage::Sinumerik).text, HasSubstr(index));
  for (const char* axis : {"A", "B", "C"})
    EXPECT_FALSE(converted(fmt::format("R2=$AA_IW[{}]\n", axis), ProgramLanguage::Sinumerik).notCarriedOver.empty())
        << axis;
  // The angles of a tilted plane are the control's own.
  for (const char* tool : {"Q108 = 5\n", "Q114 = 5\n"})
    EXPECT_FALSE(toSinumerik(klartextProgram(tool)).notCarriedOver.empty())
        << "the tool's data are not a program's: " << tool;
  for (const char* angle : {"Q120", "Q121", "Q122"})
    EXPECT_FALSE(toSinumerik(klartextProgram(fmt::format("Q1 = {}\n", angle))).notCarriedOver.empty()) << angle;
  for (const char* result : {"Q115", "Q119", "Q123"})
    EXPECT_TRUE(toSinumerik(klartextProgram(fmt::format("Q1 = {}\n", result))).notCarriedOver.empty()) << result;
}

}  // namespace
}  // namespace probewright::testing_support
