#include <fmt/format.h>
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
            "a.h:7:3: error: this is not a block of the Klartext language\n"
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

TEST(Check, ChoicesFarBeyondAnyInteger) {
  for (const std::string number : {"333333333333333333333333", "-333333333333333333333333", "4294967297"}) {
    const std::string found =
        checked(framed("1 TCH PROBE 482 TOOL RADIUS ~\n Q340=1 ~\n Q260=+100 ~\n Q341=" + number + "\n"));
    EXPECT_NE(found.find("Q341 (individual teeth) cannot be "), std::string::npos) << number << ": " << found;
  }
}

TEST(Check, SteppingAnglesThatTheCycleWouldRefuse) {
  const auto of = [](const std::string& angle) {
    return checked(framed(
        "1 TOOL CALL 1 Z\n2 TCH PROBE 421 HOLE ~\n Q273=+50 ~\n Q274=+50 ~\n Q262=75 ~\n Q325=+0 ~\n Q247=" + angle +
        " ~\n Q261=-5 ~\n Q320=0 ~\n Q260=+20 ~\n Q301=1 ~\n Q275=75.12 ~\n Q276=74.95 ~\n"
        " Q279=0.1 ~\n Q280=0.1 ~\n Q281=1 ~\n Q309=0 ~\n Q330=0\n"));
  };
  EXPECT_NE(of("3").find("a.h:8:2: error: Q247"), std::string::npos) << of("3");
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
            "a.h:3:4: warning: this block comes after END PGM and is never reached\n    10 L X+1 FMAX\n"
            "    move it before END PGM\n");
}

