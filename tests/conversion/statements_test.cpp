#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// Motion, variables and flow: both controls drive to the same places.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

PlantedPart emptyTable() {
  PlantedPart part;
  part.bench.preset(1, {10, 20, -300}, 15);
  return part;
}

/// The blocks, their conversion and what becomes of it on the way back end at the same place.
::testing::AssertionResult driveTheSame(const std::string& program, ProgramLanguage language) {
  const PlantedPart part = emptyTable();
  const Twin original = run(program, language, part);
  const Twin there = runConverted(original, part);
  for (const auto& result : {ranWhole(original), ranWhole(there), sameEnd(original, there)})
    if (!result) return result;
  if (language == ProgramLanguage::Sinumerik) return ::testing::AssertionSuccess();
  const Twin back = runConverted(there, part);
  return ranWhole(back) ? sameEnd(original, back) : ranWhole(back);
}
::testing::AssertionResult drivesTheSame(const std::string& blocks) {
  return driveTheSame(klartextProgram(blocks), ProgramLanguage::Klartext);
}
::testing::AssertionResult drivesTheSameFromSinumerik(const std::string& blocks, const std::string& definitions = {}) {
  return driveTheSame(definitions + "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + blocks + "M30\n",
                      ProgramLanguage::Sinumerik);
}

TEST(ConvertMotion, DrivesLinesAndArcs) {
  EXPECT_TRUE(drivesTheSame("L X+10 Y+20 R0 FMAX\nL IX+5 Y-3 F500\nCC X+20 Y-3\nC X+20 Y+2 DR-\n"));
  EXPECT_TRUE(drivesTheSame("L X+0 Y+0 R0 FMAX\nL X+20 F500\nRND R3\nL Y+20\nCHF 2\nL X+40\nCR X+50 Y+30 R+12 DR+\n"));
  EXPECT_TRUE(drivesTheSame("CC X+10 Y+10\nLP PR+30 PA+45 R0 FMAX\nL Z+50 FMAX\n"));
  EXPECT_TRUE(drivesTheSame("L X+0 Y+0 R0 FMAX\nCC X+10 Y+0\nC X+0 Y+0 DR+ F300\nL X+1\n"));
  EXPECT_TRUE(drivesTheSame("L Z-10 R0 FMAX M91\nL X+3 Y+4 R0 FMAX\n"));
  EXPECT_TRUE(
      drivesTheSame("L X+0 Y+0 R0 FMAX\nCC X+10 Y+0\nLBL 3\nC X+20 Y+0 DR+ F300\nC X+0 Y+0 DR+\n"
                    "CALL LBL 3 REP2\nC X+10 Y+10 DR-\n"));
}

/// Which circle centre a repeated block has is known only where the whole program has one.
TEST(ConvertMotion, NamesCirclesWhoseCentreDependsOnTheWayToThem) {
  for (const char* blocks :
       {"L X+0 Y+0 R0 FMAX\nCC X+10 Y+0\nC X+20 Y+0 DR+ F300\nCC X+15 Y+0\nLBL 1\nC X+20 Y+0 DR+\nCC X+10 Y+0\n"
        "CALL LBL 1 REP 1\n",
        "L X+20 Y+0 R0 FMAX\nCC X+10 Y+0\nCC X+15\nLBL 1\nC X+20 Y+0 DR+ F300\nCC X+10 Y+0\nCALL LBL 1 REP 1\n"}) {
    const conversion::Conversion there = toSinumerik(klartextProgram(blocks));
    ASSERT_EQ(there.notCarriedOver.size(), 1U) << there.text;
    EXPECT_THAT(there.text, HasSubstr("LBL_1:\n; NOT CARRIED OVER: "));
  }
  EXPECT_TRUE(
      drivesTheSame("L X+20 Y+0 R0 FMAX\nCC X+10 Y+0\nLBL 1\nC X+20 Y+0 DR+ F300\nCC X+10 Y+0\n"
                    "CALL LBL 1 REP 1\n"));
}

