#include "language/klartext/path_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"
#include "language/klartext/check.hpp"

/// Words that do not belong to their block are refused, by the check and by the run, and never left out in silence.
namespace probewright::language::klartext::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* before = "TOOL CALL 1 Z S100\nL X+20 Y+0 Z+50 R0 FMAX\nL F500\nCC X+0 Y+0\n";

/// What the run says first of `block`: "column: message; advice", or the alarm.
std::string refusal(const std::string& block) {
  World world("mill5-table-table");
  const RunResult result = world.run(before + block + "\n");
  if (result.diagnostics.empty()) return "nothing";
  const Diagnostic& first = result.diagnostics.front();
  if (!first.code.empty()) return first.code + ": " + first.message;
  return std::to_string(first.place.column) + ": " + first.message + "; " + first.advice;
}

/// The same of the check.
std::string checked(const std::string& block) {
  KlartextProgram program("a.h", std::string("BEGIN PGM A MM\n") + before + block + "\nEND PGM A MM\n");
  const Diagnostics found = checkProgram(program, control::ControlKind::TNC640);
  if (found.empty()) return "nothing";
  const Diagnostic& first = found.front();
  return std::to_string(first.place.column) + ": " + first.message + "; " + first.advice;
}

struct Case {
  std::string block, said;
};

void expectRefused(const std::vector<Case>& cases) {
  for (const Case& each : cases) {
    EXPECT_EQ(refusal(each.block), each.said) << each.block;
    EXPECT_EQ(checked(each.block), each.said) << each.block;
  }
}

TEST(PathWords, OfOtherPathFunctions) {
  constexpr const char* noTurn = "take it away, or write an arc: C, CR or CP";
  constexpr const char* noRadius = "write R0, RL or RR for the radius compensation, CR for an arc with a radius";
  constexpr const char* fromPole = "take it away: the radius is the distance of the starting point from the pole";
  constexpr const char* justLength = "take it away: DEP LT takes LEN, F and M";
  expectRefused(
      {{"C PR+20 PA+90 DR+", "3: C takes no PR; write CP for polar coordinates"},
       {"C X+0 Y+20 PA+70 DR+", "12: C takes no PA; write CP for polar coordinates"},
       {"CR X+0 Y+20 R+20 DR+ PA+7", "22: CR takes no PA; write CP for polar coordinates"},
       {"C X+0 Y+20 DR+ R+20", "16: C takes no R; " + std::string(noRadius)},
       {"CT PA+30", "4: CT takes no PA; write CTP for polar coordinates"},
       {"CT X+1 Y+1 DR+", "12: CT takes no DR; " + std::string(noTurn)},
       {"CP PR+30 PA+90 DR+", "4: CP takes no PR; " + std::string(fromPole)},
       {"L PR+5 PA+45", "3: L takes no PR; write LP for polar coordinates"},
       {"L X+1 IPA+30", "7: L takes no IPA; write LP for polar coordinates"},
       {"L X+3 DR+", "7: L takes no DR; " + std::string(noTurn)},
       {"L X+1 R+5", "7: L takes no R; " + std::string(noRadius)},
       {"X+5 DR-", "5: L takes no DR; " + std::string(noTurn)},
       {"L X+1 NX+0 NY+0 NZ+1", "7: L takes no NX; write LN for a line with a surface normal or a tool direction"},
       {"L X+1 LEN5", "7: L takes no LEN; take it away, or write APPR or DEP"},
       {"CC PR+5", "4: CC takes no PR; take it away: CC takes X, Y, Z and M"},
       {"CC X+0 Y+0 RL", "12: CC takes no RL; take it away: CC takes X, Y, Z and M"},
       {"CC X+0 Y+0 F100", "12: CC takes no feed; write the feed in the path block after it"},
       {"RND R2 X+5", "8: RND takes no X; take it away: RND takes R, F and M"},
       {"CHF 2 RL", "7: CHF takes no RL; take it away: CHF takes R, F and M"},
       {"DEP LT LEN5 X+5", "13: DEP LT takes no X; " + std::string(justLength)},
       {"DEP LT LEN5 RL", "13: DEP LT takes no RL; " + std::string(justLength)},
       {"APPR LT X+1 Y+1 LEN5 R+4 RL F100", "22: APPR LT takes no R; " + std::string(noRadius)},
       {"APPR LCT X+1 Y+1 CCA30 R+4 RL F100", "18: APPR LCT takes no CCA; take it away, or write APPR or DEP"},
       {"CYCL CALL X+1", "11: CYCL CALL takes no X; take it away: CYCL CALL takes F and M"}});
  EXPECT_EQ(refusal("DEP PLT LEN5"),
            "8: there is no DEP PLT: only DEP LCT has an end point, and so a polar form; write DEP LT");
}

