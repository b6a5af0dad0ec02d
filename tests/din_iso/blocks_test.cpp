#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "din_iso/resolved.hpp"

namespace probewright::language::din_iso::testing {
namespace {

using klartext::testing::irOf;

TEST(DinIso, HeadEndCommentsAndStructure) {
  EXPECT_EQ(resolvedText("%RING G71 *\nN10 ;comment *\nN20 * - structure *\n\nN30 *\nN99999999 %RING G71 *\n"),
            "BEGIN PGM 'RING MM'\nEndProgram");
  EXPECT_EQ(DinIsoProgram("a.i", "%A G70 *\n").unit(), klartext::Unit::Inch);
  EXPECT_EQ(DinIsoProgram("a.i", "; remark\n%A G71*\n").unit(), klartext::Unit::Millimetre);
  EXPECT_EQ(resolvedText("N10 G30 G17 X+0 Y+0 Z-40 *\nN20 G31 G90 X+100 Y+80 Z+0 *"),
            "BLK FORM '0.1 Z X+0 Y+0 Z-40'\nBLK FORM '0.2 X+100 Y+80 Z+0'");
}

TEST(DinIso, SkippedBlocks) {
  DinIsoProgram program("a.i", "/N10 G00 X+5 *\nN20 / G00 X+6 *\nN30 G00 X+7 *\n");
  Block block;
  Diagnostics none;
  ASSERT_TRUE(program.parse(program.begin(), block, none));
  EXPECT_TRUE(block.skippable);
  ASSERT_TRUE(program.parse(block.next, block, none));
  EXPECT_TRUE(block.skippable);
  ASSERT_TRUE(program.parse(block.next, block, none));
  EXPECT_FALSE(block.skippable);
}

TEST(DinIso, StraightLines) {
  EXPECT_EQ(resolvedText("N10 G00 G40 G90 X+10 Y-5.5 Z+100 M3 *"), "M3 | Linear X=10 Y=-5.5 Z=100 R0 FMAX");
  EXPECT_EQ(resolvedText("N10 G01 G41 X10 F500 *"), "Linear X=10 RL F=500");
  EXPECT_EQ(resolvedText("G1 G42 X+Q1 Y-Q2 FQ3*"), "Linear X=Q1 Y=-Q2 RR F=Q3");
  EXPECT_EQ(resolvedText("G07 Z+5 F100 *"), "Linear Z=5 F=100");
  EXPECT_EQ(resolvedText("G07 G43 X+5 F100 *"), irOf("L R+ X+5 F100"));
  EXPECT_EQ(resolvedText("G00 G90 Z-1 M91 *"), "Linear Z=-1 FMAX M91");
  EXPECT_EQ(resolvedText("N5 F800 *\nN6 G40 *"), "Linear F=800\nLinear R0");
}

TEST(DinIso, PathFunctionAndAbsoluteOrIncrementalStayInForce) {
  EXPECT_EQ(resolvedText("G00 G90 X+1 *\nY+2 *\nG01 Y+3 F100 *\nG91 X+4 *\nX+5 *\nG90 X+6 *\n"),
            "Linear X=1 FMAX\nLinear Y=2 FMAX\nLinear Y=3 F=100\nLinear IX=4\nLinear IX=5\nLinear X=6");
  // Within a block, each coordinate follows the function in front of it.
  EXPECT_EQ(resolvedText("G01 G90 X+1 G91 Y+2 F100 *\nX+3 *"), "Linear X=1 IY=2 F=100\nLinear IX=3");
  EXPECT_EQ(resolvedText("G02 G90 X+1 Y+2 R+5 *\nX+3 Y+4 R+6 *"), "Arc- X=1 Y=2 R=5 DR=-1\nArc- X=3 Y=4 R=6 DR=-1");
}

TEST(DinIso, CirclesAndCorners) {
  EXPECT_EQ(resolvedText("I+25 J+30 *"), irOf("CC X+25 Y+30"));
  EXPECT_EQ(resolvedText("G91 I+25 K-30 *"), irOf("CC IX+25 IZ-30"));
  EXPECT_EQ(resolvedText("G29 *"), irOf("CC"));
  EXPECT_EQ(resolvedText("G02 X+45 Y+25 *"), irOf("C X+45 Y+25 DR-"));
  EXPECT_EQ(resolvedText("G03 X+45 Y+25 I+5 J+6 F200 *"), "SetCentre X=5 Y=6 | Arc+ X=45 Y=25 DR=1 F=200");
  EXPECT_EQ(resolvedText("G03 X+45 Y+25 R-20 *"), irOf("CR X+45 Y+25 R-20 DR+"));
  EXPECT_EQ(resolvedText("G05 X+45 Y+25 *"), irOf("C X+45 Y+25"));
  EXPECT_EQ(resolvedText("G06 X+45 Y+25 *"), irOf("CT X+45 Y+25"));
  EXPECT_EQ(resolvedText("G24 R2 F50 *"), irOf("CHF 2 F50"));
  EXPECT_EQ(resolvedText("G25 R5 *"), irOf("RND R5"));
  EXPECT_EQ(resolvedText("G26 R5 *"), irOf("RND R5"));
}

TEST(DinIso, PolarCoordinates) {
  EXPECT_EQ(resolvedText("G11 G42 R+45 H+180 F300 *"), irOf("LP PR+45 PA+180 RR F300"));
  EXPECT_EQ(resolvedText("G10 R+45 H+0 *"), irOf("LP PR+45 PA+0 FMAX"));
  EXPECT_EQ(resolvedText("G11 R+45 H+0 F9 *\nG91 H+60 *\nH+60 *"), irOf("LP PR+45 PA+0 F9\nLP IPA+60\nLP IPA+60"));
  EXPECT_EQ(resolvedText("G13 H+180 *"), irOf("CP PA+180 DR+"));
  EXPECT_EQ(resolvedText("G12 G91 H-360 Z-5 *"), irOf("CP IPA-360 IZ-5 DR-"));
  EXPECT_EQ(resolvedText("G15 H+90 *"), irOf("CP PA+90"));
  EXPECT_EQ(resolvedText("G16 R+10 H+30 *"), irOf("CTP PR+10 PA+30"));
}

TEST(DinIso, Tools) {
  EXPECT_EQ(resolvedText("T5 G17 S2500 *"), irOf("TOOL CALL 5 Z S2500"));
  EXPECT_EQ(resolvedText("N40 T5.2 G18 S2500 F350 DL+0.2 DR-1 DR2+0.05 *"),
            irOf("TOOL CALL 5.2 Y S2500 F350 DL+0.2 DR-1 DR2+0.05"));
  EXPECT_EQ(resolvedText("T\"TASTER 1\" G19 *"), irOf("TOOL CALL \"TASTER 1\" X"));
  EXPECT_EQ(resolvedText("TQS3 G17 *\nT Q4 *"), irOf("TOOL CALL QS3 Z\nTOOL CALL Q4 Z"));
  EXPECT_EQ(resolvedText("G17 *\nT5 S1000 *"), irOf("TOOL CALL 5 Z S1000"));
  EXPECT_EQ(resolvedText("S500 M3 *"), "Tool S=500 | M3");
  EXPECT_EQ(resolvedText("T1 G17 *\nG17 *\nG18 *"), irOf("TOOL CALL 1 Z") + "\nTool axis=Y");
  EXPECT_EQ(resolvedText("G99 T5 L+10 R+3 *"), irOf("TOOL DEF 5 L+10 R+3"));
  EXPECT_EQ(resolvedText("G51 T6 *"), irOf("TOOL DEF 6"));
}

TEST(DinIso, LabelsAndCalls) {
  EXPECT_EQ(resolvedText("G98 L12 *\nG98 L\"Probe\" *\nG98 L0 *"), irOf("LBL 12\nLBL \"Probe\"\nLBL 0"));
  EXPECT_EQ(resolvedText("L12 *\nL\"Probe\" *\nL12,5 *\nL\"Probe\",Q3 *\nLQS4 *"),
            irOf("CALL LBL 12\nCALL LBL \"Probe\"\nCALL LBL 12 REP5\nCALL LBL \"Probe\" REPQ3\nCALL LBL QS4"));
  EXPECT_EQ(
      resolvedText("%A G71 *\n%TNC:\\SUB\\B.I *\n%:C.I *\n%\"D E.H\" *\n%<>% *"),
      "BEGIN PGM 'A MM'\n" + irOf("CALL PGM TNC:\\SUB\\B.I\nCALL PGM C.I\nCALL PGM \"D E.H\"\nCALL SELECTED PGM"));
  EXPECT_EQ(resolvedText("%:TAB: \"ZERO.D\" *\n%:PGM: \"X.I\" *"), irOf("SEL TABLE \"ZERO.D\"\nSEL PGM \"X.I\""));
  DinIsoProgram program("a.i", "%A G71 *\nN10 G98 L5 *\nN20 G00 X+1 *\nN30 G98 L\"End\" *\n");
  EXPECT_EQ(program.findLabel("05", {}, JumpDirection::Any)->line, 2U);
  EXPECT_EQ(program.findLabel("End", {}, JumpDirection::Any)->line, 4U);
  EXPECT_FALSE(program.findLabel("6", {}, JumpDirection::Any));
}

TEST(DinIso, FormulasMayMultiply) {
  EXPECT_EQ(resolvedText("N10 Q1 = Q2 * SIN Q3 + 4 *"), irOf("Q1 = Q2 * SIN Q3 + 4"));
  EXPECT_EQ(resolvedText("N10 Q1 = Q2 * 3"), irOf("Q1 = Q2 * 3"));
  EXPECT_EQ(resolvedText("QS1 = \"A*B\" || QS2 *"), irOf("QS1 = \"A*B\" || QS2"));
}

TEST(DinIso, Functions) {
  EXPECT_EQ(resolvedText("D00 Q5 P01 +60 *"), irOf("FN 0: Q5 = +60"));
  EXPECT_EQ(resolvedText("D01 Q1 P01 -Q2 P02 -5 *"), irOf("FN 1: Q1 = -Q2 + -5"));
  EXPECT_EQ(resolvedText("D02 Q1 P01 +10 P02 +5 *"), irOf("FN 2: Q1 = +10 - +5"));
  EXPECT_EQ(resolvedText("D03 Q1 P01 +3 P02 +Q5 *"), irOf("FN 3: Q1 = +3 * +Q5"));
  EXPECT_EQ(resolvedText("D04 Q1 P01 +4 P02 +2 *"), irOf("FN 4: Q1 = +4 DIV +2"));
  EXPECT_EQ(resolvedText("D05 Q50 P01 4 *"), irOf("FN 5: Q50 = SQRT 4"));
  EXPECT_EQ(resolvedText("D06 Q20 P01 -Q5 *"), irOf("FN 6: Q20 = SIN-Q5"));
  EXPECT_EQ(resolvedText("D07 Q21 P01 -Q5 *"), irOf("FN 7: Q21 = COS-Q5"));
  EXPECT_EQ(resolvedText("D08 Q10 P01 +5 P02 +4 *"), irOf("FN 8: Q10 = +5 LEN +4"));
  EXPECT_EQ(resolvedText("D13 Q10 P01 +25 P02 -Q1 *"), irOf("FN 13: Q10 = +25 ANG -Q1"));
  EXPECT_EQ(resolvedText("D09 P01 +Q1 P02 +Q3 P03 \"UP 1\" *"), irOf("FN 9: IF +Q1 EQU +Q3 GOTO LBL \"UP 1\""));
  EXPECT_EQ(resolvedText("D09 P01 +Q1 IS UNDEFINED P03 5 *"), irOf("FN 9: IF +Q1 IS UNDEFINED GOTO LBL 5"));
  EXPECT_EQ(resolvedText("D10 P01 +10 P02 -Q5 P03 10 *"), irOf("FN 10: IF +10 NE -Q5 GOTO LBL 10"));
  EXPECT_EQ(resolvedText("D11 P01 +Q1 P02 +10 P03 QS5 *"), irOf("FN 11: IF +Q1 GT +10 GOTO LBL QS5"));
  EXPECT_EQ(resolvedText("D12 P01 +Q5 P02 +0 P03 1 *"), irOf("FN 12: IF +Q5 LT +0 GOTO LBL 1"));
  EXPECT_EQ(resolvedText("D14 P01 1000 *"), irOf("FN 14: ERROR = 1000"));
  EXPECT_EQ(resolvedText("D16 P01 F-PRINT TNC:\\A.A/TNC:\\B.TXT *"), irOf("FN 16: F-PRINT TNC:\\A.A/TNC:\\B.TXT"));
  EXPECT_EQ(resolvedText("D18 Q25 ID210 NR4 IDX3 *"), irOf("FN 18: SYSREAD Q25 = ID210 NR4 IDX3"));
  EXPECT_EQ(resolvedText("D18: SYSREAD Q25 = ID210 NR4 IDX3 *"), irOf("FN 18: SYSREAD Q25 = ID210 NR4 IDX3"));
  EXPECT_EQ(resolvedText("D26: TABOPEN TNC:\\T.TAB *"), irOf("FN 26: TABOPEN TNC:\\T.TAB"));
  EXPECT_EQ(resolvedText("D27: TABWRITE 5/\"R,D\" = Q5 *"), irOf("FN 27: TABWRITE 5/\"R,D\" = Q5"));
  EXPECT_EQ(resolvedText("D28: TABREAD Q10 = 6/\"X,Y\" *"), irOf("FN 28: TABREAD Q10 = 6/\"X,Y\""));
}

TEST(DinIso, TransformationsAndSettings) {
  EXPECT_EQ(resolvedText("G54 G90 X+25 Y-12.5 Z+100 *"), "Transform CYCL DEF 7 X=25 Y=-12.5 Z=100");
  EXPECT_EQ(resolvedText("G54 G91 X+25 *\nG54 Y+1 *\nG54 G90 X+0 *"),
            "Transform CYCL DEF 7 IX=25\nTransform CYCL DEF 7 IY=1\nTransform CYCL DEF 7 X=0");
  EXPECT_EQ(resolvedText("G53 P01 12 *"), irOf("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #12"));
  EXPECT_EQ(resolvedText("G28 X Y *\nG28 *"),
            irOf("CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X Y") + "\nTransform CYCL DEF 8");
  EXPECT_EQ(resolvedText("G73 G90 H+35 *"), irOf("CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+35"));
  EXPECT_EQ(resolvedText("G73 G91 H+35 *"), irOf("CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 IROT+35"));
  EXPECT_EQ(resolvedText("G72 F0.75 *"), irOf("CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 0.75"));
  EXPECT_EQ(resolvedText("G80 A+0 B+30 C+0 F500 S10 *"),
            irOf("CYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 A+0 B+30 C+0 F500 DIST 10"));
  EXPECT_EQ(resolvedText("G80 *"), "Transform CYCL DEF 19");
  EXPECT_EQ(resolvedText("G04 F1.5 *"), irOf("CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 1.5"));
  EXPECT_EQ(resolvedText("G36 S90 *"), irOf("CYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE 90"));
  EXPECT_EQ(resolvedText("G62 T0.05 P01 1 P02 5 *"),
            irOf("CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.05\nCYCL DEF 32.2 HSC-MODE:1 TA5"));
  EXPECT_EQ(resolvedText("G38 *\nG38 M0 *").substr(0, 4), "Stop");
  EXPECT_EQ(resolvedText("PLANE SPATIAL SPA+0 SPB+45 SPC+0 TURN FMAX *"),
            irOf("PLANE SPATIAL SPA+0 SPB+45 SPC+0 TURN FMAX"));
  EXPECT_EQ(resolvedText("FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS *"),
            irOf("FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS"));
  EXPECT_EQ(resolvedText("G247 PRESETTING Q339=+4 ;PRESET NUMBER *"), "Transform CYCL DEF 247 339=4");
}

TEST(DinIso, Cycles) {
  const std::string expected =
      irOf("TCH PROBE 421 MEASURE HOLE ~\n Q273=+50 ;CENTER ~\n Q274=-Q3 ~\n Q262=15.25 ;DIAMETER");
  EXPECT_EQ(expected, "Cycle 421 TCH PROBE 273=50 274=-Q3 262=15.25");
  // Continued by ~, by parameter lines up to the end sign, or in one line.
  EXPECT_EQ(resolvedText("N10 G421 MEASURE HOLE ~\n Q273=+50 ;CENTER ~\n Q274=-Q3 ~\n Q262=15.25 ;DIAMETER *\n"),
            expected);
  EXPECT_EQ(resolvedText("N10 G421 MEASURE HOLE\nQ273=+50 ;CENTER\nQ274=-Q3 ;CENTER\nQ262=15.25 ;DIAMETER*\n"),
            expected);
  EXPECT_EQ(resolvedText("N10 G421 Q273=+50 Q274=-Q3 Q262=15.25 *\n"), expected);
  EXPECT_EQ(resolvedText("G1410 PROBING ON EDGE ~\n QS1100= \"?\" ~\n Q1102=+0 *\n"),
            irOf("TCH PROBE 1410 PROBING ON EDGE ~\n QS1100= \"?\" ~\n Q1102=+0"));
  EXPECT_EQ(resolvedText("G200 DRILLING ~\n Q200=+2 ;SET-UP *\nG79 M3 *"), "Cycle 200 CYCL DEF 200=2\nM3 | CYCL CALL");
  EXPECT_EQ(resolvedText("N10 G00 X+5 M99 *"), "Linear X=5 FMAX | CYCL CALL");
}

TEST(DinIso, ReferencePlane) {
  const std::string expected = irOf("TCH PROBE 0.0 REF. PLANE Q5 X-\nTCH PROBE 0.1 X+5 Y+0 Z-5");
  EXPECT_EQ(resolvedText("N67 G55 P01 5 P02 X- P03 +5 P04 +0 P05 -5 *"), expected);
  EXPECT_EQ(resolvedText("G55 P01 Q5 P02 X- X+5 Y+0 Z-5 *"), expected);
}

TEST(DinIso, ACycleTakesOnlyItsOwnLines) {
  EXPECT_EQ(resolvedText("N10 G421 MEASURE HOLE ~\n Q273=+50 *\nQ274=+5 *\n"), "Cycle 421 TCH PROBE 273=50\nQ274 := 5");
}

TEST(DinIso, EmptyLinesBetweenTheParametersOfACycle) {
  const std::string once = resolvedText("N10 G404 A ~\nQ307=+0 ~\nQ305=1 *\nN20 G00 G90 X+1 *\n");
  EXPECT_EQ(resolvedText("N10 G404 A ~\r\n\r\nQ307=+0 ~\r\n\r\n\r\nQ305=1 *\r\n\r\nN20 G00 G90 X+1 *\r\n"), once);
  EXPECT_EQ(resolvedText("N10 G404 A\n\nQ307=+0\n\nQ305=1 *\nN20 G00 G90 X+1 *\n"), once);
}

TEST(DinIso, MistakesNamePlaceAndReason) {
  EXPECT_EQ(resolvedText("N10 G00 X+ *"), "1:12: a number or a Q parameter is expected for X");
  EXPECT_EQ(resolvedText("N10 G00 G01 X+5 *"), "1:9: a block has one path function only");
  EXPECT_EQ(resolvedText("N10 G20 X+5 *"), "1:5: the tool axis of G20 is not available");
  EXPECT_EQ(resolvedText("\nN10 HELLO *"), "2:6: a number or a Q parameter is expected for the angle H");
  EXPECT_EQ(resolvedText("N10 *\nN20 O1234 *"), "2:5: this is not a word of the DIN/ISO language");
  EXPECT_EQ(resolvedText("%A *\n"), "1:4: G71 (mm) or G70 (inch) is expected after the name of the program");
  EXPECT_THAT(resolvedText("%A G71 *\nN10 %\"\" *\n"),
              ::testing::HasSubstr("the name of a program is expected after %"));
  EXPECT_EQ(resolvedText("G421 Q273=+1 Q273=+2 *"), "1:14: Q273 is given twice in this cycle");
  EXPECT_EQ(resolvedText("D09 P01 +Q1 P02 +2 *"), "1:20: P03 with the label to jump to is expected here");
  EXPECT_EQ(resolvedText("G25 X+5 R3 *"), "1:12: G25 takes no X");
  EXPECT_EQ(resolvedText("G98 *"), "1:5: L with the number or name of the label is expected after G98");
  EXPECT_EQ(resolvedText("G54 G73 X+5 *"), "1:8: G54 and G73 cannot be in one block");
}

TEST(DinIso, OldMachiningCyclesKeepTheirParameters) {
  EXPECT_EQ(resolvedText("N10 G83 P01 -2 P02 -20 P03 -5 P04 0 P05 500 *"), "Cycle 1 G83 1=-2 2=-20 3=-5 4=0 5=500");
  EXPECT_EQ(resolvedText("N20 G74 P01 -2 P05 X+80 P06 Y+Q3 P07 275 *"),
            "Cycle 3 G74 1=-2 " + std::to_string(5 + 256 * 'X') + "=80 " + std::to_string(6 + 256 * 'Y') + "=Q3 7=275");
  EXPECT_EQ(resolvedText("N30 G37 P01 1 P02 2 M99 *"), "Cycle 14 G37 1=1 2=2 | CYCL CALL");
  EXPECT_EQ(resolvedText("G83 X+5 *"), "1:9: G83 takes no X");
}

TEST(DinIso, NamesOfProgramsAreWholeOrRefused) {
  EXPECT_THAT(resolvedText("%A G71 *\nN10 %:\x85\"\"\"\" *\n"),
              ::testing::HasSubstr("2:13: the quotation marks of this name do not match"));
  EXPECT_THAT(resolvedText("%A G71 *\nN10 %:TAB: *\n"), ::testing::HasSubstr("the name of a file is expected"));
  EXPECT_THAT(resolvedText("%A G71 *\nN10 G39 P01 \"MY PROGRAM.I\" *\n"), ::testing::HasSubstr("MY PROGRAM.I'"));
}

TEST(DinIso, BytesBeyondAsciiStay) {
  EXPECT_EQ(resolvedText("G98 L\"Bohrung \xFC\" *\n; \xE6\xB5\x8B\xE9\x87\x8F *\n"), "Label 'Bohrung \xFC'");
}

}  // namespace
}  // namespace probewright::language::din_iso::testing