/// What a condition that is lost would have steered stands there without any jump, and the rest of the program steers
/// on.
TEST(ConvertFlow, NamesAllOfAStructureWhoseConditionIsLost) {
  const conversion::Conversion back = toKlartext(
      "G17 G90 G710\nT1 M6 D1\nG54\nIF $A_IN[3]==TRUE\nG0 X1\nELSE\nG0 X2\nENDIF\nWHILE $A_IN[3]==TRUE\nG0 X3\n"
      "ENDWHILE\nIF R1==1\nG0 X4\nENDIF\nM30\n");
  EXPECT_EQ(back.notCarriedOver.size(), 5U);
  EXPECT_THAT(back.text,
              HasSubstr("3 ; NOT CARRIED OVER: IF $A_IN[3]==TRUE\n4 L X+1 R0 FMAX\n5 ; NOT CARRIED OVER: ELSE\n"
                        "6 L X+2 R0 FMAX\n7 ; NOT CARRIED OVER: ENDIF\n8 ; NOT CARRIED OVER: WHILE $A_IN[3]==TRUE\n"
                        "9 L X+3 R0 FMAX\n10 ; NOT CARRIED OVER: ENDWHILE\n11 FN 10: IF +Q1 NE +1 GOTO LBL"));
}

/// Results of measuring cycles that touch probe cycles of the other control do not tell: to define them in the program
/// would not help. All that the catalogue lists is read; CYCLE116 leaves its values in variables of the program.
TEST(ConvertResults, SaysThatAResultHasNoCounterpart) {
  std::size_t lost = 0;
  for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(control::ControlKind::Sinumerik840Dsl)) {
    if (cycle->number == 116) continue;
    for (const cycles::ResultDefinition& result : cycle->results) {
      std::string name(result.name);
      if (const std::size_t dots = name.find(".."); dots != std::string::npos) name = name.substr(0, dots) + "]";
      const auto made = toKlartext("G17 G90 G710\nT1 M6 D1\nG54\nIF " + name + "==0\nG0 X1\nENDIF\nM30\n");
      for (const Diagnostic& each : made.notCarriedOver) {
        EXPECT_THAT(each.message, Not(HasSubstr("is not defined"))) << name;
        lost += each.message.find(name + ", a result of measuring cycles") == 0 &&
                each.message.find("has no counterpart") != std::string::npos;
      }
      const bool kept = name.starts_with("_OVR[") && name.size() <= 8;
      EXPECT_TRUE(kept || !made.notCarriedOver.empty()) << name;
    }
  }
  EXPECT_GT(lost, 50U);
  // What else the control keeps for its cycles.
  for (const char* name : {"_OVI[50]", "_CHBIT[3]", "_EV[2]"}) {
    const auto made = toKlartext(std::string("G17 G90 G710\nR1=") + name + "\nM30\n");
    ASSERT_EQ(made.notCarriedOver.size(), 1U) << name;
    EXPECT_THAT(made.notCarriedOver[0].message, HasSubstr("belongs to the measuring cycles")) << name;
  }
  // A variable that nobody defines.
  const auto made = toKlartext("G17 G90 G710\nR1=OWN[3]\nM30\n");
  ASSERT_EQ(made.notCarriedOver.size(), 1U);
  EXPECT_THAT(made.notCarriedOver[0].message, HasSubstr("OWN[3] is not defined in this program"));
}

TEST(ConvertMotion, ComputesAndJumps) {
  EXPECT_TRUE(
      drivesTheSame("Q1 = 3\nQ2 = (Q1 + 2) * SQRT (16) - 2 ^ 3\nQ150 = SIN (30) * Q1\nL X+Q2 Y-Q150 R0 FMAX\n"));
  EXPECT_TRUE(drivesTheSame(
      "Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nL IX+2 R0 FMAX\nFN 12: IF +Q1 LT +4 GOTO LBL 1\nFN 9: IF +Q1 EQU +4 GOTO LBL "
      "\"OUT\"\nL X+99 FMAX\nLBL \"OUT\"\nL Y+Q1 FMAX\n"));
  EXPECT_TRUE(drivesTheSame("L X+0 Y+0 R0 FMAX\nLBL 5\nL IX+2 IY+1 FMAX\nCALL LBL 5 REP 3\n"));
  EXPECT_TRUE(
      drivesTheSame("L X+0 Y+0 R0 FMAX\nCALL LBL 7\nCALL LBL 7\nL Z+90 FMAX M30\nLBL 7\nL IX+2 IY+1 FMAX\nLBL 0\n"));
  EXPECT_TRUE(drivesTheSame("FN 13: Q5 = +3 ANG +4\nFN 8: Q6 = +3 LEN +4\nL X+Q5 Y+Q6 R0 FMAX\n"));
  EXPECT_TRUE(drivesTheSame("Q1 = INT (7.6) + FRAC (2.25) + ABS (-3)\nL X+Q1 R0 FMAX\n"));
}