/// What the run refuses when it gets there, as far as the way is plain.
TEST(Check, PredefNeedsAGlobalDefinitionBeforeIt) {
  const std::string cycle =
      "3 TCH PROBE 427 COORDINATE ~\n Q263=+0 ~\n Q264=+0 ~\n Q261=-5 ~\n Q320=PREDEF ~\n Q272=3 ~\n Q267=-1 ~\n"
      " Q260=+20 ~\n Q281=0 ~\n Q288=0 ~\n Q289=0 ~\n Q309=0 ~\n Q330=0\n";
  const std::string call = "1 TOOL CALL 1 Z\n";
  const std::string warning = "is PREDEF, but no GLOBAL DEF before it gives it a value";
  const std::string without = checked(framed(call + cycle));
  EXPECT_NE(without.find("a.h:7:2: warning: Q320"), std::string::npos) << without;
  EXPECT_NE(without.find(warning), std::string::npos) << without;
  const std::string probing = "2 GLOBAL DEF 120 PROBING ~\n Q320=+2 ~\n Q260=+50 ~\n Q301=+1\n";
  EXPECT_EQ(checked(framed(call + probing + cycle)), "");
  EXPECT_NE(checked(framed(call + cycle + probing)).find(warning), std::string::npos);
  // A subprogram or a called program may have defined it.
  EXPECT_EQ(checked(framed(call + "2 LBL 1\n" + cycle)), "");
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

/// A ~ too many, as deleting the last parameter of a cycle leaves it, hides neither this cycle nor what follows it.
TEST(Check, NamesACycleThatIsLeftOpen) {
  const std::string cycle =
      "1 TCH PROBE 417 TOP ~\n Q263=+0 ~\n Q264=+0 ~\n Q294=+0 ~\n Q320=-1 ~\n Q260=+50 ~\n Q305=+1 ~\n"
      " Q333=+0 ~\n Q303=+1 ~ \n";
  for (const std::string following :
       {"2 TCH PROBE 417 TOP ~\n Q320=-2\n", "2 L X+ZZ FMAX\n", "2 CYCL DEF 999 NONE ~\n Q1=2\n", "2 TOL CALL\n"}) {
    const std::string found = checked(framed(cycle + following));
    if (following.starts_with("2 TOL")) continue;  // not known as a block: taken for a parameter
    EXPECT_NE(found.find("a.h:10:10: error: this line ends with ~, but nothing of the block follows\n"),
              std::string::npos)
        << found;
    EXPECT_NE(found.find("a.h:6:2: error: Q320"), std::string::npos) << found;
    EXPECT_EQ(found.find("lacks Q303"), std::string::npos) << found;
    EXPECT_NE(found.find("a.h:11:"), std::string::npos) << found;
  }
  EXPECT_EQ(checked(framed("1 Q1 = 5 ~\n + 3\n2 ; a comment ~\n that goes on\n")), "");
}

TEST(Check, AsksWhetherANearlyKnownWordWasMeant) {
  const auto advice = [](const std::string& block) {
    const std::string all = checked(framed("1 " + block + "\n"));
    const std::size_t at = all.find("Did you mean ");
    return at == std::string::npos ? all : all.substr(at + 13, all.find('?', at) - at - 13);
  };
  EXPECT_EQ(advice("PLANE SPATAIL SPA+0 SPB+0 SPC+0 STAY"), "SPATIAL");
  EXPECT_EQ(advice("PLANE VEKTOR BX+1"), "VECTOR");
  EXPECT_EQ(advice("TRANS DATM AXIS X+1"), "DATUM");
  EXPECT_EQ(advice("TRANS DATUM AXSI X+1"), "AXIS");
  EXPECT_EQ(advice("FUNCTION MODE TURNN"), "TURN");
  EXPECT_EQ(advice("FUNCTION TPCM F TCP AXIS POS PATHCTRL AXIS"), "TCPM");
  EXPECT_EQ(advice("FUNCTION RESET TCPN"), "TCPM");
  EXPECT_EQ(advice("FUNCTION MDOE TURN"), "MODE");
  EXPECT_EQ(advice("FUNCTION DWEL TIME10"), "DWELL");
  EXPECT_EQ(advice("FUNCTION TCPM F TPC AXIS POS PATHCTRL AXIS"), "TCP");
  for (const char* known : {"FUNCTION DCM OFF", "FUNCTION COUNT INC", "FUNCTION RESET DWELL", "FUNCTION PARAXCOMP OFF"})
    EXPECT_EQ(advice(known), "") << known;
  EXPECT_EQ(advice("PRESET SELCT #1"), "SELECT");
  EXPECT_EQ(advice("SEL TABEL \"A.D\""), "TABLE");
  EXPECT_EQ(advice("TCH PROB 412"), "PROBE");
  EXPECT_EQ(advice("L X+1 RO FMAX"), "R0, with a zero");
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
  EXPECT_EQ(mistakes("1 LBL \"5\"\n2 CALL LBL \"5\"\n", newer), "");
  EXPECT_EQ(mistakes("1 LBL \"5\"\n2 CALL LBL 5\n", newer), "a.h:3:12: error: there is no label 5 in this program");
  EXPECT_EQ(mistakes("1 LBL 5\n2 FN 9: IF +Q1 EQU +0 GOTO LBL \"5\"\n", newer),
            "a.h:3:32: error: there is no label \"5\" in this program");
  EXPECT_EQ(mistakes("1 LBL 5\n2 LBL \"5\"\n3 CALL LBL 5\n4 CALL LBL \"5\"\n", newer), "");
  EXPECT_EQ(mistakes("1 LBL \"05\"\n2 LBL \"5\"\n3 CALL LBL \"05\" REP1\n", newer), "");
  EXPECT_EQ(mistakes("1 CYCL DEF 999 NONE ~\n Q200=1\n", newer), "a.h:2:3: error: there is no cycle 999");
  EXPECT_EQ(mistakes("1 CYCL DEF 200 DRILLING ~\n Q200=1\n", newer), "");
  EXPECT_EQ(mistakes("1 FN 15: PRINT 5\n", newer), "a.h:2:3: warning: the TNC 640 has no FN 15");
  EXPECT_EQ(mistakes("1 FN 15: PRINT 5\n", older), "");
  EXPECT_EQ(mistakes("1 FN 15: PRINT +5/Q5/-1.5/QS2\n", older), "");
  EXPECT_EQ(mistakes("1 FN 15: PRINT Q5/L\n", older),
            "a.h:2:3: warning: L is neither a number nor a Q parameter: the run stops at this block");
  EXPECT_EQ(mistakes("1 GLOBAL DEF 120 PROBING ~\n Q320=+0 ~\n Q260=+50 ~\n Q301=+1\n", newer), "");
  EXPECT_EQ(mistakes("1 GLOBAL DEF 120 PROBING ~\n Q320=+0 ~\n Q99=+4\n", newer),
            "a.h:2:3: warning: GLOBAL DEF 120 has no parameter Q99: the run stops at this block");
  EXPECT_EQ(mistakes("1 GLOBAL DEF 119 PROBING ~\n Q320=+0\n", newer),
            "a.h:2:3: warning: there is no group 119 of global definitions: the run stops at this block");
  EXPECT_EQ(mistakes("1 L X+1 R0 FMAX M98\n", newer), "a.h:2:3: warning: M98 is not carried out");
  EXPECT_EQ(mistakes("1 L X+1 R0 FMAX M120 LA5\n", older), "a.h:2:3: warning: M120 is not carried out");
  EXPECT_EQ(mistakes("1 TOOL CALL 1 Z S(VC=120)\n2 TOOL CALL S(VC=Q1)\n", newer),
            "a.h:2:3: warning: the cutting speed VC of TOOL CALL is not carried out");
  EXPECT_EQ(mistakes("1 M150\n", newer), "a.h:2:3: warning: M150 is not carried out");
  EXPECT_EQ(mistakes("1 M197\n", newer), "a.h:2:3: warning: M197 is not carried out");
  EXPECT_EQ(mistakes("1 M114\n", newer), "a.h:2:3: warning: the TNC640 does not have M114");
  EXPECT_EQ(mistakes("1 M114\n2 M101\n3 M50\n", older), "");
  const std::string twice = checked(framed("1 M98\n2 M98\n"));
  EXPECT_EQ(twice.find("M98 is not carried out"), twice.rfind("M98 is not carried out")) << twice;
  EXPECT_EQ(mistakes("1 FN 22: X\n", newer), "a.h:2:3: warning: the control has no FN 22");
  EXPECT_EQ(mistakes("1 FN 18: SYSREAD Q1 = ID503 NR1 IDX1\n", newer),
            "a.h:2:3: warning: FN 18 cannot read ID503 NR1 here: the run stops at this block");
  EXPECT_EQ(mistakes("1 FN 18: SYSREAD Q1 = ID503 NR1 IDX1\n", older), "");
  EXPECT_EQ(mistakes("1 FN 18: SYSREAD Q1 = ID210 NR5 IDX4\n", newer),
            "a.h:2:3: warning: FN 18 cannot read ID210 NR5 IDX4 here: the run stops at this block");
  EXPECT_EQ(mistakes("1 FN 17: SYSWRITE ID50 NR36 IDX5 = +3\n", newer),
            "a.h:2:3: warning: FN 17 cannot write ID50 NR36 = 3: the run stops at this block");
  EXPECT_EQ(
      mistakes("1 FN 17: SYSWRITE ID50 NR36 IDX5 = +3\n", older),
      "a.h:2:3: warning: FN 17 cannot write ID50 NR36 = 3: the run stops at this block if TOOL.T has a column TYP");
  EXPECT_EQ(mistakes("1 FN 17: SYSWRITE ID50 NR36 IDX5 = +21\n", older), "");
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
              ::testing::HasSubstr("it is in line 13, outside the cycle: end the line before it with ~"));
  // Where several lines follow, they are no block that can be read.
  const std::string several =
      checked(framed("1 TCH PROBE 403 ROT ~\n Q263=+0 ~\n Q264=+0\n Q265=+20 ~\n Q266=+0 ~\n"
                     " Q272=2 ~\n Q267=+1\n"));
  EXPECT_THAT(several, ::testing::HasSubstr("it is in line 5, outside the cycle: end the line before it with ~"));
  EXPECT_THAT(several, ::testing::HasSubstr("it is in line 7, outside the cycle: end line 4 with ~"));
}

