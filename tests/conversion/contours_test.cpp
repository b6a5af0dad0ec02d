#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// Corners, radius compensation, feeds, digits and tool data: both controls travel the same way in the same time, or it
/// is listed.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

PlantedPart plainTable() {
  PlantedPart part{Bench(ControlKind::TNC640, "mill5-table-table")};
  part.bench.preset(1, {10, 20, -400});
  part.bench.knows(5, "MILL", 80, 6);
  return part;
}

std::string fromSinumerik(const std::string& blocks, const std::string& definitions = {}) {
  return definitions + "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\nG1 X0 Y0 F400\n" + blocks + "M30\n";
}
std::string fromKlartext(const std::string& blocks) { return klartextProgram("L X+0 Y+0 R0 F400\n" + blocks); }

::testing::AssertionResult sameWay(const std::string& program, ProgramLanguage language) {
  const PlantedPart part = plainTable();
  const Twin original = run(program, language, part);
  const Twin there = runConverted(original, part);
  for (const auto& result : {ranWhole(original), ranWhole(there), sameEnd(original, there)})
    if (!result) return result;
  if (std::abs(original.seconds - there.seconds) < 0.05) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << original.seconds << " s and " << there.seconds << " s\n" << there.text;
}
::testing::AssertionResult goesTheSameWay(const std::string& blocks) {
  return sameWay(fromKlartext(blocks), ProgramLanguage::Klartext);
}
::testing::AssertionResult goesTheSameWayBack(const std::string& blocks, const std::string& definitions = {}) {
  return sameWay(fromSinumerik(blocks, definitions), ProgramLanguage::Sinumerik);
}

/// A rounding makes the way shorter, so one that is lost shows in the time.
TEST(ConvertCorners, StayWhereTheyAreBesideComments) {
  EXPECT_TRUE(goesTheSameWay("L X+20 F100 ; to the corner\nRND R8 F100\nL Y+20\n"));
  EXPECT_TRUE(goesTheSameWay("L X+20 F100\n; the corner\nCHF 8 F100\nL Y+20 M8\n"));
  EXPECT_THAT(toSinumerik(fromKlartext("L X+20 F100 ; to the corner\nRND R8\nL Y+20\n")).text,
              HasSubstr("G1 X20 F100 RND=8 ; to the corner\n"));
}

/// A HEIDENHAIN control rounds where the corner comes directly after its path, and once.
TEST(ConvertCorners, BelongToThePathBeforeThem) {
  for (const char* blocks : {"L X+20 F100\nQ5 = 1\nRND R8\nL Y+20\n", "L X+20 F100\nM8\nRND R8\nL Y+20\n",
                             "L X+20 F100\nRND R8\nRND R4\nL Y+20\n", "/L X+20 F100\nRND R8\nL Y+20\n"}) {
    const conversion::Conversion there = toSinumerik(fromKlartext(blocks));
    EXPECT_TRUE(lists(there, "there is no path directly before this corner")) << there.text;
  }
  for (const char* blocks : {"G1 X20\nRND=8\nY20\n", "G1 X20\nFRC=100\nY20\n"}) {
    const conversion::Conversion there = toKlartext(fromSinumerik(blocks));
    EXPECT_TRUE(lists(there, "without a path in their block")) << there.text;
    EXPECT_THAT(there.text, HasSubstr("; NOT CARRIED OVER: "));
  }
  EXPECT_TRUE(lists(toKlartext(fromSinumerik("G1 X20 FRC=100\nY20\n")), "FRC without RND or CHR"));
}

