#include "language/sinumerik/block_words.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sinumerik/told.hpp"

/// Words and G functions that cannot stand together are refused, by the check and by the run, and never left out.
namespace probewright::language::sinumerik {
namespace {

constexpr const char* before = "G17 G90 G0 X20 Y0 Z50\nG111 X0 Y0\nF1000\n";

std::string adviceOf(const std::string& text) {
  const auto program = SinumerikProgram::fromText("test.mpf", text);
  const Diagnostics found = check(*program);
  return found.empty() ? "" : found.front().advice;
}

struct Case {
  std::string block, said, alarm;
};

TEST(SinumerikBlockWords, ThatTheBlockItselfTells) {
  const std::vector<Case> cases = {
      {"G4 F1 X9", "G4 takes no X", "12120"},
      {"G0 X5 Y3 RP=3", "X stands beside RP: the end point is polar or Cartesian, not both", "14280"},
      {"G3 X0 Y20 I-20 J0 AR=45", "X and AR determine the arc twice", "12110"},
      {"G3 X0 Y20 I-20 J0 CR=20", "I and CR determine the arc twice", "12110"},
      {"G3 X0 Y20 CR=20 AR=90", "CR and AR determine the arc twice", "12110"},
      {"G1 X5 I10", "G1 takes no I", "12110"},
      {"G0 X5 CR=10", "G0 takes no CR", "12110"},
      {"G2 X0 Y20 CR=20 ANG=30", "G2 takes no ANG", "12110"},
      {"CT X0 Y20 CR=20", "CT takes no CR", "12110"},
      {"CIP X0 Y20 I5 J5", "CIP takes no I", "12110"},
      {"TRANS I5", "TRANS takes no I", "12110"},
      {"TRANS CR=5", "TRANS takes no CR", "12110"},
      {"ROT X5 AP=3", "ROT takes no AP", "12110"},
      {"G111 X5 CR=5", "G111 takes no CR", "12110"},
      {"G110 U5", "G110 takes no U", "12110"},
      {"G1 X5 IP[X]=5", "G1 takes no IP", "12110"},
      {"CT X0 Y20 IP[X]=3", "CT takes no IP", "12110"},
      {"G111 X5 A5", "G111 takes no A", "12110"},
      {"G112 X1=5", "G112 takes no X1", "12110"},
      {"ROT B5", "ROT takes no B", "12110"},
      {"AROT X5 U3", "AROT takes no U", "12110"},
      {"ROTS C5", "ROTS takes no C", "12110"},
      {"MEAS=1 G1 X5 CR=10", "MEAS takes no CR", "12110"},
      {"G90 G91 X9", "G91 is the second G function of group 14 in this block", "12060"},
      {"G41 G42", "G42 is the second G function of group 7 in this block", "12060"},
      {"G17 G18", "G18 is the second G function of group 6 in this block", "12060"},
      {"G54 G505", "G505 is the second G function of group 8 in this block", "12060"},

      {"SUPA G53 G0 X5", "G53 is the second G function of group 9 in this block", "12060"},
      {"DIAMON DIAMOF", "DIAMOF is the second G function of group 29 in this block", "12060"},
      {"POS[X]=9 X8", "the address X appears twice in this block", ""},
      {"POS[X]=9 POS[X]=8", "the axis X appears twice in this block", "12010"},
      {"T1 T2", "the address T appears twice in this block", "12010"},
      {"S500 S600", "the address S appears twice in this block", "12010"},
      {"D1 D2", "the address D appears twice in this block", "12010"},
      {"M3 M4", "an M function of the spindle appears twice in this block", "14760"},
      {"M2=3 M2=5", "an M function of spindle 2 appears twice in this block", "14760"},
      {"DL[X]=5", "DL takes no index", ""},
      {"DL1=5", "DL1 is not declared", ""},
      {"FA=5", "FA needs the axis in brackets", ""}};
  for (const Case& each : cases) {
    const std::string text = before + each.block + "\nM30\n";
    EXPECT_EQ(mistake(text), each.said) << each.block;
    EXPECT_NE(adviceOf(text).find(each.alarm), std::string::npos) << adviceOf(text);
  }
}

/// What the blocks before theirs have chosen: the check says what it knows, the run refuses all of it.
TEST(SinumerikBlockWords, ThatTheBlocksBeforeTell) {
  const std::vector<Case> cases = {
      {"G1\nX5 AP=45 RP=20", "X stands beside AP: the end point is polar or Cartesian, not both", "14280"},
      {"G0 X5 RP=3", "X stands beside RP: the end point is polar or Cartesian, not both", "14280"},
      {"G1 X5\nY5 I3", "G1 takes no I", "12110"},
      {"G3 X0 Y20 I-20 J0\nX20 Y0 I0 J-20 AR=45", "X and AR determine the arc twice", "12110"},
      {"CT X5 Y5\nX9 Y9 AR=40", "CT takes no AR", "12110"}};
  for (const Case& each : cases) {
    World world;
    EXPECT_EQ(mistake(before + each.block + "\nM30\n"), each.said) << each.block;
    EXPECT_EQ(world.alarm(before + each.block + "\n"), each.alarm) << each.block;
  }
  // G18: X and Z are the plane, Y stands beside polar coordinates. A label that is jumped to: nobody knows.
  EXPECT_EQ(mistake(std::string(before) + "G18\nG1 Y5 AP=45 RP=20\nM30\n"), "");
  EXPECT_EQ(mistake(std::string(before) + "G1 X5\nLA1: Y5 I3\nIF R1==1 GOTOB LA1\nM30\n"), "");
  // Of two axes one lies in the plane, whichever that is; of one nobody knows.
  const auto inAnyPlane = [](const std::string& axes) {
    return mistake(before + ("LA1: G1 " + axes + " AP=45 RP=20\nIF R1==1 GOTOB LA1\nM30\n"));
  };
  EXPECT_EQ(inAnyPlane("X5 Z3"), "X stands beside AP: the end point is polar or Cartesian, not both");
  EXPECT_EQ(inAnyPlane("Y5 Z3"), "Y stands beside AP: the end point is polar or Cartesian, not both");
  EXPECT_EQ(inAnyPlane("Z3"), "");
  // A jump that only the run knows leads to a label, not to the blocks behind it.
  const auto jumped = [](const std::string& block) {
    return mistake(before + ("G1 X5\n" + block + "\nIF R1==1 GOTOB \"LA\"<<R2\nM30\n"));
  };
  EXPECT_EQ(jumped("Y5 I3"), "G1 takes no I");
  EXPECT_EQ(jumped("LA1: Y5 I3"), "");
  World world;
  EXPECT_EQ(world.alarm(std::string(before) + "DEF AXIS AXV=(X)\nAX[AXV]=5 X6\n"), "12010");
  EXPECT_EQ(world.alarm(std::string(before) + "DEF AXIS AXV=(X)\nG0 AX[AXV]=5 RP=6\n"), "14280");
}

/// What only the run knows: an axis from a variable, the motion that is in force.
TEST(SinumerikBlockWords, ThatOnlyTheRunKnows) {
  const std::string axis = "DEF AXIS AXV=(A)\n";
  for (const auto& [blocks, alarm] :
       std::vector<std::pair<std::string, std::string>>{{"G110 AX[AXV]=5", "12080"},
                                                        {"ROT AX[AXV]=5", "14020"},
                                                        {"G1 ANG=30", "14090"},
                                                        {"MEAS=1 G1 ANG=30", "14090"},
                                                        {"G1 ANG=30\nT1", "14090"},
                                                        {"G1 ANG=30\nSUPA G0 X5", "14090"},
                                                        {"G1\nSUPA X5 ANG=30", "12110"},
                                                        {"G1\nSUPA X5 CR=30", "12110"},
                                                        {"SUPA G1 X5 RND=2", "12110"},
                                                        {"G153 G2 X25 Y5 CR=5", "12110"},
                                                        {"G75 X1=0 A2=5", "12080"},
                                                        {"G75 B3=0", "12080"},
                                                        {"G75 X2=0", "12080"},
                                                        {"T1 D1\nDL=7", "17182"},
                                                        {"T1 D1\nDL=-1", "17182"},
                                                        {"T1 D1\nDL=1.5", "17182"}}) {
    World world("mill5-table-table");
    EXPECT_EQ(world.alarm(axis + before + blocks + "\n"), alarm) << blocks;
  }
  World world;
  world.run(std::string(before) + "G1 X0 Y0\nG1 ANG=45\nX20 Y0 ANG=-45\n");
  EXPECT_LT((tip(world) - Vector3(20, 0, 50)).norm(), 1e-12);
  world.run("G1 X0 Y0\nMEAS=1 G1 X10 ANG=45\n");
  EXPECT_LT((tip(world) - Vector3(10, 10, 50)).norm(), 1e-12);
  world.run("G111 X3 Y4\nG0 AP=0 RP=5\n");
  EXPECT_LT((tip(world) - Vector3(8, 4, 50)).norm(), 1e-12);
}

/// The lengths of DL add up to those of the edge, at once and until DL=0.
TEST(SinumerikBlockWords, AdditiveOffsetsActAtOnce) {
  World world;
  world.run("$TC_SCP13[1,1]=2 $TC_SCP23[1,1]=0.5\nT1 M6\nD1\nG17 G90 G0 Z0\n");
  const double without = world.machine.position()[2];
  world.run("DL=1\nG0 Z0\n");
  EXPECT_NEAR(world.machine.position()[2], without + 2, 1e-12);
  world.run("DL=2\nG0 Z0\n");
  EXPECT_NEAR(world.machine.position()[2], without + 0.5, 1e-12);
  world.run("DL=0\nG0 Z0\n");
  EXPECT_NEAR(world.machine.position()[2], without, 1e-12);
}

/// CIP and CT in a block without axes hold for the blocks after it.
TEST(SinumerikBlockWords, NamedMotionsAreModal) {
  World world;
  world.run(std::string(before) + "CIP\nX-20 Y0 I1=0 J1=20\n");
  double highest = 0;
  for (const auto& move : world.machine.moves)
    highest = std::max(highest, world.control.channel.programFromAxes(move.to).y());
  EXPECT_NEAR(highest, 20, 1e-3) << "the way goes through its intermediate point";
}

/// Messages about single words have a column.
TEST(SinumerikBlockWords, AuxiliaryFunctionsAreNamedAtTheirPlaces) {
  for (const auto& [block, column] : std::vector<std::pair<std::string, std::uint32_t>>{
           {"H=5", 1}, {"G1 H1=5", 4}, {"N10 H[1]=5", 5}, {"M=21", 1}, {"X5 M1=21", 4}}) {
    const auto program = SinumerikProgram::fromText("test.mpf", "G90\n" + block + "\nM30\n");
    const Diagnostics found = check(*program);
    ASSERT_FALSE(found.empty()) << block;
    EXPECT_EQ(found.front().place.column, column) << block;
  }
}

TEST(SinumerikBlockWords, ThatBelongTogether) {
  for (const char* blocks : {"G17 G54 G90 G94 G71 G64 G40 G450 DIAMOF CFC",
                             "G1 X5 Y5 ANG=45 RND=2 FRC=100 F500",
                             "G2 X0 Y-20 I=AC(0) J=AC(0)",
                             "G3 AR=90 I-20 J0",
                             "G3 X0 Y20 AR=90",
                             "G3 X0 Y20 Z40 CR=20 TURN=1",
                             "G33 Z40 K2",
                             "G33 Z40 K2 SF=90",
                             "G0 AP=90 RP=20 Z40",
                             "G4 S30",
                             "G4 F1",
                             "G75 FP=1 X1=0 Z1=0",
                             "G25 S100",
                             "G110 AP=30 RP=5",
                             "ROT RPL=30",
                             "CIP X0 Y20 I1=14.142 J1=14.142",
                             "G1 X5 LEAD=3 TILT=5",
                             "T1 M6 D1",
                             "S500 M3 S2=300 M2=3",
                             "M5 M9",
                             "BSPLINE X5 Y5 PW=2 PL=3",
                             "INVCW X5 Y5 I1 J2 CR=4",
                             "POS[X]=5 POS[Y]=6 G0 Z60",
                             "H1=5 H2=7 X5"})
    EXPECT_EQ(mistake(std::string("T1 D1\n") + before + blocks + "\nM30\n").find("tak"), std::string::npos)
        << blocks << ": " << mistake(std::string("T1 D1\n") + before + blocks + "\nM30\n");
}

}  // namespace
}  // namespace probewright::language::sinumerik