/// A cycle 412 into row `row` with `more` behind its parameters.
std::string preset412(const std::string& row, const std::string& more) {
  return "TCH PROBE 412 PRESET ~\n Q321=+0 ~\n Q322=+0 ~\n Q262=40 ~\n Q325=+0 ~\n Q247=90 ~\n Q261=-5 ~\n Q320=0 ~\n"
         " Q260=+20 ~\n Q301=1 ~\n Q305=" +
         row + more + "\n";
}
const std::string call = "1 TOOL CALL 1 Z\n";

std::string inspection421(const std::string& largest, const std::string& smallest) {
  return "TCH PROBE 421 HOLE ~\n Q273=+50 ~\n Q274=+50 ~\n Q262=75 ~\n Q325=+0 ~\n Q247=+60 ~\n Q261=-5 ~\n Q320=0 ~\n"
         " Q260=+20 ~\n Q301=1 ~\n Q275=" +
         largest + " ~\n Q276=" + smallest + " ~\n Q279=0.1 ~\n Q280=0.1 ~\n Q281=1 ~\n Q309=0 ~\n Q330=0\n";
}

TEST(Check, KnowsARowWithoutItsTable) {
  for (const std::string& more : {std::string(), std::string(" ~\n Q303=-1")}) {
    const std::string found = checked(framed(call + preset412("5", more)));
    EXPECT_NE(found.find("error: Q303 = -1 does not say where row 5 is"), std::string::npos) << found;
    EXPECT_EQ(checked(framed(call + preset412("0", more))), "");
  }
  EXPECT_EQ(checked(framed(call + preset412("5", " ~\n Q303=1"))), "");
  EXPECT_EQ(checked(framed(call + preset412("Q5", " ~\n Q303=-1"))), "") << "the row is computed";
}