/// The corner between two feeds is travelled at the first one by a HEIDENHAIN control, at the second one by a
/// SINUMERIK; at rapid traverse beside it even with a feed of its own.
TEST(ConvertCorners, NameOtherFeeds) {
  EXPECT_TRUE(goesTheSameWay("L X+20 F100\nRND R8 F50\nL Y+20 F300\n"));
  EXPECT_TRUE(goesTheSameWay("L X+20 F100\nRND R8\nL Y+20\n"));
  EXPECT_TRUE(goesTheSameWayBack("G1 X20 F100 RND=8 FRC=50\nY20 F300\n"));
  EXPECT_TRUE(goesTheSameWayBack("G1 X20 F100 CHR=8\nY20\n"));
  EXPECT_TRUE(lists(toSinumerik(fromKlartext("L X+20 F100\nRND R8\nL Y+20 F300\n")), "at the feed of the path before"));
  EXPECT_TRUE(lists(toKlartext(fromSinumerik("G1 X20 F100 RND=8\nY20 F300\n")), "at the feed of the path after"));
  for (const char* blocks : {"L X+20 FMAX\nRND R8 F50\nL Y+20 F300\n", "L X+20 F100\nRND R8 F50\nL Y+20 FMAX\n"})
    EXPECT_TRUE(lists(toSinumerik(fromKlartext(blocks)), "paths at rapid traverse")) << blocks;
  for (const char* blocks : {"G0 X20 RND=8\nG1 Y20 F300\n", "G1 X20 F100 RND=8 FRC=50\nG0 Y20\n"})
    EXPECT_TRUE(lists(toKlartext(fromSinumerik(blocks)), "paths at rapid traverse")) << blocks;
  EXPECT_TRUE(lists(toSinumerik(fromKlartext("CR X+20 Y+0 R+10 DR+ FMAX\n")), "FMAX: a SINUMERIK travels arcs"));
}

/// RL and RR end with a tool call, a change of the coordinate system, a cycle and M91 on a HEIDENHAIN control only.
TEST(ConvertCompensation, NamesWhereItEndsOnOneControlOnly) {
  const std::string mill = "TOOL CALL 1 Z S1000\nL X+0 Y+0 R0 F400\nL X+20 RL\nL X+50\n";
  for (const char* blocks : {"TOOL CALL S200\nL X+0 R0\n", "TRANS DATUM AXIS X+3\nL X+0 R0\n",
                             "L Z-50 R0 FMAX M91\nL X+0 FMAX\n", "L Z-50 FMAX M91\nL X+0 R0\n"})
    EXPECT_TRUE(lists(toSinumerik(klartextProgram(mill + blocks)), "ends it on a HEIDENHAIN control only")) << blocks;
  for (const char* blocks : {"L R0\nL X+30\n", "L R0 FMAX\nL X+30\n", "L RR\nL X+90\nL Z+90 R0\n"})
    EXPECT_TRUE(lists(toSinumerik(klartextProgram(mill + blocks)), "a block without coordinates")) << blocks;
  EXPECT_TRUE(lists(toSinumerik(klartextProgram("TOOL CALL 1 Z S1000\nL X+0 Y+0 R0 F400\nCC X+20 Y+0\n"
                                                "C X+40 Y+0 DR- RL\nL Y-60\nL X+0 R0\n")),
                    "radius compensation begins with an arc"));
  EXPECT_TRUE(
      goesTheSameWay("TOOL CALL 1 Z S1000\nL X+20 Y+0 RL\nL X+50\nL Y+60\nL X+0 R0\nL Z-50 R0 FMAX M91\n"
                     "TOOL CALL S200\n"));
}

/// A SINUMERIK begins and ends it in the plane, in straight lines, and with a radius. In what HEIDENHAIN controls do
/// there the tool moves at once.
TEST(ConvertCompensation, NamesWhereItBeginsAndEndsOtherwise) {
  const std::string mill = "TOOL CALL 1 Z S1000\nL X+0 Y+0 R0 F400\n";
  for (const char* blocks : {"L Z+90 RL\nL X+50\nL Y+50\nL X+0 R0\n", "L X+50 RL\nL Y+50\nL Z+90 R0\nL X+0\n"})
    EXPECT_TRUE(lists(toSinumerik(klartextProgram(mill + blocks)), "without coordinates of the plane")) << blocks;
  EXPECT_TRUE(goesTheSameWay("TOOL CALL 1 Z S1000\nL X+20 Y+0 RL\nL Z+90\nL X+50\nL Y+60\nL X+0 R0\n"));
  for (const char* blocks : {"G41 Z90\nX50\nY50\nG40 X0\n", "G41 X50\nY50\nG40 Z90\nX0\n"})
    EXPECT_TRUE(lists(toKlartext(fromSinumerik(blocks)), "without coordinates of the plane")) << blocks;
  for (const char* blocks : {"G41 G2 X20 Y20 CR=20\nG1 Y50\nG40 X0\n", "G41\nG3 X20 Y20 CR=20\nG1 Y50\nG40 X0\n"})
    EXPECT_TRUE(lists(toKlartext(fromSinumerik(blocks)), "with an arc, which a SINUMERIK refuses")) << blocks;
  EXPECT_TRUE(lists(toKlartext(fromSinumerik("D0\nG41 X20\nX50\nG40 Y20\n")), "knows no radius"));
  EXPECT_TRUE(goesTheSameWayBack("G41 X20 Y5\nG2 X60 Y5 CR=30\nG1 Z90\nY60\nG40 X0\n"));
  for (const char* blocks : {"G41 X20\nX50\nG0 Y50\nG1 X20\nG40 X0\n"})
    EXPECT_TRUE(lists(toKlartext(fromSinumerik(blocks)), "at another speed")) << blocks;
  EXPECT_TRUE(lists(toSinumerik(klartextProgram(mill + "L X+20 RL\nL X+50\nL Y+50 FMAX\nL X+20\nL X+0 R0\n")),
                    "at another speed"));
}