TEST(PathWords, PolarBesideCartesian) {
  expectRefused(
      {{"LP X+5 Y+6",
        "8: LP takes one axis beside PR and PA, the one along the tool, and this block has X and Y; take the "
        "axes of the plane away, or write L for them"},
       {"CP X+0 Y+20 DR+",
        "8: CP takes one axis beside PR and PA, the one along the tool, and this block has X and Y; take the "
        "axes of the plane away, or write C for them"},
       {"CTP X+1 Y+1",
        "9: CTP takes one axis beside PR and PA, the one along the tool, and this block has X and Y; take the "
        "axes of the plane away, or write CT for them"}});
  // Which single axis lies in the plane only the run knows: that of the last CC counts.
  constexpr const char* mixture =
      "Block format incorrect: Beside polar coordinates only Z may stand, not X, which lies in their plane";
  EXPECT_EQ(refusal("LP PR+25 PA+45 X+3"), mixture);
  EXPECT_EQ(refusal("CP PA+45 X+3 DR+"), mixture);
  constexpr const char* known =
      "1: beside polar coordinates only Z may stand, not X, which lies in their plane; take X away, or write the end "
      "point in X, Y, Z";
  EXPECT_EQ(checked("LP PR+25 PA+45 X+3"), known);
  EXPECT_EQ(checked("LBL 1\nLP PR+25 PA+45 X+3"), "nothing");
  EXPECT_EQ(checked("CC Y+0 Z+0\nLP PR+25 PA+45 X+3"), "nothing");
  EXPECT_EQ(refusal("CC Y+0 Z+0\nLP PR+25 PA+45 X+3"), "nothing");
  EXPECT_EQ(refusal("LP PR+25 PA+45 Z+3"), "nothing");
  EXPECT_EQ(refusal("CP IPA+360 IZ-5 DR+"), "nothing");
}

TEST(PathWords, TwiceOrAgainstEachOther) {
  expectRefused(
      {{"L X+1 X+2", "7: X is given twice in this block; remove one of the two"},
       {"L X+1 IX+2", "7: X is given twice in this block; remove one of the two"},
       {"LP PR+9 PA+1 IPA+2", "14: PA is given twice in this block; remove one of the two"},
       {"L X+20 RL RR F100", "11: the radius compensation is given twice in this block; remove one of the two"},
       {"L X+20 F100 F200", "13: the feed is given twice in this block; remove one of the two"},
       {"L X+20 R0 FMAX F200", "16: the feed is given twice in this block; remove one of the two"},
       {"L X+20 FU0.1 F200", "14: the feed is given twice in this block; remove one of the two"},
       {"F100 F200 M3", "6: the feed is given twice in this block; remove one of the two"},
       {"L X+20 M91 M92",
        "12: M91 and M92 exclude each other in one block; remove one of the two, or write it in a block of "
        "its own"},
       {"L X+20 M3 M4",
        "11: M3 and M4 exclude each other in one block; remove one of the two, or write it in a block of its "
        "own"},
       {"M13 M4",
        "5: M13 and M4 exclude each other in one block; remove one of the two, or write it in a block of its "
        "own"},
       {"TOOL CALL 1 Z S100 S200", "20: the spindle speed is given twice in this block; remove one of the two"},
       {"TRANS DATUM AXIS X+5 X+6", "22: X is given twice in this block; remove one of the two"}});
  EXPECT_EQ(refusal("CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 X+5 IX+6"),
            "19: X is given twice in this block; remove one of the two");
  EXPECT_EQ(refusal("TCH PROBE 4.0 M\nTCH PROBE 4.1 Q60\nTCH PROBE 4.2 IX+1 IX+2\n"
                    "TCH PROBE 4.3 DIST +60 F500 MB900 REFERENCE SYSTEM:1"),
            "21: X is given twice in this block; remove one of the two");
}

/// What controls and posts write in one block goes on being read.
TEST(PathWords, ThatBelongTogether) {
  for (const char* block :
       {"L X+1 IY+2 Z+3 A+0 C+0 R0 FMAX M3 M8", "LP IPR+5 PA+45 Z+2 R0 F MAX M8", "LN X+1 Y+2 Z+3 NX+0 NY+0 NZ+1 F500",
        "C X+0 Y+20 Z+60 DR+ R0 F200", "CR X+0 Y+20 R-20 DR+", "CP PA+90 DR+ M3", "L X+10 R F M", "X+46 R0 F100 M8",
        "L X+1 FMAX M140 MB5 F100", "L M140 MB20 F500", "M5 M9 M2", "L Z+10 R0 FMAX M91", "STOP M9",
        "L X+30\nRND R2 F20\nL Y+30", "L X+30\nCHF 2\nL Y+30"})
    EXPECT_EQ(refusal(block), "nothing") << block;
}