TEST(Check, KnowsLimitsThatNothingKeeps) {
  EXPECT_NE(checked(framed(call + inspection421("8.022", "8.1"))).find("warning: Q275 (8.022) is less than Q276 (8.1)"),
            std::string::npos);
  EXPECT_EQ(checked(framed(call + inspection421("0", "8.1"))), "");
  EXPECT_EQ(checked(framed(call + inspection421("Q1", "8.1"))), "");
  EXPECT_EQ(checked(framed(call + inspection421("8.1", "8.1"))), "") << "a part of exactly this size meets them";
  EXPECT_EQ(checked(framed(call + inspection421("8.1", "8.022"))), "");
}

TEST(Check, KnowsRotationsThatGoNowhere) {
  const auto edge = [](const std::string& first, const std::string& aligns, const std::string& takesOver) {
    return "TCH PROBE 1410 EDGE ~\n " + first +
           " ~\n Q1101=0 ~\n Q1102=-5 ~\n Q1103=50 ~\n Q1104=0 ~\n Q1105=-5 ~\n Q372=2 ~\n Q320=0 ~\n Q260=20 ~\n"
           " Q1125=1 ~\n Q309=0 ~\n Q1126=" +
           aligns + " ~\n Q1120=0 ~\n Q1121=" + takesOver + "\n";
  };
  EXPECT_EQ(checked(framed(call + edge("Q1100=0", "1", "1"))), "");
  EXPECT_NE(checked(framed(call + edge("Q1100=0", "1", "0"))).find("error: Q1126 aligns rotary axes"),
            std::string::npos);
  EXPECT_NE(checked(framed(call + edge("QS1100=\"0@0.1\"", "0", "0"))).find("(@) in 1 of three axes"),
            std::string::npos);
}