/// What a SINUMERIK or a HEIDENHAIN control refuses alone.
TEST(ConvertCorners, NameArcsThatOneControlRefuses) {
  const char* tangent = "this arc continues a path in the plane";
  EXPECT_TRUE(lists(toSinumerik(klartextProgram("L X+0 Y+0 R0 F400\nL Z+90\nCT X+20 Y+20\n")), tangent));
  EXPECT_TRUE(lists(toSinumerik(klartextProgram("CT X+20 Y+20 F400\n")), tangent));
  EXPECT_TRUE(goesTheSameWay("L X+20\nCT X+40 Y+20\nCT X+20 Y+50\n"));
  for (const char* blocks : {"L X+20\nCHF 2\nCR X+40 Y+20 R+30 DR-\n", "CR X+40 Y+20 R+30 DR-\nCHF 2\nL X+90\n"})
    EXPECT_TRUE(lists(toSinumerik(fromKlartext(blocks)), "between straight lines only")) << blocks;
}

/// A SINUMERIK makes what does not fit smaller; what the corner before it has taken of a line is gone.
TEST(ConvertCorners, NameThoseThatAreLargerThanTheirLines) {
  const char* large = "this corner is larger than one of its two lines";
  for (const char* blocks :
       {"G1 X20 RND=21\nY50\n", "G1 X50 RND=21\nY20\n", "G1 X20 CHR=21\nY50\n", "G1 X50 RND=12\nY20 RND=9\nX0\n",
        "G1 X50 RND=21\nG91 Y20\nG90\n", "G1 X20 RND=10\nX0 Y5\n"}) {
    EXPECT_TRUE(lists(toKlartext(fromSinumerik(blocks)), large)) << blocks;
    const PlantedPart part = plainTable();
    const Twin original = runSinumerik(fromSinumerik(blocks), part);
    EXPECT_TRUE(original.finished) << original.why;
    EXPECT_FALSE(runConverted(original, part).finished) << blocks;
  }
  for (const char* blocks : {"G1 X20 RND=19\nY50\n", "G1 X50 RND=11\nY20 RND=9\nX0\n", "G1 X50 CHR=19\nY=IC(20)\n",
                             "G1 X50 RND=12\nY20\nX0 RND=9\nY0\n"})
    EXPECT_TRUE(goesTheSameWayBack(blocks)) << blocks;
}

/// On the way to a SINUMERIK, which goes on where the original program stops.
TEST(ConvertCorners, NameThoseThatStopTheOriginalProgram) {
  const PlantedPart part = plainTable();
  for (const char* blocks :
       {"L X+20\nRND R21\nL Y+50\n", "L X+50\nRND R21\nL Y+20\n", "L X+20\nCHF 21\nL Y+50\n",
        "L X+50\nRND R12\nL Y+20\nRND R9\nL X+0\n", "L X+50\nRND R21\nL IY+20\n", "L X+20\nRND R10\nL X+0 Y+5\n"}) {
    const Twin original = runKlartext(fromKlartext(blocks), part);
    EXPECT_FALSE(original.finished) << blocks;
    const conversion::Conversion there = toSinumerik(original.text);
    EXPECT_TRUE(lists(there, "larger than one of its two lines")) << there.text;
  }
  for (const char* blocks : {"L X+20\nRND R19\nL Y+50\n", "L X+50\nRND R11\nL Y+20\nRND R9\nL X+0\n",
                             "L X+50\nRND R12\nL Y+20\nL X+0\nRND R9\nL Y+0\n"})
    EXPECT_TRUE(goesTheSameWay(blocks)) << blocks;
}