TEST(PathWords, OfPlane) {
  constexpr const char* spatial = "; write PLANE SPATIAL SPA+0 SPB+45 SPC+0 TURN FMAX";
  constexpr const char* euler = "; write PLANE EULER EULPR+45 EULNU+20 EULROT+22 TURN FMAX";
  constexpr const char* way =
      "this block does not say how the rotary axes get to the plane; add TURN FMAX, MOVE DIST50 FMAX or STAY, which "
      "leaves them where they are";
  expectRefused(
      {{"PLANE SPATIAL SPA+0 SPB+20 SPC+0 SPB+30 TURN FMAX",
        "34: SPB is given twice in this block; remove one of the two"},
       {"PLANE SPATIAL SPA+0 SPB+20 SPC+0 ROT+5 TURN FMAX", "34: PLANE SPATIAL takes no ROT" + std::string(spatial)},
       {"PLANE SPATIAL SPA+0 SPB+20 SPC+0 EULPR+3 TURN FMAX",
        "34: PLANE SPATIAL takes no EULPR" + std::string(spatial)},
       {"PLANE EULER EULPR+0 EULNU+20 EULROT+0 SPA+5 TURN FMAX", "39: PLANE EULER takes no SPA" + std::string(euler)},
       {"PLANE SPATIAL SPB+20 TURN FMAX", "31: PLANE SPATIAL lacks SPA, SPC" + std::string(spatial)},
       {"PLANE EULER EULNU+20 TURN FMAX", "31: PLANE EULER lacks EULPR, EULROT" + std::string(euler)},
       {"PLANE SPATIAL SPA+0 SPB+20 SPC+0", "33: " + std::string(way)},
       {"PLANE AXIAL B+20", "17: " + std::string(way)},
       {"PLANE SPATIAL SPA+0 SPB+20 SPC+0 STAY TURN FMAX",
        "39: STAY and TURN exclude each other; remove one of the two"},
       {"PLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN FMAX SEQ+ SEQ-",
        "49: SEQ is given twice in this block; remove one of the two"},
       {"PLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN FMAX SEQ+ SYM-",
        "49: SEQ and SYM exclude each other; remove one of the two"},
       {"PLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN FMAX TABLE ROT COORD ROT",
        "54: TABLE ROT and COORD ROT exclude each other; remove one of the two"},
       {"PLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN FMAX F200",
        "44: the feed is given twice in this block; remove one of the two"},
       {"PLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN DIST50 FMAX",
        "50: DIST belongs to MOVE; take it away, or write MOVE DIST50"},
       {"PLANE RELATIV SPA+5 SPB+5 TURN FMAX",
        "36: PLANE RELATIVE turns about one axis, and this block has SPA, SPB; write PLANE RELATIV SPB-45 TURN FMAX"}});
  EXPECT_EQ(refusal("PLANE RESET"), "nothing");
  EXPECT_EQ(refusal("PLANE SPATIAL SPA+0 SPB+0 SPC+20 MOVE DIST50 MB MAX F1000 SEQ- COORD ROT"), "nothing");
}

/// IPR and IPA count from the starting point in every path function that has them.
TEST(PathWords, IncrementalPolarCoordinatesOfTangentialArcs) {
  const auto end = [](const std::string& block) {
    World world;
    expectFinished(world.run(before + ("L X+15 Y+0\n" + block + "\n")));
    return world.control->channel.position();
  };
  const auto absolute = end("CTP PR+25 PA+60"), incremental = end("CTP IPR+10 IPA+60");
  EXPECT_NEAR(absolute.x(), 25 * std::cos(60 * std::acos(-1.0) / 180), 1e-9);
  EXPECT_NEAR(incremental.x(), absolute.x(), 1e-9);
  EXPECT_NEAR(incremental.y(), absolute.y(), 1e-9);
}

/// An arc moves X, Y and Z: other axes of its block are named.
TEST(PathWords, RotaryAxesInArcsAreNamed) {
  World world("mill5-table-table");
  const RunResult result = world.run(std::string(before) + "CP PA+90 C+20 DR+\n");
  ASSERT_TRUE(result.diagnostics.empty()) << result.diagnostics.front().message;
  bool named = false;
  for (const auto& event : world.control->journal.events)
    named = named || event.text.find("The axis C in the block of an arc") != std::string::npos;
  EXPECT_TRUE(named);
}