TEST(ConvertMotion, ComputesWithSignsAndPowers) {
  EXPECT_TRUE(drivesTheSame("Q1 = -3\nQ2 = SGN Q1 * 7 + Q1 ^ 2\nQ3 = Q1 ^ 3 / 2\nL X+Q2 Y+Q3 R0 FMAX\n"));
  EXPECT_TRUE(drivesTheSame("Q1 = 4\nQ2 = 5 - SGN (Q1 - 4) + SGN (Q1 + 1)\nL X+Q2 Y+Q1 R0 FMAX\n"));
}

/// A SINUMERIK has squares, roots and logarithms: whole powers are products, also of numbers that have no logarithm.
TEST(ConvertMotion, WritesPowersAsProducts) {
  for (const char* base : {"3", "-2", "0.5"}) {
    EXPECT_TRUE(drivesTheSame(fmt::format(
        "Q1 = {}\nQ2 = Q1 ^ 4 + Q1 ^ -3\nQ3 = INT (Q1 ^ 5) + Q1 ^ 0 + Q1 ^ 1\nL X+Q2 Y+Q3 R0 FMAX\n", base)))
        << base;
  }
  EXPECT_TRUE(
      drivesTheSame("Q1 = 16\nQ2 = 0\nQ3 = INT (2 ^ 3 ^ 2) / 10\nQ4 = Q1 ^ 0.5 + Q2 ^ 3\nL X+Q3 Y+Q4 R0 FMAX\n"));
  const conversion::Conversion there =
      toSinumerik(klartextProgram("Q5 = 3\nQ6 = INT (2 ^ Q5)\nQ7 = INT LOG 1000\nQ8 = 2 ^ 3 ^ 2\n"));
  ASSERT_EQ(there.notCarriedOver.size(), 2U) << there.text;
  EXPECT_THAT(there.notCarriedOver[0].message, HasSubstr("this power is computed by logarithms"));
  EXPECT_THAT(there.notCarriedOver[1].message, HasSubstr("LOG is computed by natural logarithms"));
}

/// A counter to which 0.1 is added ten times is less than 1 on a HEIDENHAIN control, and equal to 1 on a SINUMERIK.
TEST(ConvertMotion, RoundsAsOftenAsTheOriginal) {
  for (const char* comparison : {"12: IF +Q1 LT +Q2", "10: IF +Q1 NE +Q2", "12: IF +Q1 LT +Q3"}) {
    for (const auto& [step, limit] :
         {std::pair("0.1", "1"), std::pair("0.7", "7"), std::pair("0.25", "2"), std::pair("1", "6")}) {
      // What never is equal ends after twenty steps.
      EXPECT_TRUE(drivesTheSame(
          fmt::format("Q1 = 0\nQ2 = {0}\nQ3 = {1} * 10\nL X+0 Y+0 R0 FMAX\nLBL 1\nQ1 = Q1 + {1}\nL IX+2 FMAX\n"
                      "Q4 = Q4 + 1\nFN 11: IF +Q4 GT +20 GOTO LBL 2\nFN {2} GOTO LBL 1\nLBL 2\n",
                      limit, step, comparison)))
          << step << comparison;
    }
  }
}