/// Beside arcs, and where the running program knows sizes or ends of lines.
TEST(ConvertCorners, TellWhereTheirRoomIsNotKnown) {
  const auto told = [](const conversion::Conversion& there) {
    return std::ranges::count_if(there.notCarriedOver, [](const Diagnostic& each) {
      return each.severity == Severity::Note && each.message.find("whether this corner fits") != std::string::npos;
    });
  };
  for (const auto& [blocks, times] : {std::pair("L X+20\nRND R5\nL Y+50\n", 0),
                                      {"Q1 = 90\nL X+20\nRND RQ1\nL Y+50\n", 1},
                                      {"Q1 = 2\nL X+Q1\nCHF 5\nL Y+50\n", 1},
                                      {"L X+20\nRND R5\nL Y+Q1\n", 1},
                                      {"L X+20\nRND R5\nCR X+40 Y+30 R+25 DR-\nRND R4\nL Y-20\n", 2},
                                      {"L X+20\nRND R5\nL Y+Q1\nRND R5\nL X+80\nRND R5\nL Y+90\n", 3}})
    EXPECT_EQ(told(toSinumerik(fromKlartext(blocks))), times) << blocks;
  for (const auto& [blocks, times] : {std::pair("G1 X20 RND=5\nY50\n", 0),
                                      {"R1=90\nG1 X20 RND=R1\nY50\n", 1},
                                      {"R1=2\nG1 X=R1 CHR=5\nY50\n", 1},
                                      {"G3 X-17 Y57 CR=30 RND=2 F60\nG1 X20 Y77\n", 1}})
    EXPECT_EQ(told(toKlartext(fromSinumerik(blocks))), times) << blocks;
}

/// A rounding beside an arc touches it elsewhere than the corner was.
TEST(ConvertCorners, RoundBesideArcs) {
  EXPECT_TRUE(goesTheSameWay("L X+20 F60\nRND R5\nCR X+40 Y+30 R+25 DR-\nRND R4\nL Y-20\n"));
  EXPECT_TRUE(goesTheSameWay("CR X+40 Y+30 R+25 DR+ F60\nRND R6\nCR X+0 Y+20 R+40 DR+\nRND R3\nL Y-20\n"));
  EXPECT_TRUE(goesTheSameWayBack("G3 X-17 Y57 CR=30 RND=2 F60\nG1 X20 Y77\n"));
}

/// On the way back, too; and corners that no path follows directly.
TEST(ConvertCompensation, NamesWhatInterruptsContours) {
  for (const char* word : {"TRANS X5", "G55", "T1 M6 D1", "SUPA G0 Z-60 D0", "S300", "F250", "STOPRE", "D1"}) {
    const std::string blocks = fmt::format("G41 X20\nX50\n{}\nG1 G40 X60 Y20\n", word);
    EXPECT_TRUE(lists(toKlartext(fromSinumerik(blocks)), "radius compensation is in effect at this block")) << word;
  }
  EXPECT_TRUE(goesTheSameWayBack("G41 X20 Y5 D1\nX50\nR1=3\nM8\nY60\nG40 X60 F300\n"));
  for (const char* blocks : {"G1 X20 RND=2\nGOTOF AHEAD\nX50\nAHEAD: Y20\n", "G1 X20 CHR=2\nG41 Y20\nG40 X0\n"})
    EXPECT_TRUE(lists(toKlartext(fromSinumerik(blocks)), "the two controls round and chamfer differently")) << blocks;
  EXPECT_TRUE(lists(toKlartext(fromSinumerik("G1 X20 CHR=2\nG3 X20 Y20 CR=30\n")), "between straight lines only"));
  EXPECT_TRUE(lists(toSinumerik(fromKlartext("L X+20\nRND R2\nLBL 1\nL Y+20\n")), "is not followed by a path"));
  EXPECT_TRUE(lists(toKlartext(fromSinumerik("G41 X20\nG42 X40\nG40 Y40\n")), "the side of radius"));
  EXPECT_TRUE(lists(toSinumerik(fromKlartext("L X+20 RL\nL X+40 RR\nL Y+40 R0\n")), "the side of radius"));
}

