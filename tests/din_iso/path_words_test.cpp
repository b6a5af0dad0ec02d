#include "language/din_iso/path_words.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "language/din_iso/program.hpp"
#include "language/klartext/check.hpp"
#include "setup/simulated_run.hpp"
#include "support/heidenhain_bench.hpp"

/// Words that do not belong to the path function in force are refused, also where a block before theirs chose it.
namespace probewright::language::din_iso::testing {
namespace {

using testing_support::Bench;

constexpr const char* before = "%A G71 *\nN10 T1 G17 S100 *\nN20 G00 G40 G90 X+20 Y+0 Z-200 *\nN30 I+0 J+0 *\n";

std::string programOf(const std::string& blocks) { return before + blocks + "\nN99999999 %A G71 *\n"; }

/// "line:column: message; advice" of the check, or "nothing".
std::string checked(const std::string& blocks) {
  DinIsoProgram program("a.i", programOf(blocks));
  const Diagnostics found = klartext::checkProgram(program, control::ControlKind::TNC640);
  if (found.empty()) return "nothing";
  const Diagnostic& first = found.front();
  return std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + ": " + first.message + "; " +
         first.advice;
}

/// What the run reports first: its alarm, or the mistake in the text.
std::string ran(const std::string& blocks) {
  Bench bench;
  session::RunOptions options;
  options.control = bench.control;
  const testing_support::Ran run{setup::runText("A.I", programOf(blocks), bench.setup, options)};
  const session::RunOutcome& outcome = run.outcome;
  const Diagnostics& said = outcome.diagnostics.empty() ? outcome.result.diagnostics : outcome.diagnostics;
  if (said.empty()) return "nothing";
  const Diagnostic& first = said.front();
  return (first.code.empty() ? "" : first.code + ": ") + first.message;
}

TEST(DinIsoPathWords, OfTheBlocksOwnFunction) {
  struct Case {
    std::string block, said;
  };
  const std::vector<Case> cases = {
      {"N40 G01 R+5 H+5 F500 *", "5:9: G01 takes no R; write G11 for polar coordinates"},
      {"N40 G01 H+45 F500 *", "5:9: G01 takes no H; write G11 for polar coordinates"},
      {"N40 G06 X+1 R+5 F500 *", "5:13: G06 takes no R; write G16 for polar coordinates"},
      {"N40 G03 X+0 Y+20 H+90 F500 *", "5:18: G03 takes no H; write G13 for polar coordinates"},
      {"N40 G11 X+5 Y+5 F500 *",
       "5:13: G11 takes polar coordinates, and this block has X and Y; write G01 for axes "
       "of the plane"},
      {"N40 G12 X+0 Y+20 F500 *",
       "5:13: G12 takes polar coordinates, and this block has X and Y; write G02 for axes "
       "of the plane"},
      {"N40 G13 R+20 H+90 F500 *",
       "5:9: G13 takes no R; take it away: the radius is the distance of the starting point "
       "from the pole"},
      {"N40 G03 G43 X+0 Y+20 F500 *",
       "5:9: G03 takes no G43; write the paraxial compensation in a block with G00 or G01"},
      {"N40 G41 G42 X+5 *", "5:9: G41 and G42 are two radius compensations in one block; remove one of the two"},
      {"N40 G17 G18 *", "5:9: G17 and G18 are two tool axes in one block; remove one of the two"},
      {"N40 G01 X+5 F100 F200 *", "5:18: the feed is given twice in this block; remove one of the two"},
      {"N40 I+0 I+5 *", "5:9: I is given twice in this block; remove one of the two"},
      {"N40 G01 X+5 X+6 *", "5:13: X is given twice in this block; remove one of the two"},
      {"N40 G01 X+5 M3 M4 *",
       "5:16: M3 and M4 exclude each other in one block; remove one of the two, or write it in a block of its own"}};
  for (const Case& each : cases)
    EXPECT_EQ(checked(each.block), each.said) << each.block;
}

/// What a function or a cycle cannot do in its block is refused: nothing of it is lost in silence.
TEST(DinIsoPathWords, BesideFunctionsThatDoNotTakeThem) {
  struct Case {
    std::string block, said;
  };
  const std::vector<Case> cases = {
      {"G28 X G41", "G28 takes no G41"},
      {"G42 G79", "G79 takes no G42"},
      {"G54 X+5 M91", "G54 takes no M91"},
      {"G38 M92", "G38 takes no M92"},
      {"G53 P01 1 DL+1", "G53 takes no DL"},
      {"G53 P01 1 P02 7", "G53 takes no P02"},
      {"G55 P01 5 P02 Z- P03 +5 P04 +0 P05 -5 P06 1", "G55 takes no P06"},
      {"G36 S10 S5", "the spindle angle S is given twice in this block"},
      {"G99 T5 L+10 L+3", "the tool length L is given twice in this block"},
      {"G62 T0.05 T5", "the tolerance T is given twice in this block"},
      {"G25 G43", "G25 takes no G43"},
      {"G99 T5 L+10 G44", "G99 takes no G44"},
      {"G24 R2 FU0.1", "G24 takes no FU"},
      {"G01 X+7 G30", "G30 takes no path function G01"},
      {"G00 G54 X+7", "G54 takes no path function G00"},
      {"X+7 G98 L5", "X stands before G98, which takes the rest of the block only"},
      {"F200 G98 L5", "F stands before G98, which takes the rest of the block only"},
      {"M3 G200 DRILLING Q200=2", "M stands before G200, which takes the rest of the block only"},
      {"I+5 G247 Q339=1", "I, J, K stands before G247, which takes the rest of the block only"},
      {"G01 X+7 G421 HOLE Q273=5", "X stands before G421, which takes the rest of the block only"},
      {"G200 X+7", "this block defines a cycle and moves no axis"},
      {"G200 DRILLING I+2 J+3 Q200=2", "this block defines a cycle and moves no axis"},
      {"G421 HOLE IX-7 Q273=5", "this block defines a cycle and moves no axis"},
      {"I+0 J+0 M91", "M91 and M92 take axes in straight lines only, not I, J and K"}};
  for (const Case& each : cases)
    EXPECT_NE(checked("N40 " + each.block + " *").find(": " + each.said + "; "), std::string::npos)
        << each.block << ": " << checked("N40 " + each.block + " *");
  for (const char* block : {"G90 G98 L5", "G28 X", "G54 G91 X+5", "G30 G17 X+0 Y+0 Z-40", "G31 G90 X+100 Y+100 Z+0",
                            "G25 R2 F100", "G79 M3", "G00 G40 G90 Z-150", "G29 M8"})
    EXPECT_EQ(checked("N40 " + std::string(block) + " *"), "nothing") << block;
}

/// M94, M116 and M138 name axes; an axis with a value behind them is moved.
TEST(DinIsoPathWords, BehindFunctionsThatNameAxes) {
  const auto moves = [](const std::string& block) {
    DinIsoProgram program("a.i", programOf("N40 " + block + " *"));
    Block read;
    Diagnostics mistakes;
    bool any = false;
    for (BlockPosition at = program.begin(); program.parse(at, read, mistakes); at = read.next) {
      any = false;
      for (const Instruction& instruction : read.instructions) {
        const auto* move = std::get_if<Move>(&instruction);
        any = any || (move != nullptr && move->words.count > 0);
      }
      if (at.line == 5) break;
    }
    EXPECT_TRUE(mistakes.empty()) << block;
    return any;
  };
  for (const char* block : {"M94 X+7", "M116 C+5", "G01 M94 G91 X+7", "M138 A B C+10", "M94 CQ1"})
    EXPECT_TRUE(moves(block)) << block;
  for (const char* block : {"M94", "M94 C", "M138 A B", "M118 X1 Y1"})
    EXPECT_FALSE(moves(block)) << block;
}

TEST(DinIsoPathWords, OfTheFunctionOfABlockBefore) {
  const std::string mixture = "G11 takes polar coordinates, and this block has X and Y";
  EXPECT_EQ(checked("N40 G11 R+20 H+0 F500 *\nN50 X+5 Y+5 *"), "6:9: " + mixture + "; write G01 for axes of the plane");
  EXPECT_EQ(ran("N40 G11 R+20 H+0 F500 *\nN50 X+5 Y+5 *"), mixture);
  EXPECT_EQ(checked("N40 G01 X+5 F500 *\nN50 R+5 *"), "6:5: G01 takes no R; write G11 for polar coordinates");
  // Behind a label and a call only the run knows.
  const std::string called =
      "N40 G01 X+5 F500 *\nN45 L1,0 *\nN50 H+5 *\nN60 G00 Z-190 M2 *\nN70 G98 L1 *\nN80 G11 H+9 "
      "*\nN90 G98 L0 *";
  EXPECT_EQ(checked(called), "nothing");
  EXPECT_EQ(ran(called), "nothing");
  const std::string wrong =
      "N40 G01 X+5 F500 *\nN45 L1,0 *\nN50 X+5 Y+2 *\nN60 G00 Z-190 M2 *\nN70 G98 L1 *\nN80 G11 "
      "H+9 *\nN90 G98 L0 *";
  EXPECT_EQ(checked(wrong), "nothing");
  EXPECT_EQ(ran(wrong), "Block format incorrect: " + mixture);
}

TEST(DinIsoPathWords, ThatBelongTogether) {
  for (const char* blocks :
       {"N40 G11 G90 R+20 H+30 Z+5 F500 M3 *\nN50 G91 H+30 *", "N40 G02 X+0 Y+20 R+20 F500 *",
        "N40 G03 I+0 J+0 X+0 Y+20 F500 *", "N40 G13 G91 H+360 Z-5 F500 *", "N40 G00 G40 G90 X+5 G91 Y+5 M8 *",
        "N40 G01 G43 X+5 F500 *", "N40 G10 I+0 J+0 R+20 H+30 *"})
    EXPECT_EQ(checked(blocks), "nothing") << blocks;
}

}  // namespace
}  // namespace probewright::language::din_iso::testing