/// The other way the comparison is named, where roundings may decide it and only there.
TEST(ConvertMotion, NamesComparisonsThatRoundingsDecide) {
  const auto named = [](const std::string& blocks) {
    const conversion::Conversion there =
        toKlartext("G17 G90 G710\nDEF REAL STEP=0.1\nDEF INT COUNT\n" + blocks + "M30\n");
    return std::ranges::any_of(there.notCarriedOver, [](const Diagnostic& each) {
      return each.message.find("roundings decide this comparison") != std::string::npos;
    });
  };
  const std::string end = "\nENDWHILE\n";
  EXPECT_TRUE(named("R1=0\nWHILE R1<1\nR1=R1+0.1" + end));
  EXPECT_TRUE(named("R1=0\nWHILE R1<1\nR1=R1+STEP" + end));
  EXPECT_TRUE(named("R1=0\nREPEAT\nR1=R1+1/3\nUNTIL R1>=2\n"));
  EXPECT_TRUE(named("R3=R2\nR2=R1\nR1=R3+0.5\nIF R2==3\nR4=1\nENDIF\n"));
  EXPECT_FALSE(named("R1=0\nWHILE R1<10\nR1=R1+2" + end));
  EXPECT_FALSE(named("R1=5\nWHILE R1>0\nR1=R1-0.5" + end)) << "0 is told from every other number";
  EXPECT_FALSE(named("COUNT=0\nWHILE COUNT<10\nCOUNT=TRUNC(COUNT*1.5)+1" + end));
  EXPECT_FALSE(named("R1=0.1\nIF R1<0.3\nR2=1\nENDIF\n")) << "as it is written";
  EXPECT_FALSE(named("IF ABS(_OVR[4]-_OVR[0])>0.02\nR2=1\nENDIF\n")) << "measured";
  EXPECT_FALSE(named("R1=_OVR[4]*0.5\nIF R1>0.02\nR2=1\nENDIF\n")) << "measured";
}

/// F100 is 10 inches a minute in an INCH program; a SINUMERIK counts inches a minute under G700.
TEST(ConvertMotion, KeepsFeedsOfInchPrograms) {
  const std::string there = toSinumerik(
                                "BEGIN PGM BENCH INCH\nTOOL CALL 1 Z S100 F50\nL X+1 Y+2 R0 F100\nRND R0.1 F20\n"
                                "L X+3\nEND PGM BENCH INCH\n")
                                .text;
  EXPECT_THAT(there, HasSubstr("S100 F5\n"));
  EXPECT_THAT(there, HasSubstr("X1 Y2 F10"));
  EXPECT_THAT(there, HasSubstr("RND=0.1 FRC=2"));
  const std::string back =
      toKlartext("G17 G90 G700\nF5\nG1 X1 Y2 F10 RND=0.1 FRC=2\nX3\nR1=0.5\nG1 X4 F=R1\nM30\n").text;
  EXPECT_THAT(back, HasSubstr("F50\n"));
  EXPECT_THAT(back, HasSubstr("L X+1 Y+2 R0 F100\n"));
  EXPECT_THAT(back, HasSubstr("RND R0.1 F20\n"));
  EXPECT_THAT(back, HasSubstr("= 10 * Q1\n"));
  EXPECT_THAT(toKlartext("G17 G90 G710\nG1 X1 F10\nM30\n").text, HasSubstr("L X+1 R0 F10\n"));
}

TEST(ConvertMotion, KeepsArraysByNumber) {
  EXPECT_TRUE(drivesTheSameFromSinumerik("AA[1]=AA[0]+AA[2]\nBB[1,0]=7\nG0 X=AA[1] Y=BB[1,0]+BB[0,1]+CC[3]\n",
                                         "DEF REAL AA[3]=SET(3,,5)\nDEF INT BB[2,2]=REP(2)\nDEF REAL CC[4]\n"));
  for (const auto& [sizes, fits] : std::vector<std::pair<std::string, bool>>{{"1", true},
                                                                             {"100", true},
                                                                             {"101", false},
                                                                             {"2,2,2", true},
                                                                             {"10,10", true},
                                                                             {"10,11", false},
                                                                             {"2,500", false},
                                                                             {"II", false}}) {
    const conversion::Conversion made =
        toKlartext((sizes == "II" ? "DEF INT II=3\n" : "") + ("DEF REAL AA[" + sizes) + "]\nM30\n");
    ASSERT_EQ(made.notCarriedOver.size(), fits ? 0U : 1U) << sizes;
    if (!fits) {
      EXPECT_THAT(made.notCarriedOver[0].message, HasSubstr("array AA has more elements than there are free"));
    }
  }
  const conversion::Conversion lost = toKlartext("DEF REAL AA[3]\nDEF INT II=1\nAA[II]=5\nM30\n");
  ASSERT_EQ(lost.notCarriedOver.size(), 1U);
  EXPECT_THAT(lost.text, HasSubstr("; NOT CARRIED OVER: AA[II]=5\n"));
}