/// What came after the last software of the iTNC 530 is a mistake there; its formulas have % (its manual prints it).
TEST(PathWords, BlocksThatTheITnc530Lacks) {
  const auto said = [](const std::string& block, control::ControlKind kind) {
    KlartextProgram program("a.h", "BEGIN PGM A MM\n" + block + "\nEND PGM A MM\n");
    const Diagnostics found = checkProgram(program, kind);
    return found.empty() ? std::string("nothing") : found.front().message;
  };
  using control::ControlKind;
  for (const auto& [block, name] : std::vector<std::pair<std::string, std::string>>{
           {"TABDATA READ Q1 = TOOL COLUMN \"L\" KEY \"1\"", "TABDATA READ"},
           {"OPEN FILE \"a.txt\"", "OPEN FILE"},
           {"PRESET SELECT #1", "PRESET SELECT"},
           {"PRESET COPY #1 TO #2", "PRESET COPY"},
           {"PRESET CORR X+1", "PRESET CORR"},
           {"TRANS MIRROR AXIS X", "TRANS MIRROR"},
           {"TRANS ROTATION ROT+5", "TRANS ROTATION"},
           {"TRANS SCALE RESET", "TRANS SCALE"},
           {"PLANE SPATIAL SPA+0 SPB+0 SPC+0 TURN FMAX SYM+", "SYM"},
           {"FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT TIP-TIP", "REFPNT of FUNCTION TCPM"},
           {"FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS F1000", "the feed limit of FUNCTION TCPM"}}) {
    EXPECT_EQ(said(block, ControlKind::iTNC530), "the iTNC530 does not have " + name) << block;
    EXPECT_EQ(said(block, ControlKind::TNC640), "nothing") << block;
  }
  for (const char* block : {"Q12 = 400 % 360", "TRANS DATUM AXIS X+5", "PLANE SPATIAL SPA+0 SPB+0 SPC+0 TURN FMAX SEQ+",
                            "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS"})
    EXPECT_EQ(said(block, ControlKind::iTNC530), "nothing") << block;
  EXPECT_EQ(said("CALL PGM", ControlKind::TNC640), "the name of a program is expected after CALL PGM");
}

/// Called programs are not checked before a run: the run stops at the block.
TEST(PathWords, BlocksThatTheITnc530LacksStopACalledProgram) {
  using control::ControlKind;
  const auto run = [](const std::string& block, ControlKind kind) {
    World world("mill5-table-table", kind);
    world.library.texts["SUB.H"] = "BEGIN PGM SUB MM\n" + block + "\nEND PGM SUB MM\n";
    return world.run("CALL PGM SUB.H\n");
  };
  for (const char* block : {"PRESET SELECT #1", "PRESET CORR X+1", "TRANS MIRROR AXIS X", "TRANS ROTATION ROT+5",
                            "PLANE SPATIAL SPA+0 SPB+0 SPC+0 STAY SYM+"}) {
    const RunResult old = run(block, ControlKind::iTNC530);
    ASSERT_EQ(old.end, RunEnd::Alarm) << block;
    EXPECT_THAT(old.diagnostics.front().message, HasSubstr("the iTNC530 does not have ")) << block;
    EXPECT_EQ(old.diagnostics.front().place.file, "SUB.H");
    EXPECT_EQ(old.diagnostics.front().place.line, 2u);
    EXPECT_EQ(run(block, ControlKind::TNC640).end, RunEnd::Finished) << block;
  }
  EXPECT_EQ(run("TRANS DATUM AXIS X+5", ControlKind::iTNC530).end, RunEnd::Finished);
}

/// A parameter that a cycle has twice is named where it stands, and each of them.
TEST(PathWords, DoubledCycleParametersAreNamedAtTheirPlaces) {
  KlartextProgram program("a.h",
                          "BEGIN PGM A MM\nTCH PROBE 417 A ~\n Q263=1 ~\n Q263=2 ~\n Q264=3 ~\n Q294=0 ~\n Q320=0 ~\n"
                          " Q260=1 ~\n Q260=2 ~\n Q305=1 ~\n Q333=0 ~\n Q303=1\nEND PGM A MM\n");
  const Diagnostics found = checkProgram(program, control::ControlKind::TNC640);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].message, "Q263 is given twice in this cycle");
  EXPECT_EQ(found[0].place.line, 4u);
  EXPECT_EQ(found[0].place.column, 2u);
  EXPECT_EQ(found[0].excerpt, " Q263=2 ~");
  EXPECT_EQ(found[1].message, "Q260 is given twice in this cycle");
  EXPECT_EQ(found[1].place.line, 9u);
}

}  // namespace
}  // namespace probewright::language::klartext::testing