TEST(Check, KnowsTheStateBeforeACycle) {
  const std::string cycle = inspection421("0", "0");
  const std::string without = checked(framed(cycle));
  EXPECT_NE(without.find("warning: there is no TOOL CALL before this cycle"), std::string::npos);
  EXPECT_NE(without.find("call the touch probe first"), std::string::npos);
  const std::string tool = checked(framed("1 TCH PROBE 482 TOOL RADIUS ~\n Q340=1 ~\n Q260=+100 ~\n Q341=0\n"));
  EXPECT_NE(tool.find("call the tool to be measured first"), std::string::npos) << tool;
  EXPECT_EQ(checked(framed("1 CALL PGM TOOLS\n" + cycle)).find("TOOL CALL"), std::string::npos);
  const std::string shift = "2 CYCL DEF 7.0 SHIFT\n3 CYCL DEF 7.1 X+5\n";
  EXPECT_NE(checked(framed(call + shift + cycle)).find("cycle 7 is active"), std::string::npos);
  EXPECT_EQ(checked(framed(call + shift + cycle), control::ControlKind::iTNC530), "") << "it runs there";
  EXPECT_EQ(checked(framed(call + "2 CYCL DEF 7.0 SHIFT\n3 CYCL DEF 7.1 X+Q5\n" + cycle)), "");
  const std::string mirror = "2 CYCL DEF 8.0 MIRROR\n3 CYCL DEF 8.1 X\n", ended = "4 CYCL DEF 8.0 M\n5 CYCL DEF 8.1\n";
  EXPECT_NE(checked(framed(call + mirror + cycle)).find("cycle 8 is active"), std::string::npos);
  EXPECT_EQ(checked(framed(call + mirror + ended + cycle)), "");
  EXPECT_EQ(checked(framed(call + "2 LBL 1\n" + mirror + cycle)), "") << "the way is not known";
  const std::string turn = "2 CYCL DEF 10.0 TURN\n3 CYCL DEF 10.1 ROT+5\n";
  EXPECT_NE(checked(framed(call + turn + cycle)).find("cycle 10 is active"), std::string::npos);
  EXPECT_EQ(checked(framed(call + turn + preset412("5", " ~\n Q303=1"))), "") << "presets may be rotated";
}

/// TRANS changes what the cycles 7, 8, 10 and 11 have set: what they said no longer holds.
TEST(Check, KnowsThatTransChangesWhatCyclesHaveSet) {
  const std::string cycle = inspection421("0", "0");
  const std::string shift = "2 CYCL DEF 7.0 SHIFT\n3 CYCL DEF 7.1 X+5\n";
  const std::string mirror = "2 CYCL DEF 8.0 MIRROR\n3 CYCL DEF 8.1 X\n";
  const std::string turn = "2 CYCL DEF 10.0 TURN\n3 CYCL DEF 10.1 ROT+5\n";
  const std::string scale = "2 CYCL DEF 11.0 SCALE\n3 CYCL DEF 11.1 SCL0.5\n";
  for (const auto& [set, reset] :
       {std::pair(shift, "4 TRANS DATUM RESET\n"), std::pair(shift, "4 TRANS DATUM AXIS X+0 Y+0 Z+0\n"),
        std::pair(mirror, "4 TRANS MIRROR RESET\n"), std::pair(turn, "4 TRANS ROTATION RESET\n"),
        std::pair(scale, "4 TRANS SCALE RESET\n")}) {
    EXPECT_NE(checked(framed(call + set + cycle)).find("is active"), std::string::npos) << set;
    EXPECT_EQ(checked(framed(call + set + reset + cycle)), "") << set << reset;
  }
}