TEST(ConvertStatements, KeepsToolData) {
  // Measured by hand, added by hand: DR of tool 5, DL of the tool with a name.
  const std::string there =
      toSinumerik(klartextProgram("FN 18: SYSREAD Q1 = ID50 NR5 IDX5\nQ1 = Q1 + 0.25\nFN 17: SYSWRITE ID50 NR5 IDX5 = "
                                  "+Q1\nL X+Q1 R0 FMAX\n"))
          .text;
  EXPECT_THAT(there, HasSubstr("R1=$TC_DP15[5,1]\nR1=R1+0.25\n$TC_DP15[5,1]=R1\n"));
  PlantedPart part = emptyTable();
  part.bench.knows(5, "MILL", 80, 6);
  const Twin original = runSinumerik(
      "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n$TC_DP15[5,1]=$TC_DP15[5,1]+0.25\n$TC_DP12[GETT(\"MILL\",1),1]=-0.5\n"
      "$TC_DP15[5,1]=$TC_DP15[5,1]+$TC_DP6[5,1]\nG0 X=$TC_DP15[5,1]\nM30\n",
      part);
  const Twin twin = runConverted(original, part);
  ASSERT_TRUE(ranWhole(original));
  ASSERT_TRUE(ranWhole(twin));
  EXPECT_TRUE(sameTool(original, twin));
  EXPECT_TRUE(sameEnd(original, twin));
  EXPECT_NEAR(correctionsOfTool(twin)[1], 6.25, 1e-6);
  EXPECT_NEAR(correctionsOfTool(twin)[0], -0.5, 1e-6);
}

TEST(ConvertMotion, MovesTheOrigin) {
  EXPECT_TRUE(drivesTheSame("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y+5\nL X+1 Y+1 R0 FMAX\n"));
  EXPECT_TRUE(drivesTheSame(
      "TRANS DATUM AXIS X+10\nCYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+30\nL X+20 Y+1 R0 FMAX\nCYCL DEF 10.0 "
      "ROTATION\nCYCL DEF 10.1 ROT+0\nTRANS DATUM RESET\nL Y+7 FMAX\n"));
}

TEST(ConvertMotion, KnowsTheStructuresOfSinumerik) {
  EXPECT_TRUE(
      drivesTheSameFromSinumerik("FOR II=1 TO 4\nAA=AA+II\nENDFOR\nG0 X=AA Y=II\n", "DEF REAL AA=3\nDEF INT II\n"));
  EXPECT_TRUE(drivesTheSameFromSinumerik("R1=5\nIF (R1>3) AND NOT (R1==4)\nG0 X10\nELSE\nG0 X20\nENDIF\nG0 Y=R1\n"));
  EXPECT_TRUE(drivesTheSameFromSinumerik("R1=2\nIF (R1>=2) OR (R1<0)\nG0 X10\nENDIF\nIF R1<=1\nG0 X30\nENDIF\n"));
  EXPECT_TRUE(
      drivesTheSameFromSinumerik("R1=0\nWHILE R1<5\nR1=R1+2\nENDWHILE\nREPEAT\nR1=R1-1\nUNTIL R1<=2\nG0 X=R1\n"));
  EXPECT_TRUE(drivesTheSameFromSinumerik(
      "G0 X0 Y0\nAA1:\nG91 G0 X2\nG90\nBB1:\nG0 Z=IC(-1)\nREPEAT AA1 BB1 P=2\nREPEAT AA1 P1\n"));
  EXPECT_TRUE(
      drivesTheSameFromSinumerik("G0 X0 Y0\nG1 X10 F500\nG2 X20 Y10 I0 J10\nG3 X30 Y20 CR=10\nG1 Z50 RND=2\nX35\n"));
  EXPECT_TRUE(drivesTheSameFromSinumerik("TRANS X10\nAROT Z30\nG0 X5 Y5\nTRANS\nG0 Z=ABS(-40)\n"));
  EXPECT_TRUE(drivesTheSameFromSinumerik(
      "R1=ATAN2(3,4)\nR2=ROUND(2.6)+TRUNC(3.7)+POT(2)\nGOTOF EE1\nR2=0\nEE1:\nG0 X=R1 Y=R2\n"));
}