TEST(ConvertFeeds, NamePathsWithoutANewFeedAfterM136) {
  const std::string turns = "TOOL CALL S1000\nM3\n";
  EXPECT_TRUE(goesTheSameWay(turns + "L X+20 F0.5 M136\nL X+40\nL X+0 F500 M137\nL X+10\n"));
  for (const char* blocks : {"M136\nL X+20\n", "L X+20 F0.5 M136\nL X+40 M137\n"})
    EXPECT_TRUE(lists(toSinumerik(fromKlartext(turns + blocks)), "needs a new feed")) << blocks;
}

TEST(ConvertFeeds, NamePathsWithoutANewFeedAfterG95) {
  const PlantedPart part = plainTable();
  for (const char* blocks : {"S100 M3\nG95\nG1 X20\n", "S100 M3\nG95 G1 X5 F0.2\nG94\nX20\n",
                             "S100 M3\nG95 F0.2\nG0 X5\nG1 X20\nG94\nG3 X40 Y0 CR=10\n"}) {
    const Twin original = runSinumerik(fromSinumerik(blocks), part);
    EXPECT_FALSE(original.finished) << blocks;
    EXPECT_TRUE(lists(toKlartext(original.text), "no new feed")) << blocks;
  }
  for (const char* blocks :
       {"S100 M3\nG95 G1 X5 F0.2\nX20\nG94 F500\nX5\n", "S100 M3\nF0.5 G95 G1 X5\nG94 G0 X7\nG1 X20 F300\n",
        "S100 M3\nG95\nG94\nG95\nF0.3\nG1 X9\n"})
    EXPECT_TRUE(goesTheSameWayBack(blocks)) << blocks;
}

/// As many digits as the program has: what is cut off changes whole numbers and comparisons.
TEST(ConvertFormulas, KeepAllDigits) {
  EXPECT_TRUE(goesTheSameWayBack("R1=TRUNC(2.9999999999999)\nG0 X=R1*10\n"));
  EXPECT_TRUE(goesTheSameWayBack("IF R1+3>2.9999999\nG0 X10\nENDIF\nR1=$PI\nG0 Y=R1*10\n"));
  // A SINUMERIK takes 3 and this number for equal.
  EXPECT_TRUE(lists(toKlartext(fromSinumerik("IF R1+3>2.9999999999999\nG0 X10\nENDIF\n")), "roundings decide"));
  EXPECT_TRUE(goesTheSameWay("Q1 = 3\nFN 11: IF +Q1 GT +2.9999999999999 GOTO LBL 1\nL X+10\nLBL 1\n"));
  EXPECT_TRUE(
      goesTheSameWay("Q1 = INT 2.9999999999999\nQ2 = INT (PI * 1000000000000)\nQ3 = FRAC (Q2 / 100)\n"
                     "L X+Q1 Y+Q3 FMAX\n"));
  EXPECT_THAT(toSinumerik(fromKlartext("Q1 = PI\nQ2 = 0.00000000012345\n")).text,
              HasSubstr("R1=3.141592653589793\nR2=0.00000000012345\n"));
}

/// One of the two numbers itself: a sum and a difference of both would be rounded.
TEST(ConvertFormulas, TakeTheLesserAndTheGreaterNumberAsTheyAre) {
  EXPECT_TRUE(goesTheSameWayBack("R1=MINVAL(0.1,0.3)\nIF R1==0.1\nG0 X10\nENDIF\n"));
  EXPECT_TRUE(goesTheSameWayBack("R2=0.7\nR1=MAXVAL(R2,0.1)\nIF R1==R2\nG0 X10\nENDIF\nG0 Y=MINVAL(R2,R1)*20\n"));
}

