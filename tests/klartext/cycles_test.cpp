#include <gtest/gtest.h>

#include "klartext/ir_text.hpp"

namespace probewright::language::klartext::testing {
namespace {

TEST(Cycles, ParametersWithCommentsAndContinuations) {
  EXPECT_EQ(irOf("5 TCH PROBE 411 OUTSIDE RECTANGLE ~\n  Q321=+50 ;CENTRE ~\n  Q322=-Q9 ;CENTRE 2 ~\n"
                 "  Q320=PREDEF ;CLEARANCE\n6 L X+1"),
            "Cycle 411 TCH PROBE 321=50 322=-Q9 320=PREDEF(320)\nLinear X=1");
}

TEST(Cycles, NamesInAnyLanguageAndEncoding) {
  const std::string expected = "Cycle 410 TCH PROBE 321=1";
  EXPECT_EQ(irOf("1 TCH PROBE 410  ТОЧКА Q~\n Q321=+1 ;Центр"), expected);
  EXPECT_EQ(irOf("1 TCH PROBE 410  \xD2\xCE\xD7\xCA\xC0 ~\n Q321=+1 ;\xF6\xE5\xED\xF2\xF0"), expected);   // CP1251
  EXPECT_EQ(irOf("1 TCH PROBE 410 \xB0\xB2\xC8\xAB\x81\x51 ~\n Q321=+1 ;\xB8\xDF\x81\x7E\n"), expected);  // GBK
  EXPECT_EQ(irOf("1 TCH PROBE 410MEAS. ~\n Q321=+1 ;\xE5\xE4\xF6~\n"), expected);                         // CP1252
  EXPECT_EQ(irOf("1 TCH PROBE 410\n\tQ 321 = 1\t ; x"), expected);
}

TEST(Cycles, AHalfCharacterIsNoContinuation) {
  EXPECT_EQ(irOf("1 L X+1 ;\xB8\xDF\x81\x7E\n2 L X+2"), "Linear X=1\nLinear X=2");
}

TEST(Cycles, ParameterLinesWithoutContinuationSigns) {
  EXPECT_EQ(irOf("5 TCH PROBE 404 BASIC ROTATION\nQ307=+0 ;PRESET\n; remark\nQ305=1\n6 Q1 = 2"),
            "Cycle 404 TCH PROBE 307=0 305=1\nQ1 := 2");
  EXPECT_EQ(irOf("TCH PROBE 404 BASIC ROTATION\nQ307=+0\nQ1 = 2"), "Cycle 404 TCH PROBE 307=0\nQ1 := 2");
}

TEST(Cycles, EmptyLinesBetweenParameters) {
  EXPECT_EQ(irOf("5 TCH PROBE 404 BASIC ROTATION ~\r\n\r\n Q307=+0 ;PRESET ~\r\n\r\n\r\n Q305=1\r\n\r\n6 Q1 = 2\r\n"),
            "Cycle 404 TCH PROBE 307=0 305=1\nQ1 := 2");
  EXPECT_EQ(irOf("5 L X+1 ; remark ~\n\n6 Q1 = 2"), "Linear X=1\nQ1 := 2")
      << "no cycle: the empty line ends the remark";
  KlartextProgram program("a.h", "5 TCH PROBE 404 A ~\n\n Q307=+0 ~\n\n Q305=1\n6 L X+1\n");
  Block block;
  Diagnostics none;
  ASSERT_TRUE(program.parse(program.begin(), block, none));
  EXPECT_EQ(block.next.line, 6U);
}

TEST(Cycles, TextParameters) {
  EXPECT_EQ(irOf("TCH PROBE 1410 EDGE ~\n QS1100=\"?30\" ;P ~\n Q1101=+5 ~\n QS600 = OS ;X"),
            "Cycle 1410 TCH PROBE 1100='?30' 1101=5 600='OS'");
  EXPECT_EQ(irOf("TCH PROBE 421 HOLE Q330=\"MILL;1\" Q262=8"), "Cycle 421 TCH PROBE 330='MILL;1' 262=8");
}

TEST(Cycles, OldFormOfTouchProbeCycles) {
  EXPECT_EQ(irOf("67 TCH PROBE 0.0 REF. PLANE Q5 X-\n68 TCH PROBE 0.1 X+5 Y+0 Z-5"),
            "Cycle 0 TCH PROBE 10000=5 10001=0 10002=-1 10020=5 10021=0 10022=-5");
  EXPECT_EQ(irOf("67 TCH PROBE 1.0 POLAR DATUM\n68 TCH PROBE 1.1 X ВИНКЕЛЬ: +30\n69 TCH PROBE 1.2 X+5 Y+0 Z-5"),
            "Cycle 1 TCH PROBE 10001=0 10003=30 10020=5 10021=0 10022=-5");
  EXPECT_EQ(irOf("TCH PROBE 2.0 CAL\nTCH PROBE 2.1 RODZAJ: +50 R +25.003 RODZAJ POMIARU: 0"),
            "Cycle 2 TCH PROBE 10004=50 10005=25.003 10006=0");
  EXPECT_EQ(irOf("4 TCH PROBE 3.0 M\n5 TCH PROBE 3.1 Q1\n6 TCH PROBE 3.2 X ANGLE: +15\n"
                 "7 TCH PROBE 3.3 ABST +10  F100 MB1 REFERENCE SYSTEM: 0\n8 TCH PROBE 3.4 ERRORMODE1\n9 L X+1"),
            "Cycle 3 TCH PROBE 10000=1 10001=0 10003=15 10007=10 10008=100 10009=1 10010=0 10011=1\nLinear X=1");
  EXPECT_EQ(irOf("4 TCH PROBE 4.0 3D\n5 TCH PROBE 4.1 Q1\n6 TCH PROBE 4.2 IX-0.5 IY-1 IZ-1\n"
                 "7 TCH PROBE 4.3 ODLEGŁ.+45 F100 MB50 UKŁAD ODNIESIENIA:0"),
            "Cycle 4 TCH PROBE 10000=1 I10020=-0.5 I10021=-1 I10022=-1 10007=45 10008=100 10009=50 10010=0");
  EXPECT_EQ(irOf("TCH PROBE 9.0 CAL\nTCH PROBE 9.1 PKT.ODNIESIENIA +50 UKŁAD ODNIESIENIA 0"),
            "Cycle 9 TCH PROBE 10012=50 10010=0");
  EXPECT_EQ(irOf("TCH PROBE 33.0 T\nTCH PROBE 33.1 CHECK: 1 Q5\nTCH PROBE 33.2 HEIGHT: +120\nTCH PROBE 33.3 TEETH: 1"),
            "Cycle 33 TCH PROBE 10013=1 10000=5 10004=120 10014=1");
}

TEST(Cycles, CommentsBetweenThePartsOfACycle) {
  EXPECT_EQ(irOf("1 TCH PROBE 0.0 R Q5 X-\n2 ; here\n3 TCH PROBE 0.1 X+5\n4 ; there\n5 L X+1"),
            "Cycle 0 TCH PROBE 10000=5 10001=0 10002=-1 10020=5\nLinear X=1");
}

TEST(Cycles, CoordinateTransformations) {
  EXPECT_EQ(irOf("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+60\nCYCL DEF 7.2 IY+40\nCYCL DEF 7.3 Z-Q5"),
            "Transform CYCL DEF 7 X=60 IY=40 Z=-Q5");
  EXPECT_EQ(irOf("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #5"), "Transform CYCL DEF 7 #=5");
  EXPECT_EQ(irOf("CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X Y"), "Transform CYCL DEF 8 X Y");
  EXPECT_EQ(irOf("CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1"), "Transform CYCL DEF 8");
  EXPECT_EQ(irOf("CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+35"), "Transform CYCL DEF 10 ROT=35");
  EXPECT_EQ(irOf("CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 IROT-5"), "Transform CYCL DEF 10 IROT=-5");
  EXPECT_EQ(irOf("CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 0.9995"), "Transform CYCL DEF 11 SCL=0.9995");
  EXPECT_EQ(irOf("CYCL DEF 26.0 SCALING\nCYCL DEF 26.1 X 1.4 Y 0.6 CCX+15 CCY+20"),
            "Transform CYCL DEF 26 X=1.4 Y=0.6 CCX=15 CCY=20");
  EXPECT_EQ(irOf("CYCL DEF 19.0 PLANE\nCYCL DEF 19.1 A+0 B+45 C+Q3 F1000 ABST50"),
            "Transform CYCL DEF 19 A=0 B=45 C=Q3 F=1000 DIST=50");
  EXPECT_EQ(irOf("CYCL DEF 19.0 PLANE\nCYCL DEF 19.1 AQ1 B+45 CQ3 F1000"),
            "Transform CYCL DEF 19 A=Q1 B=45 C=Q3 F=1000");
  EXPECT_EQ(irOf("CYCL DEF 19.0 PLANE\nCYCL DEF 19.1 A+0 IBQ2"), irOf("CYCL DEF 19.0 PLANE\nCYCL DEF 19.1 A+0 IB+Q2"));
  EXPECT_EQ(irOf("CYCL DEF 247 DATUM SETTING ~\n Q339=+4 ;NUMBER"), "Transform CYCL DEF 247 339=4");
}

TEST(Cycles, SettingsAndMachiningCycles) {
  EXPECT_EQ(irOf("CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1\nL X+1"), "CYCL DEF 32\nLinear X=1");
  EXPECT_EQ(irOf("CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.05\nCYCL DEF 32.2 HSC-MODE:1 TA5"),
            "CYCL DEF 32 T=0.05 HSC=1 TA=5");
  EXPECT_EQ(irOf("CYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE 180"), "CYCL DEF 13 ANG=180");
  EXPECT_EQ(irOf("CYCL DEF 9.0 DWELL\nCYCL DEF 9.1 V.ZEIT1.5"), "CYCL DEF 9 T=1.5");
  EXPECT_EQ(irOf("CYCL DEF 9.0 DWELL\nCYCL DEF 9.1 DWELL .5"), "CYCL DEF 9 T=0.5");
  EXPECT_EQ(irOf("CYCL DEF 9.0 DWELL\nCYCL DEF 9.1 DWELL ,25"), "CYCL DEF 9 T=0.25");
  EXPECT_EQ(irOf("CYCL DEF 200 DRILLING ~\n Q200=2 ~\n Q201=-20 ;DEPTH ~\n Q206=FAUTO"),
            "Cycle 200 CYCL DEF 200=2 201=-20 206='FAUTO'");
  EXPECT_EQ(irOf("CYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET UP 2\nCYCL DEF 1.2 DEPTH -10\nL X+1"),
            "Cycle 1 CYCL DEF\nLinear X=1");
  EXPECT_EQ(irOf("CYCL CALL M3"), "M3 | CYCL CALL");
  EXPECT_EQ(irOf("CYCL CALL POS X+1 Y+2 FMAX"), "CYCL CALL 'POS' X=1 Y=2");
  EXPECT_EQ(irOf("GLOBAL DEF 100 GENERAL ~\n Q200=2"), "GLOBAL DEF 0=100 200=2");
}

TEST(Cycles, Mistakes) {
  EXPECT_EQ(irOf("TCH PROBE 411 X ~\n Q321=+50 ~\n Q321=+60"), "3:2: Q321 is given twice in this cycle");
  EXPECT_EQ(irOf("TCH PROBE 0.1 X+5"), "1:14: this part of a touch probe cycle stands alone");
  EXPECT_EQ(irOf("TCH PROBE 0.0 REF Q5 X-\nL X+1"), "Linear X=1\n1:24: part 0.1 of this touch probe cycle is missing");
  EXPECT_EQ(irOf("TCH PROBE 1 X ~\n Q1=2"), "1:12: touch probe cycle 1 is written in parts");
  EXPECT_EQ(irOf("CYCL DEF 7 X ~\n Q1=2"), "1:11: cycle 7 is written in parts");
  EXPECT_EQ(irOf("TCH PROBE 3.0 M\nTCH PROBE 3.1 Q1\nTCH PROBE 3.3 DIST 5 F100 MB1"),
            "3:14: the parts of a touch probe cycle must follow each other, beginning with 0");
  EXPECT_EQ(irOf("TCH PROBE ABC"), "1:11: the number of the touch probe cycle is expected after TCH PROBE");
  EXPECT_EQ(irOf("TCH PROBE 411 X ~\n Q321="),
            "2:7: a number, a parameter, a function or a parenthesis is expected in this formula");
  EXPECT_EQ(irOf("HELLO"), "1:1: this is not a block of the Klartext language");
}

}  // namespace
}  // namespace probewright::language::klartext::testing