/// ROUND to the nearest whole number, halves away from 0: also what lies next to a half.
TEST(ConvertMotion, RoundsNextToHalves) {
  for (const char* value :
       {"0.49999999999999994", "0.5", "0.5000000000000001", "2.4999999999999996", "1.5", "0", "7", "123.5"}) {
    for (const char* sign : {"", "-"}) {
      EXPECT_TRUE(drivesTheSameFromSinumerik(fmt::format("R1={}{}\nR2=ROUND(R1)\nG0 X=R2/100+20\n", sign, value)))
          << sign << value;
    }
  }
}

/// Whole circles, with a way of the tool axis or without one, and circles that name their end.
TEST(ConvertMotion, DrivesWholeCircles) {
  for (const char* axes : {"", " Z-5"}) {
    for (const auto& [function, sense] : {std::pair("G2", "-"), std::pair("G3", "+")}) {
      const std::string text =
          toKlartext(fmt::format("G17 G90 G710\nG0 X1 Y2\n{} I10 J0{} F100\nM30\n", function, axes)).text;
      EXPECT_THAT(text, HasSubstr(fmt::format("CP IPA{}360{} DR{}", sense, axes, sense))) << text;
      EXPECT_TRUE(drivesTheSameFromSinumerik(fmt::format("G0 X1 Y2\n{} I10 J0{} F100\n", function, axes)));
      EXPECT_TRUE(drivesTheSameFromSinumerik(fmt::format("G0 X1 Y2\n{} X21 Y2 I10 J0{} F100\n", function, axes)));
      EXPECT_TRUE(drivesTheSameFromSinumerik(fmt::format("G0 X1 Y2\n{} Y12 X11 I10 J0{} F100\n", function, axes)));
    }
  }
}

/// A block before or after the repetition, again and again, and nothing of the blocks between.
TEST(ConvertMotion, RepeatsSingleBlocks) {
  for (const char* repetition : {"REPEATB AA1 P2", "REPEATB AA1 P=5", "REPEATB AA1", "REPEAT AA1 AA1 P2"}) {
    const std::string block = "AA1: G0 X=IC(2) Z=IC(-1)\n", between = "G0 Y=IC(3)\n", here = repetition;
    EXPECT_TRUE(drivesTheSameFromSinumerik("G0 X0 Y0\n" + block + between + here + "\n" + between)) << here;
    EXPECT_TRUE(drivesTheSameFromSinumerik("G0 X0 Y0\n" + here + "\n" + between + block + between)) << here;
  }
}

TEST(ConvertMotion, KeepsInches) {
  EXPECT_TRUE(
      driveTheSame("BEGIN PGM BENCH INCH\nTOOL CALL 1 Z\nL Z+4 R0 FMAX\nL X+1.5 Y-0.5 FMAX\nEND PGM BENCH INCH\n",
                   ProgramLanguage::Klartext));
}

TEST(ConvertMotion, DrawsTheBlank) {
  const std::string form = "BLK FORM 0.1 Z X-10 Y+0 Z-40\n3 BLK FORM 0.2 X+100 Y+80 Z+0\n";
  const std::string sinumerik = toSinumerik("0 BEGIN PGM BENCH MM\n2 " + form + "4 END PGM BENCH MM\n").text;
  EXPECT_THAT(sinumerik, HasSubstr("WORKPIECE(,\"\",,\"BOX\",112,0,-40,-80,-10,0,100,80)\n"));
  EXPECT_THAT(toKlartext(sinumerik).text, HasSubstr(form));
  EXPECT_THAT(toSinumerik("blk form 0.1 z x-10 y+0,5 z-40\nblk form 0.2 ix+100 iy+80 z+0\n").text,
              HasSubstr("WORKPIECE(,\"\",,\"BOX\",112,0,-40,-80,-10,0.5,90,80.5)\n"));
}

