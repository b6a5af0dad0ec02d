#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "session/check.hpp"
#include "session/source.hpp"
#include "setup/simulated_run.hpp"
#include "simulation/analytic_solids.hpp"
#include "support/heidenhain_bench.hpp"

namespace probewright::language::din_iso::testing {
namespace {

using control::ControlKind;
using session::ProgramLanguage;
using testing_support::Bench;
using testing_support::Ran;

/// A ring of 40 mm bore that truly lies at (30.25, -12.5, -300); preset 1 believes (30, -12, -300).
Bench ringWorld() {
  Bench bench;
  bench.part(simulation::Ring(20, 200, -40), translation({30.25, -12.5, -300}));
  bench.preset(1, {30, -12, -300});
  return bench;
}

Ran run(const Bench& bench, const std::string& name, const std::string& text) {
  session::RunOptions options;
  options.control = bench.control;
  return {setup::runText(name, text, bench.setup, options)};
}

/// The same ways and the same touches, to the last bit.
void expectSameRun(const Ran& a, const Ran& b) {
  EXPECT_EQ(a.why(), "");
  EXPECT_EQ(b.why(), "");
  ASSERT_EQ(a.outcome.journal.cycles.size(), b.outcome.journal.cycles.size());
  for (std::size_t i = 0; i < a.outcome.journal.cycles.size(); ++i) {
    const auto& left = a.outcome.journal.cycles[i].touches;
    const auto& right = b.outcome.journal.cycles[i].touches;
    ASSERT_EQ(left.size(), right.size()) << "cycle " << i;
    for (std::size_t k = 0; k < left.size(); ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(left[k].latched[axis], right[k].latched[axis]) << "cycle " << i << ", touch " << k;
      EXPECT_EQ(left[k].seconds, right[k].seconds) << "cycle " << i << ", touch " << k;
    }
  }
  EXPECT_EQ(a.outcome.info.totalPathLength, b.outcome.info.totalPathLength);
  EXPECT_EQ(a.outcome.files.at("PRESET.PR"), b.outcome.files.at("PRESET.PR"));
}

constexpr const char* klartextProgram =
    "0 BEGIN PGM RING MM\n1 TOOL CALL \"PROBE\" Z\n2 CYCL DEF 247 PRESET ~\n  Q339=+1\n3 L Z+50 R0 FMAX\n"
    "4 L X+0 Y+0 R0 FMAX\n5 FN 0: Q10 = +39\n6 LBL 1\n7 TCH PROBE 412 PRESET INSIDE CIRCLE ~\n  Q321=+0 ~\n"
    "  Q322=+0 ~\n  Q262=+Q10 ~\n  Q325=+0 ~\n  Q247=+90 ~\n  Q261=-10 ~\n  Q320=+0 ~\n  Q260=+20 ~\n  Q301=+0 ~\n"
    "  Q305=+1 ~\n  Q331=+0 ~\n  Q332=+0 ~\n  Q303=+1\n8 CALL LBL 1 REP1\n9 CYCL DEF 7.0 DATUM SHIFT\n"
    "10 CYCL DEF 7.1 X+2\n11 CC X-2 Y+0\n12 L X+3 Y+0 R0 FMAX\n13 CP IPA+90 DR+ F2000\n14 L IX+1 IY-1\n"
    "15 FN 9: IF +Q10 EQU +39 GOTO LBL \"PROBE\"\n16 STOP\n17 LBL \"PROBE\"\n18 TCH PROBE 0.0 REF. PLANE Q5 X+\n"
    "19 TCH PROBE 0.1 X+10 Y+0 Z-10\n20 L Z+50 R0 FMAX\n21 END PGM RING MM\n";

constexpr const char* dinIsoProgram =
    "%RING G71 *\nN10 T\"PROBE\" G17 *\nN20 G247 PRESET ~\n  Q339=+1 *\nN30 G00 G40 G90 Z+50 *\nN40 X+0 Y+0 *\n"
    "N50 D00 Q10 P01 +39 *\nN60 G98 L1 *\nN70 G412 PRESET INSIDE CIRCLE ~\n  Q321=+0 ;CENTRE ~\n  Q322=+0 ~\n"
    "  Q262=+Q10 ~\n  Q325=+0 ~\n  Q247=+90 ~\n  Q261=-10 ~\n  Q320=+0 ~\n  Q260=+20 ~\n  Q301=+0 ~\n  Q305=+1 ~\n"
    "  Q331=+0 ~\n  Q332=+0 ~\n  Q303=+1 ;TRANSFER *\nN80 L1,1 *\nN90 G54 X+2 *\nN100 I-2 J+0 *\nN110 X+3 Y+0 *\n"
    "N120 G13 G91 H+90 F2000 *\nN130 G01 X+1 Y-1 *\nN140 D09 P01 +Q10 P02 +39 P03 \"PROBE\" *\nN150 G38 *\n"
    "N160 G98 L\"PROBE\" *\nN170 G55 P01 5 P02 X+ P03 +10 P04 +0 P05 -10 *\nN180 G00 G90 Z+50 *\n"
    "N99999999 %RING G71 *\n";

TEST(DinIsoRun, TouchesWhatItsKlartextTwinTouches) {
  const Bench bench = ringWorld();
  const Ran klartext = run(bench, "RING.H", klartextProgram);
  const Ran dinIso = run(bench, "RING.I", dinIsoProgram);
  expectSameRun(klartext, dinIso);
  ASSERT_EQ(dinIso.outcome.journal.cycles.size(), 3U);
  // The ring's planted centre, and its wall as cycle 0 finds it behind the datum shift.
  EXPECT_NEAR(dinIso.cell("PRESET.PR", "1", "X"), 30.25, 1e-4);
  EXPECT_NEAR(dinIso.cell("PRESET.PR", "1", "Y"), -12.5, 1e-4);
  EXPECT_NEAR(dinIso.q(153), 40, 1e-6);
  EXPECT_NEAR(dinIso.q(5), 18, 1e-6);
  EXPECT_EQ(dinIso.outcome.info.language, "DIN/ISO");
}

TEST(DinIsoRun, ASubprogramFollowsTheModalFunctionsOfItsCaller) {
  const Bench bench = ringWorld();
  const std::string head = "%A G71 *\nT1 G17 *\nG247 Q339=+1 *\nG00 G90 Z+50 *\nX+0 Y+0 *\n";
  const std::string tail = "M30 *\nG98 L1 *\nX+5 *\nG98 L0 *\nN99999999 %A G71 *\n";
  const auto end = [&](const std::string& calls) {
    const Ran ran = run(bench, "A.I", head + calls + tail);
    EXPECT_EQ(ran.why(), "");
    return ran.machine->position()[0] - 30;
  };
  EXPECT_NEAR(end("L1 *\nL1 *\n"), 5, 1e-9);
  EXPECT_NEAR(end("G91 *\nL1 *\nL1 *\nL1 *\n"), 15, 1e-9);
  EXPECT_NEAR(end("G91 *\nL1 *\nL1 *\nG90 *\nL1 *\n"), 5, 1e-9);
}

TEST(DinIsoRun, ACallWithoutRepeatsIsASubprogram) {
  const Bench bench = ringWorld();
  const std::string head = "%A G71 *\nT1 G17 *\nG247 Q339=+1 *\nG00 G90 Z+50 *\nX+0 Y+0 *\n";
  const std::string tail = "M30 *\nG98 L1 *\nG91 X+10 *\nG90 *\nG98 L0 *\nN99999999 %A G71 *\n";
  for (const char* call : {"L1,0 *\n", "L1 *\n"}) {
    const Ran ran = run(bench, "A.I", head + call + tail);
    EXPECT_EQ(ran.why(), "") << call;
    EXPECT_NEAR(ran.machine->position()[0] - 30, 10, 1e-9) << call;
  }
}

/// G90 or G91 within a block is for the words behind it.
TEST(DinIsoRun, WordsBeforeAModeKeepTheModeBefore) {
  const Bench bench = ringWorld();
  struct Case {
    const char* block;
    Vector3 end;
    double way;  ///< behind X+20 Y+0
  };
  const double turn = 2 * std::numbers::pi * 20;
  for (const Case& each : {Case{"X+5 G91 Y+5 *\n", {5, 5, 50}, std::hypot(15, 5)},
                           Case{"I+0 J+0 G13 G91 H+450 F9000 *\n", {0, 20, 50}, 1.25 * turn},
                           Case{"I+0 J+0 G13 G91 H+720 Z+10 F9000 *\n", {20, 0, 60}, std::hypot(2 * turn, 10)},
                           Case{"I+0 J+0 G11 R+20 G91 H+90 F9000 *\n", {0, 20, 50}, std::hypot(20, 20)},
                           Case{"I+0 J+0 G03 G91 X-20 Y+20 F9000 *\n", {0, 20, 50}, turn / 4}}) {
    const Ran ran = run(bench, "A.I",
                        std::string("%A G71 *\nT1 G17 *\nG247 Q339=+1 *\nG00 G90 Z+50 *\nX+20 Y+0 *\n") + each.block +
                            "N99999999 %A G71 *\n");
    EXPECT_EQ(ran.why(), "") << each.block;
    const auto at = ran.machine->position();
    EXPECT_NEAR(at[0] - 30, each.end.x(), 1e-9) << each.block;
    EXPECT_NEAR(at[1] + 12, each.end.y(), 1e-9) << each.block;
    const Ran before =
        run(bench, "A.I", "%A G71 *\nT1 G17 *\nG247 Q339=+1 *\nG00 G90 Z+50 *\nX+20 Y+0 *\nN99999999 %A G71 *\n");
    EXPECT_NEAR(ran.outcome.info.totalPathLength - before.outcome.info.totalPathLength, each.way, 0.02) << each.block;
  }
}

TEST(DinIsoRun, InchProgramsAreConverted) {
  const Bench bench = ringWorld();
  const Ran ran = run(bench, "A.I", "%A G70 *\nT1 G17 *\nG247 Q339=+1 *\nG00 G90 Z+2 *\nX+1 Y+0 *\nN9 %A G70 *\n");
  EXPECT_EQ(ran.why(), "");
  EXPECT_NEAR(ran.machine->position()[0], 30 + 25.4, 1e-9);
}

TEST(DinIsoRun, CornersAreRoundedAsInKlartext) {
  const Bench bench = ringWorld();
  const Ran klartext = run(bench, "A.H",
                           "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 CYCL DEF 247 P ~\n Q339=+1\n3 L X+0 Y+0 Z+50 FMAX\n"
                           "4 L X+100 RL F1000\n5 RND R5\n6 L Y+50\n7 CHF 3\n8 L X+0\n9 CR X+20 Y+70 R+20 DR-\n"
                           "10 L Y+100 R0\n11 END PGM A MM\n");
  const Ran dinIso = run(bench, "A.I",
                         "%A G71 *\nT1 G17 *\nG247 P ~\n Q339=+1 *\nG00 G90 X+0 Y+0 Z+50 *\nG01 G41 X+100 F1000 *\n"
                         "G25 R5 *\nY+50 *\nG24 R3 *\nX+0 *\nG02 X+20 Y+70 R+20 *\nG01 G40 Y+100 *\nN99 %A G71 *\n");
  expectSameRun(klartext, dinIso);
  // Sharp corners would be 100 + 50 + 100 mm and the arc's quarter turns: the path is truly shorter, and not nothing.
  EXPECT_GT(dinIso.outcome.info.totalPathLength, 250);
}

TEST(DinIsoRun, ABrokenBlockStopsWithItsPlace) {
  const Ran ran = run(ringWorld(), "A.I", "%A G71 *\nN10 T1 G17 *\nN20 G01 X+ *\nN30 %A G71 *\n");
  ASSERT_EQ(ran.outcome.diagnostics.size(), 1U);
  EXPECT_EQ(ran.outcome.diagnostics.front().place.line, 3U);
  EXPECT_EQ(ran.outcome.diagnostics.front().excerpt, "N20 G01 X+");
}

Diagnostics checked(const std::string& text) {
  const auto program = session::programOf("A.I", text, ProgramLanguage::DinIso);
  return session::checkProgram(*program, ControlKind::TNC640);
}

TEST(DinIsoCheck, FindsNothingInAGoodProgram) {
  for (const Diagnostic& diagnostic : checked(dinIsoProgram))
    ADD_FAILURE() << format(diagnostic);
}

TEST(DinIsoCheck, TheUnitStandsInTheHeadOnly) {
  EXPECT_TRUE(checked("%A G71 *\nN10 G71 G90 *\nN99999999 %A G71 *\n").empty());
  EXPECT_TRUE(checked("%A G70 *\nN10 G70 *\nN99999999 %A G70 *\n").empty());
  const Diagnostics toInch = checked("%A G71 *\nN10 G90 G70 *\nN99999999 %A G71 *\n");
  ASSERT_EQ(toInch.size(), 1U);
  EXPECT_EQ(toInch[0].message, "G70 changes the unit in the middle of the program");
  EXPECT_EQ(toInch[0].place.column, 9U);
  EXPECT_EQ(checked("%A G70 *\nN10 G71 *\nN99999999 %A G70 *\n").size(), 1U);
}

TEST(DinIsoCheck, NamesMistakesWithTheirPlace) {
  const Diagnostics found = checked(
      "%A G71 *\nN10 L7 *\nN20 G98 L1 *\nN30 G98 L1 *\nN40 G417 TOP ~\nQ263=+0 ~\nQ264=+0 ~\nQ294=+0 ~\nQ320=-1 ~\n"
      "Q260=+50 ~\nQ305=+1 ~\nQ333=+0 ~\nQ303=+1 *\n");
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].place.line, 2U);
  EXPECT_EQ(found[0].message, "there is no label 7 in this program");
  EXPECT_EQ(found[0].advice, "define it with G98 L7 or correct the name");
  EXPECT_EQ(found[1].place.line, 4U);
  EXPECT_EQ(found[2].place.line, 5U);
  EXPECT_EQ(found[2].advice, "write N99999999 %NAME G71 * as its last block");
  EXPECT_EQ(found[3].place.line, 9U);
  EXPECT_NE(found[3].message.find("Q320"), std::string::npos);
}

TEST(DinIsoSource, IsKnownByEndingAndText) {
  EXPECT_EQ(session::languageOf("A.I", ""), ProgramLanguage::DinIso);
  EXPECT_EQ(session::languageOf("a.i", ""), ProgramLanguage::DinIso);
  EXPECT_EQ(session::languageOf("A.TXT", dinIsoProgram), ProgramLanguage::DinIso);
  EXPECT_EQ(session::languageOf("A.TXT", klartextProgram), ProgramLanguage::Klartext);
  EXPECT_EQ(session::languageOf("A.TXT", "N10 G54 G90\nN20 CYCLE977(1,2)\nN30 M30\n"), ProgramLanguage::Sinumerik);
}

}  // namespace
}  // namespace probewright::language::din_iso::testing