/// Tool data act with the next edge on a SINUMERIK, at once on a HEIDENHAIN control.
TEST(ConvertToolData, ActAtTheSameTime) {
  EXPECT_TRUE(goesTheSameWay("FN 17: SYSWRITE ID50 NR4 IDX1 = +1.5\nL Z+90\n"));
  EXPECT_TRUE(goesTheSameWayBack("$TC_DP12[1,1]=1.5\nD1\nG1 Z90\n"));
  EXPECT_TRUE(goesTheSameWayBack("$TC_DP12[5,1]=1.5\nG1 Z90\n"));
  for (const char* blocks : {"$TC_DP12[1,1]=1.5\nG1 Z90\n", "$TC_DP12[1,1]=1.5\nR1=$AA_IW[Z]\nD1\n"})
    EXPECT_TRUE(lists(toKlartext(fromSinumerik(blocks)), "acts with the next D or T")) << blocks;
  EXPECT_TRUE(lists(toKlartext(fromSinumerik("$P_UIFR[1,X,TR]=3\nR1=$AA_IW[X]\nG54\n")), "a preset acts at once"));
}

TEST(ConvertVariables, NameTypesAndDataWithoutATwin) {
  EXPECT_TRUE(lists(toKlartext("DEF CHAR LETTER=\"A\"\n" + fromSinumerik("R1=LETTER\n")), "of type CHAR"));
  EXPECT_TRUE(lists(toKlartext(fromSinumerik("R1=$SNS_MEA_WP_BALL_DIAM[1]\n")), "$SNS_MEA_WP_BALL_DIAM has no twin"));
  EXPECT_TRUE(lists(toSinumerik(fromKlartext("FN 18: SYSREAD Q1 = ID530 NR2 IDX1\n")), "FN18 has no twin"));
}

TEST(ConvertPlanes, NameASecondSwivelDataSet) {
  const auto swivel = [](const char* name) {
    return fmt::format("CYCLE800(0,\"{}\",0,57,0,0,0,10,0,0,0,0,0,1)\n", name);
  };
  const std::string one = swivel("TABLE") + "CYCLE800()\n" + swivel("table") + swivel("") + swivel("0");
  EXPECT_FALSE(lists(toKlartext(fromSinumerik(one)), "_TC"));
  EXPECT_TRUE(lists(toKlartext(fromSinumerik(one + swivel("HEAD"))), "more than one data set (TABLE, HEAD)"));
}

/// On a machine without rotary axes a HEIDENHAIN control takes PLANE where it turns nothing but coordinates.
TEST(ConvertPlanes, TellThatASinumerikNeedsARotaryAxis) {
  PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
  part.bench.preset(1, {10, 20, -400});
  const auto told = [](const conversion::Conversion& there) {
    return std::ranges::any_of(there.notCarriedOver, [](const Diagnostic& each) {
      return each.severity == Severity::Note && each.message.find("62181") != std::string::npos;
    });
  };
  for (const char* blocks : {"PLANE SPATIAL SPA+0 SPB+0 SPC+0 TURN FMAX\n", "PLANE SPATIAL SPA+0 SPB+0 SPC+20 STAY\n",
                             "PLANE RESET TURN FMAX\n", "PLANE RESET STAY\n"}) {
    const Twin original = runKlartext(fromKlartext(blocks), part);
    EXPECT_TRUE(original.finished) << original.why;
    const conversion::Conversion there = toSinumerik(original.text);
    EXPECT_EQ(told(there), !run(there.text, ProgramLanguage::Sinumerik, part).finished) << there.text;
  }
}

/// What is told in millimetres of a call in G710, though the program selects inches too: S_FA = 8 looks along 16 mm.
TEST(ConvertReach, IsToldInTheUnitOfTheCall) {
  const conversion::Conversion there =
      toKlartext(fromSinumerik("G0 X-10 Y50\nCYCLE978(0,,,1,0,8,8,1,1,1,\"\",,0,,0,0,,,,,1,)\nG700\n"));
  EXPECT_TRUE(lists(there, "looks for the surface along 16 mm")) << there.text;
}

/// A number and a name of the same digits are two labels.
TEST(ConvertFlow, TellsNamesOfDigitsFromNumbers) {
  EXPECT_TRUE(goesTheSameWay("LBL 1\nL IX+3\nLBL \"1\"\nL IY+5\nCALL LBL \"1\" REP 2\nCALL LBL 1 REP 1\n"));
}

}  // namespace
}  // namespace probewright::testing_support