TEST(Check, KnowsTransModesAndTiltedPlanesBeforeACycle) {
  const std::string cycle = inspection421("0", "0");
  const auto warned = [&](const std::string& before, const std::string& then) {
    return checked(framed(call + before + then));
  };
  for (const auto& [before, active] : {std::pair("2 TRANS DATUM AXIS X+3\n", "TRANS DATUM is active"),
                                       std::pair("2 TRANS MIRROR AXIS X\n", "TRANS MIRROR is active"),
                                       std::pair("2 TRANS ROTATION ROT+5\n", "TRANS ROTATION is active"),
                                       std::pair("2 TRANS SCALE SCL0.5\n", "TRANS SCALE is active"),
                                       std::pair("2 FUNCTION MODE TURN\n", "FUNCTION MODE TURN is active"),
                                       std::pair("2 FUNCTION MODE GRIND\n", "FUNCTION MODE GRIND is active")})
    EXPECT_NE(warned(before, cycle).find(active), std::string::npos) << before;
  for (const char* ended : {"2 TRANS DATUM AXIS X+Q5\n", "2 TRANS DATUM AXIS X+3\n3 TRANS DATUM RESET\n",
                            "2 FUNCTION MODE TURN\n3 FUNCTION MODE MILL\n"})
    EXPECT_EQ(warned(ended, cycle).find("421 is refused"), std::string::npos) << ended;
  const std::string rotation400 =
      "TCH PROBE 400 ~\n Q263=0 ~\n Q264=0 ~\n Q265=50 ~\n Q266=0 ~\n Q272=2 ~\n Q267=1 ~\n Q261=-5 ~\n Q320=0 ~\n "
      "Q260=20 ~\n"
      " Q301=0 ~\n Q307=0 ~\n Q305=0\n";
  const std::string plane = "2 PLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY\n", reset = "3 PLANE RESET STAY\n";
  EXPECT_NE(warned(plane, rotation400).find("PLANE SPATIAL is active"), std::string::npos);
  EXPECT_NE(warned("2 CYCL DEF 19.0 PLANE\n3 CYCL DEF 19.1 A+0 B+10 C+0\n", rotation400).find("cycle 19 is active"),
            std::string::npos);
  EXPECT_EQ(warned(plane + reset, rotation400).find("is active"), std::string::npos);
  EXPECT_EQ(warned(plane, cycle).find("is active"), std::string::npos) << "421 runs in tilted planes";
}

/// Results of cycles 0, 3 and 4 go into Q parameters; another letter is not dropped.
TEST(Check, RefusesResultsInOtherParameters) {
  for (const char* name : {"QL5", "QR5", "QS5"}) {
    for (const std::string& block : {fmt::format("TCH PROBE 0.0 REF. PLANE {} Y+\nTCH PROBE 0.1 X+0 Y+0 Z-5\n", name),
                                     fmt::format("TCH PROBE 3.0 M\nTCH PROBE 3.1 {}\nTCH PROBE 3.2 X ANGLE: +0\n"
                                                 "TCH PROBE 3.3 DIST +10 F100 MB1 REFERENCE SYSTEM: 0\n",
                                                 name),
                                     fmt::format("TCH PROBE 4.0 M\nTCH PROBE 4.1 {}\nTCH PROBE 4.2 IZ-1\n"
                                                 "TCH PROBE 4.3 ABST+5 F100 MB1 REFERENCE SYSTEM:0\n",
                                                 name)}) {
      EXPECT_NE(checked(framed(call + block)).find("the result goes into a Q parameter"), std::string::npos) << block;
    }
  }
}

// The input ranges of the manuals: a feed of a cycle is a number, in some cycles also FMAX or FAUTO, in none FU or FZ.
TEST(Check, KnowsWhereFmaxMayStand) {
  const auto fast = [](const std::string& feed) {
    return framed(call + "TCH PROBE 441 FAST PROBING ~\n Q396=" + feed + " ~\n Q397=0 ~\n Q399=0 ~\n Q400=0\n");
  };
  const auto global = [](const std::string& feed) {
    return framed(call + "TCH PROBE 600 GLOBAL ~\n QS600=\"OS\" ~\n Q616=" + feed + " ~\n Q309=0 ~\n Q617=10\n");
  };
  for (const char* feed : {"FMAX", "FAUTO"}) {
    EXPECT_EQ(checked(fast(feed)), "") << feed;
    EXPECT_NE(checked(fast(feed), control::ControlKind::iTNC530).find(fmt::format("cannot be {}", feed)),
              std::string::npos);
  }
  for (const char* feed : {"FMAX", "FAUTO", "FU0.1", "FZ0.1", "\"X\""})
    EXPECT_NE(checked(global(feed)).find("its range is 0.001 to 99999.999 mm/min"), std::string::npos) << feed;
  for (const char* feed : {"FU0.1", "FZ0.1", "\"X\""})
    EXPECT_NE(checked(fast(feed)).find("its range is 0 to 99999.9999 mm/min, or FMAX, FAUTO"), std::string::npos)
        << feed;
  for (const char* feed : {"500", "Q5", "Q5*2"})
    EXPECT_EQ(checked(global(feed)) + checked(fast(feed)), "") << feed;
}

