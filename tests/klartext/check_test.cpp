#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "language/klartext/program.hpp"

#include "language/klartext/check.hpp"

namespace probewright::language::klartext {
namespace {

std::string checked(const std::string& text, control::ControlKind kind = control::ControlKind::TNC640) {
  KlartextProgram program("a.h", text);
  std::string all;
  for (const Diagnostic& diagnostic : checkProgram(program, kind))
    all += format(diagnostic) + "\n";
  return all;
}

std::string framed(const std::string& blocks) { return "0 BEGIN PGM A MM\n" + blocks + "9 END PGM A MM\n"; }

TEST(Check, ACleanProgramHasNothing) {
  EXPECT_EQ(checked(framed("1 LBL 1\n2 L X+1 R0 FMAX\n3 CALL LBL 1 REP2\n4 TCH PROBE 421 HOLE ~\n Q273=+50 ~\n"
                           " Q274=+50 ~\n Q262=75 ~\n Q325=+0 ~\n Q247=+60 ~\n Q261=-5 ~\n Q320=PREDEF ~\n Q260=+20 ~\n"
                           " Q301=1 ~\n Q275=75.12 ~\n Q276=74.95 ~\n Q279=0.1 ~\n Q280=0.1 ~\n Q281=1 ~\n Q309=0 ~\n"
                           " Q330=0\n")),
            "");
}

TEST(Check, EveryMistakeOfAFileIsReported) {
  EXPECT_EQ(checked(framed("1 L X+ Y+5\n2 CALL LBL \"HOLE\"\n3 ERROR = L X\n4 LBL 7\n5 LBL 7\n6 QQ\n")),
            "a.h:2:8: error: a number or a Q parameter is expected for X\n"
            "    1 L X+ Y+5\n"
            "a.h:3:13: error: there is no label HOLE in this program\n"
            "    2 CALL LBL \"HOLE\"\n"
            "    define it with LBL \"HOLE\" or correct the name\n"
            "a.h:4:3: error: the control marked this block as wrong\n"
            "    3 ERROR = L X\n"
            "    correct the block and take ERROR = away\n"
            "a.h:6:3: error: label 7 is defined twice, first in line 5\n"
            "    5 LBL 7\n"
            "    give one of the two another number or name\n"
            "a.h:7:3: error: this is no block of the Klartext language\n"
            "    6 QQ\n"
            "    begin the block with a path function (L, CC, C...), TOOL CALL, CYCL DEF, TCH PROBE, FN, Q or M; begin "
            "comments with ';'\n");
}

TEST(Check, TouchProbeCyclesThatNoControlHas) {
  EXPECT_EQ(checked(framed("1 TCH PROBE 499 NONE\n")),
            "a.h:2:3: error: there is no touch probe cycle 499\n    1 TCH PROBE 499 NONE\n"
            "    check its number; list the available cycles with: probewright cycles\n");
  EXPECT_EQ(checked(framed("1 TCH PROBE 580 OWN\n")),
            "a.h:2:3: warning: touch probe cycle 580 is not available; its parameters are not checked\n"
            "    1 TCH PROBE 580 OWN\n    list the available cycles with: probewright cycles\n");
}

TEST(Check, SteppingAnglesThatTheCycleWouldRefuse) {
  const auto of = [](const std::string& angle) {
    return checked(framed("1 TCH PROBE 421 HOLE ~\n Q273=+50 ~\n Q274=+50 ~\n Q262=75 ~\n Q325=+0 ~\n Q247=" + angle +
                          " ~\n Q261=-5 ~\n Q320=0 ~\n Q260=+20 ~\n Q301=1 ~\n Q275=75.12 ~\n Q276=74.95 ~\n"
                          " Q279=0.1 ~\n Q280=0.1 ~\n Q281=1 ~\n Q309=0 ~\n Q330=0\n"));
  };
  EXPECT_NE(of("3").find("a.h:7:2: error: Q247"), std::string::npos) << of("3");
  EXPECT_NE(of("-4.9").find("cannot be -4.9"), std::string::npos) << of("-4.9");
  EXPECT_EQ(of("5"), "");
  EXPECT_EQ(of("-5"), "");
}

TEST(Check, TheFrameInEitherCase) {
  KlartextProgram program("a.h", "begin pgm a inch\nl x+1 fmax m30\nend pgm a inch\n");
  EXPECT_TRUE(checkProgram(program, control::ControlKind::TNC640).empty());
  EXPECT_EQ(program.unit(), Unit::Inch);
}

TEST(Check, TheFrameOfAProgram) {
  EXPECT_EQ(checked("1 L X+1 FMAX\n"),
            "a.h:1:1: error: the program does not begin with BEGIN PGM\n"
            "    1 L X+1 FMAX\n"
            "    write BEGIN PGM NAME MM as its first block\n"
            "a.h:1:1: error: the program does not end with END PGM\n"
            "    1 L X+1 FMAX\n"
            "    write END PGM NAME MM as its last block\n");
  EXPECT_EQ(checked("0 BEGIN PGM A\n1 END PGM A MM\n"),
            "a.h:1:14: error: MM or INCH is expected at the end of BEGIN PGM\n    0 BEGIN PGM A\n");
  EXPECT_EQ(checked(framed("") + "10 L X+1 FMAX\n"),
            "a.h:3:4: warning: this block stands behind END PGM and is never reached\n    10 L X+1 FMAX\n"
            "    move it in front of END PGM\n");
}

TEST(Check, ParametersOfMeasuringCyclesByTheCatalogue) {
  const std::string found =
      checked(framed("1 TCH PROBE 412 INSIDE CIRCLE ~\n Q321=+50 ~\n Q999=1 ~\n Q262=-5 ~\n"
                     " Q301=7 ~\n Q303=PREDEF\n"));
  EXPECT_NE(found.find("a.h:4:2: error: cycle 412 has no parameter Q999"), std::string::npos) << found;
  EXPECT_NE(found.find("a.h:5:2: error: Q262"), std::string::npos) << found;
  EXPECT_NE(found.find("a.h:6:2: error: Q301"), std::string::npos) << found;
  EXPECT_NE(found.find("a.h:7:2: error: Q303"), std::string::npos) << found;
  EXPECT_NE(found.find("cannot be PREDEF"), std::string::npos) << found;
  EXPECT_NE(found.find("a.h:2:3: error: cycle 412 lacks Q322"), std::string::npos) << found;
  EXPECT_NE(checked(framed("1 TCH PROBE 599 X ~\n Q1=1\n")).find("warning: touch probe cycle 599"), std::string::npos);
}

TEST(Check, WhatTheControlDoesNotHave) {
  const auto mistakes = [](const std::string& blocks, control::ControlKind kind) {
    const std::string all = checked(framed(blocks), kind);
    return all.substr(0, all.find('\n'));
  };
  using control::ControlKind;
  const auto newer = ControlKind::TNC640, older = ControlKind::iTNC530;
  EXPECT_EQ(mistakes("1 LBL 1000\n", older), "a.h:2:3: error: there is no label number 1000");
  EXPECT_EQ(mistakes("1 LBL 1000\n", newer), "");
  EXPECT_EQ(mistakes("1 LBL 70000\n", newer), "a.h:2:3: error: there is no label number 70000");
  EXPECT_EQ(mistakes("1 LBL \"5\"\n", newer), "a.h:2:3: warning: the label name \"5\" is taken for the label number 5");
  EXPECT_EQ(mistakes("1 CYCL DEF 999 NONE ~\n Q200=1\n", newer), "a.h:2:3: error: there is no cycle 999");
  EXPECT_EQ(mistakes("1 CYCL DEF 200 DRILLING ~\n Q200=1\n", newer), "");
  EXPECT_EQ(mistakes("1 FN 15: PRINT 5\n", newer), "a.h:2:3: warning: the TNC 640 has no FN 15");
  EXPECT_EQ(mistakes("1 FN 15: PRINT 5\n", older), "");
  EXPECT_EQ(mistakes("1 FN 22: X\n", newer), "a.h:2:3: warning: the control has no FN 22");
  EXPECT_EQ(mistakes("1 FN 18: SYSREAD Q1 = ID503 NR1 IDX1\n", newer),
            "a.h:2:3: warning: FN 18 cannot read ID503 NR1 here: the run stops at this block");
  EXPECT_EQ(mistakes("1 FN 18: SYSREAD Q1 = ID503 NR1 IDX1\n", older), "");
  EXPECT_EQ(mistakes("1 FN 17: SYSWRITE ID210 NR1 IDX1 = +5\n", older),
            "a.h:2:3: warning: FN 17 cannot write ID210 NR1 here: the run stops at this block");
  EXPECT_EQ(mistakes("1 PLANE AXIAL B+30 TURN FMAX SEQ+\n", newer),
            "a.h:2:3: warning: SEQ has no effect in PLANE AXIAL");
  EXPECT_EQ(mistakes("1 Q1 = 2 * 1234567890\n", newer),
            "a.h:2:3: warning: the control takes no number as large as 1234567890");
  EXPECT_EQ(mistakes("1 L X+1 RL F100\n2 RND R5\n3 CYCL CALL\n", newer),
            "a.h:4:3: warning: no contour element follows the last RND");
}

TEST(Check, AMissingContinuationOfACycleIsNamed) {
  EXPECT_THAT(checked(framed("1 TCH PROBE 403 ROT ~\n Q263=+0 ~\n Q264=+0 ~\n Q265=+20 ~\n Q266=+0 ~\n Q272=2 ~\n"
                             " Q267=+1 ~\n Q261=-5 ~\n Q320=0 ~\n Q260=+20 ~\n Q301=0\n Q312=0\n")),
              ::testing::HasSubstr("it stands in line 13, outside of the cycle: end the line before it with ~"));
}

}  // namespace
}  // namespace probewright::language::klartext
