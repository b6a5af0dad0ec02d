#include <gtest/gtest.h>

#include "klartext/ir_text.hpp"

namespace probewright::language::klartext::testing {
namespace {

TEST(Moves, StraightLinesTakeAxesCompensationFeedAndMachineFunctions) {
  EXPECT_EQ(irOf("L X+10 Y-5.5 Z.25 R0 FMAX"), "Linear X=10 Y=-5.5 Z=0.25 R0 FMAX");
  EXPECT_EQ(irOf("12 L IX+Q5 IY-Q6 RL F200 M3"), "M3 | Linear IX=Q5 IY=-Q6 RL F=200");
  EXPECT_EQ(irOf("L  Z+100  R0  FMAX M2"), "Linear Z=100 R0 FMAX | EndProgram");
  EXPECT_EQ(irOf("L X+1 FAUTO"), "Linear X=1 FAUTO");
  EXPECT_EQ(irOf("L A+10 B-20 C+QL3 FQ7"), "Linear A=10 B=-20 C=QL3 F=Q7");
  EXPECT_EQ(irOf("L"), "Linear");
}

/// As older controls list blocks of which something was left open.
TEST(Moves, LettersWithoutAValueLeaveOpenWhatTheyName) {
  EXPECT_EQ(irOf("L X+10 R F M"), "Linear X=10");
  EXPECT_EQ(irOf("L X+10 R F MAX M"), "Linear X=10 FMAX");
  EXPECT_EQ(irOf("L X+10 R F M3"), "M3 | Linear X=10");
  EXPECT_EQ(irOf("L X+10 R0 F M ; to the hole"), "Linear X=10 R0");
  EXPECT_EQ(irOf("L X+10 R"), "Linear X=10");
  EXPECT_EQ(irOf("L X+10 R F500"), "Linear X=10 F=500");
  EXPECT_EQ(irOf("L X+10 F AUTO"), "Linear X=10 FAUTO");
}

TEST(Moves, PeopleWriteBlanksTabsAndLowerCase) {
  EXPECT_EQ(irOf("7\tL\tX + 0\tY - 2 R0 F MAX  \t"), "Linear X=0 Y=-2 R0 FMAX");
  EXPECT_EQ(irOf("l x+1 y+2 rr f max m8"), "M8 | Linear X=1 Y=2 RR FMAX");
  EXPECT_EQ(irOf("L X+5 ~\n  Y+6 ~\r\n  FMAX"), "Linear X=5 Y=6 FMAX");
  EXPECT_EQ(irOf("5 L X+1,5 ; a comma ~\nand more of the comment\n6 L Y+2"), "Linear X=1.5\nLinear Y=2");
}

TEST(Moves, PolarBlocksAndCentres) {
  EXPECT_EQ(irOf("CC X+25 IY+5"), "SetCentre X=25 IY=5");
  EXPECT_EQ(irOf("CC"), "SetCentre");
  EXPECT_EQ(irOf("LP PR+30 IPA+60 RR F300 M3"), "M3 | Linear polar PR=30 IPA=60 RR F=300");
  EXPECT_EQ(irOf("CP IPA-1800 IZ+5 DR- RL"), "Arc- polar IPA=-1800 IZ=5 DR=-1 RL");
  EXPECT_EQ(irOf("CTP PR+30 PA+120"), "ArcTangential polar PR=30 PA=120");
}

TEST(Moves, Arcs) {
  EXPECT_EQ(irOf("C X+45 Y+25 DR+"), "Arc+ X=45 Y=25 DR=1");
  EXPECT_EQ(irOf("C X+45 Y+25"), "Modal X=45 Y=25");
  EXPECT_EQ(irOf("CR X+70 Y+40 R-20 DR- R0 F150"), "Arc- X=70 Y=40 R=-20 DR=-1 R0 F=150");
  EXPECT_EQ(irOf("CR X+70 Y+40 DR-"), "1:17: an arc CR needs its radius R");
  EXPECT_EQ(irOf("CR X+70 R+ DR-"), "1:9: CR takes no R+");
  EXPECT_EQ(irOf("CT X+45 Y+20"), "ArcTangential X=45 Y=20");
}

TEST(Moves, RoundingsAndChamfers) {
  EXPECT_EQ(irOf("RND R5 F100"), "Rounding R=5 F=100");
  EXPECT_EQ(irOf("RND 2.5"), "Rounding R=2.5");
  EXPECT_EQ(irOf("RNDR+Q4"), "Rounding R=Q4");
  EXPECT_EQ(irOf("CHF 12 F250"), "Chamfer R=12 F=250");
}

TEST(Moves, ApproachAndDepart) {
  EXPECT_EQ(irOf("APPR LT X+20 Y+20 Z-10 LEN15 RR F100"), "Approach LT X=20 Y=20 Z=-10 LEN=15 RR F=100");
  EXPECT_EQ(irOf("APPR CT X+10 Y+20 CCA180 R+10 RR"), "Approach CT X=10 Y=20 CCA=180 R=10 RR");
  EXPECT_EQ(irOf("APPR PLCT PR+20 PA+30 R5 RL"), "Approach polar LCT PR=20 PA=30 R=5 RL");
  EXPECT_EQ(irOf("DEP LT LEN12.5 F100"), "Depart LT LEN=12.5 F=100");
  EXPECT_EQ(irOf("DEP LCT X+10 Y+12 R+8 R0 FMAX M30"), "Depart LCT X=10 Y=12 R=8 R0 FMAX | EndProgram");
}

TEST(Moves, SingleAxisBlocks) {
  EXPECT_EQ(irOf("Z+100 R0 FMAX"), "Linear Z=100 R0 FMAX");
  EXPECT_EQ(irOf("IX+5 F100"), "Linear IX=5 F=100");
  EXPECT_EQ(irOf("C+90 FMAX"), "Linear C=90 FMAX");
}

TEST(Moves, MachineFunctions) {
  EXPECT_EQ(irOf("L Z-1 R0 FMAX M91"), "Linear Z=-1 R0 FMAX M91");
  EXPECT_EQ(irOf("L Z-1 FMAX M92 M5"), "Linear Z=-1 FMAX M92 | M5");
  EXPECT_EQ(irOf("L M140 MB MAX FMAX"), "M140 MB | Linear FMAX");
  EXPECT_EQ(irOf("M140 MB+50 F750"), "M140 arg=750 MB=50");
  EXPECT_EQ(irOf("L X+1 F100 M128 F1000"), "M128 arg=1000 | Linear X=1 F=100");
  EXPECT_EQ(irOf("M129"), "M129");
  EXPECT_EQ(irOf("M94 C"), "M94 C");
  EXPECT_EQ(irOf("L X+0 M99"), "Linear X=0 | CYCL CALL");
  EXPECT_EQ(irOf("STOP M5"), "Stop | M5");
  EXPECT_EQ(irOf("STOP M0"), "Stop");
  EXPECT_EQ(irOf("STOP M1"), "Stop");
  EXPECT_EQ(irOf("STOP M0 M8"), "Stop | M8");
  EXPECT_EQ(irOf("M1"), "Stop optional");
}

TEST(Moves, MistakesHaveAPlace) {
  EXPECT_EQ(irOf("\n3 L X+10 Q5"), "2:10: an axis, R0/RL/RR, F or M is expected here");
  EXPECT_EQ(irOf("3 L X Y+5"), "1:7: a number or a Q parameter is expected for X");
  EXPECT_EQ(irOf("3 CC XX"), "1:7: a number or a Q parameter is expected for X");
  EXPECT_EQ(irOf("APPR LCT X+1 Y+2 RL"), "1:20: R with the radius of the arc is expected in this block");
  EXPECT_EQ(irOf("DEP LT F100"), "1:12: LEN with the length of the line is expected in this block");
  EXPECT_EQ(irOf("APPR XX"), "1:6: LT, LN, CT, LCT or one of their polar forms PLT, PLN, PCT, PLCT is expected");
}

}  // namespace
}  // namespace probewright::language::klartext::testing