TEST(ConvertMotion, TiltsPlanes) {
  const std::string klartext =
      klartextProgram("PLANE SPATIAL SPA+0 SPB+20 SPC+15 TURN FMAX\nL X+10 Y+5 Z+60 R0 FMAX\n");
  const std::string sinumerik = toSinumerik(klartext).text;
  EXPECT_THAT(sinumerik, HasSubstr("CYCLE800(0,\"\",0,27,0,0,0,15,20,0,0,0,0,1)\n"));
  EXPECT_THAT(toKlartext(sinumerik).text, HasSubstr("PLANE SPATIAL SPA+0 SPB+20 SPC+15 TURN FMAX SEQ+\n"));
  // About X, the new Y and the new Z.
  EXPECT_THAT(toKlartext("CYCLE800(0,\"\",0,57,0,0,0,90,90,0,0,0,0,1)\nM30\n").text, HasSubstr("SPC+90"));
  EXPECT_THAT(toKlartext("CYCLE800()\nM30\n").text, HasSubstr("PLANE RESET"));
}

TEST(ConvertStatements, StructuresOfLostConditionsAreLostToTheirEnd) {
  for (const char* structure :
       {"IF _GONE>1\nG0 X1\nELSE\nG0 X2\nENDIF\n", "WHILE _GONE<4\nG0 X1\nENDWHILE\n", "REPEAT\nG0 X1\nUNTIL _GONE\n",
        "FOR _GONE=1 TO 3\nG0 X1\nENDFOR\n", "LOOP\nIF NOT _GONE\nG0 X1\nENDIF\nENDLOOP\n"}) {
    // Around and within structures that are carried over.
    const conversion::Conversion lost =
        toKlartext(std::string("IF R1>3\n") + structure + "WHILE R2<3\nR2=R2+1\nENDWHILE\nENDIF\nG0 X9\nM30\n");
    EXPECT_FALSE(lost.notCarriedOver.empty()) << structure;
    EXPECT_THAT(lost.text, HasSubstr("NOT CARRIED OVER")) << structure;
    EXPECT_THAT(lost.text, HasSubstr("LBL \"ENDWHILE")) << structure << lost.text;
    EXPECT_THAT(lost.text, HasSubstr("X+9")) << structure << lost.text;
  }
}

TEST(ConvertStatements, NamesWhatIsLost) {
  const conversion::Conversion there =
      toSinumerik(klartextProgram("APPR LT X+1 Y+1 LEN5 RL F100\nFN 16: F-PRINT A.A/B\n"));
  ASSERT_EQ(there.notCarriedOver.size(), 2U);
  EXPECT_EQ(there.notCarriedOver[0].place.line, 4U);
  EXPECT_THAT(there.text, HasSubstr("; NOT CARRIED OVER: APPR LT X+1 Y+1 LEN5 RL F100\n"));
  const conversion::Conversion back = toKlartext("G500\nG0 X1\nPOLY\n$TC_DP1[1,1]=3\n");
  EXPECT_EQ(back.notCarriedOver.size(), 3U);
  EXPECT_THAT(back.text, HasSubstr("; NOT CARRIED OVER: G500"));
}

TEST(ConvertStatements, KeepsComments) {
  const std::string there =
      toSinumerik(klartextProgram("; WHAT FOLLOWS\n* - PART ONE\nL X+1 R0 FMAX ; HERE\nSTOP\n")).text;
  EXPECT_THAT(there, HasSubstr("; WHAT FOLLOWS\n"));
  EXPECT_THAT(there, HasSubstr("G0 X1 ; HERE\nM0\n"));
  const std::string back = toKlartext(there).text;
  EXPECT_THAT(back, HasSubstr("; WHAT FOLLOWS\n"));
  EXPECT_THAT(back, HasSubstr("L X+1 R0 FMAX ; HERE\n"));
  EXPECT_THAT(back, HasSubstr("STOP\n"));
}

}  // namespace
}  // namespace probewright::testing_support