TEST(Check, KnowsTextsInTheWrongParameters) {
  for (const char* block : {"Q1 = \"A\"", "Q1 = QS2", "QL1 = QS2 || \"A\"", "QR1 = TOCHAR (DAT+5)"}) {
    EXPECT_NE(checked(framed(fmt::format("{}\n", block))).find("a Q parameter takes a number, not a text"),
              std::string::npos)
        << block;
  }
  for (const char* block : {"QS2 = 5", "QS2 = Q1 + 2", "QS2 = SIN 30"})
    EXPECT_NE(checked(framed(fmt::format("{}\n", block))).find("a QS parameter takes a text, not a number"),
              std::string::npos)
        << block;
  for (const char* block : {"QS2 = \"A\" || QS1", "QS2 = TOCHAR (DAT+Q1 DECIMALS2)", "Q1 = TONUMB (SRC_QS1)",
                            "Q1 = STRLEN (SRC_QS1)", "QS3 = SUBSTR (SRC_QS1 BEG0 LEN2)", "Q5 = QL1 * 2"})
    EXPECT_EQ(checked(framed(fmt::format("QS1 = \"AB\"\n{}\n", block))), "") << block;
}

TEST(Check, KnowsWhatTheOlderControlLacks) {
  const std::string sphere =
      "TCH PROBE 460 CALIBRATE ~\n Q407=12 ~\n Q320=0 ~\n Q301=1 ~\n Q423=8 ~\n Q380=0 ~\n"
      " Q433=0 ~\n Q434=0\n";
  EXPECT_EQ(checked(framed(call + sphere)), "");
  EXPECT_NE(checked(framed(call + sphere), control::ControlKind::iTNC530).find("Q423 takes four or three"),
            std::string::npos);
  // Tools can only be compared on the newer one; what the program computes is not known before.
  const auto tool = [](const std::string& mode) {
    return "TCH PROBE 481 TOOL LENGTH ~\n Q340=" + mode + " ~\n Q260=+100 ~\n Q341=0\n";
  };
  const std::string old =
      "TCH PROBE 31.0 LENGTH\nTCH PROBE 31.1 CHECK: 2\nTCH PROBE 31.2 HEIGHT: +120\nTCH PROBE 31.3 PROBING THE TEETH: "
      "0\n";
  for (const std::string& blocks : {tool("2"), old}) {
    EXPECT_EQ(checked(framed(call + blocks)), "");
    EXPECT_NE(checked(framed(call + blocks), control::ControlKind::iTNC530).find("it does not only compare"),
              std::string::npos)
        << blocks;
  }
  for (const char* mode : {"0", "1", "Q5"})
    EXPECT_EQ(checked(framed(call + tool(mode)), control::ControlKind::iTNC530), "");
}

TEST(Check, NumbersThatNoDoubleHolds) {
  const std::string nines(400, '9');
  EXPECT_NE(checked(framed("1 Q1 = " + nines + "\n")).find("a.h:2:8: error: this number is too large"),
            std::string::npos);
  EXPECT_NE(checked(framed("1 L X+" + nines + " F100\n")).find("a.h:2:7: error: this number is too large"),
            std::string::npos);
  EXPECT_EQ(checked(framed("1 Q1 = 0." + std::string(400, '0') + "1\n")), "");
}

}  // namespace
}  // namespace probewright::language::klartext
