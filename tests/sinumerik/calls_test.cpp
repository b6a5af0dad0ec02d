#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "language/sinumerik/check.hpp"
#include "sinumerik/world.hpp"

/// Calls in all their forms: modal ones, sections of programs, programs that nobody can read.
namespace probewright::language::sinumerik {
namespace {

TEST(SinumerikCalls, ModalCallsFollowEachMotion) {
  World world;
  world.texts.add("COUNT", "PROC COUNT\nR10=R10+1\nRET\n");
  world.run(
      "R5=$P_MC\nR10=0\nMCALL COUNT\nR6=$P_MC\nR1=R10\nG0 X10\nR2=R10\nY10\nMSG(\"no "
      "motion\")\nM8\nR3=R10\nMCALL\nX20\nR4=R10 R7=$P_MC\n");
  EXPECT_EQ(world.r(5), 0);
  EXPECT_EQ(world.r(6), 1) << "$P_MC: a modal call is in effect";
  EXPECT_EQ(world.r(7), 0);
  EXPECT_EQ(world.r(1), 0);
  EXPECT_EQ(world.r(2), 1);
  EXPECT_EQ(world.r(3), 2);
  EXPECT_EQ(world.r(4), 2);
}

TEST(SinumerikCalls, ModalCallsComputeTheirArgumentsOnce) {
  World world;
  world.texts.add("NOTE", "PROC NOTE(REAL WIDTH, STRING[10] TEXT)\nR10=R10+WIDTH\nR11=STRLEN(TEXT)\nRET\n");
  world.run("R10=0 R1=5\nMCALL NOTE(R1,\"abc\")\nR1=100\nG0 X10\nX20\n");
  EXPECT_EQ(world.r(10), 10);
  EXPECT_EQ(world.r(11), 3);
}

TEST(SinumerikCalls, AModalCallReachesIntoSubprogramsButNotIntoItself) {
  World world;
  world.texts.add("DRILL", "PROC DRILL\nR10=R10+1\nG0 Z=IC(-1)\nZ=IC(1)\nRET\n");
  world.texts.add("L50", "G0 X30\nX40\nM17\n");
  world.run("R10=0\nMCALL DRILL\nL50\n");
  EXPECT_EQ(world.r(10), 2);
}

TEST(SinumerikCalls, FeedSpindleAndG0AloneDriveAModalCallToo) {
  World world;
  world.texts.add("COUNT", "PROC COUNT\nR10=R10+1\nRET\n");
  world.run("R10=0\nG1 F100 X1\nMCALL COUNT\nF200\nS500\nG0\nM3\nR1=R10\nG2 F100 X3 Y0 CR=5\nR2=R10\nF300\n");
  EXPECT_EQ(world.r(1), 3);
  EXPECT_EQ(world.r(2), 4);
  EXPECT_EQ(world.r(10), 4) << "not while an arc is active";
}

TEST(SinumerikCalls, AModalCallComesBeforeTheEndOfItsBlock) {
  World world;
  world.texts.add("COUNT", "PROC COUNT\nR10=R10+1\nRET\n");
  world.run("R10=0\nMCALL COUNT\nG0 X10 M0\nX20 M30\n");
  EXPECT_EQ(world.r(10), 2);
  const auto& events = world.control.journal.events;
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().place.file, "MAIN.MPF");
  EXPECT_EQ(events.back().place.line, 3u);
}

TEST(SinumerikCalls, AMeasuringCycleIsCalledModally) {
  World world;
  // Without a probe the cycle refuses; what counts is that it is reached at the motion.
  const execution::RunResult result = world.tryRun("MCALL CYCLE978(0,,,1,10,,5,1,2,1,\"\",,0)\nR1=1\nG0 X10\nR1=2\n");
  EXPECT_EQ(result.end, execution::RunEnd::Alarm);
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_EQ(result.diagnostics.front().place.line, 3u);
  EXPECT_EQ(world.r(1), 1);
}

TEST(SinumerikCalls, ALabelMayBeNamedAsAStatementButNotAsAWordOfTheFlow) {
  World world;
  world.run("GOTOF START\nR1=1\nSTART: R2=2\n");
  EXPECT_NE(world.r(1), 1);
  EXPECT_EQ(world.r(2), 2);
  const auto program = SinumerikProgram::fromText("test.mpf", "CALL BLOCK AA TO IF EN\nREPEAT AA ELSE\nAA: R1=1\n");
  const Diagnostics found = check(*program, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].message, "the last label of the section to call was expected");
}

TEST(SinumerikCalls, SectionsOfThisAndOfOtherPrograms) {
  World world;
  world.texts.add("PARTS", "PROC PARTS\nR10=100\nFIRST: R10=R10+1\nR10=R10+2\nLAST: R10=R10+4\nR10=100\nRET\n");
  world.run("R10=0\nCALL \"PARTS\" BLOCK FIRST TO LAST\nR1=R10\nCALL \"PARTS\" BLOCK LAST TO LAST\nR2=R10\n");
  EXPECT_EQ(world.r(1), 7);
  EXPECT_EQ(world.r(2), 11);
  world.run("R10=0\nCALL BLOCK AA TO BB\nR1=R10\nGOTOF ENDE\nAA: R10=R10+1\nBB: R10=R10+2\nR10=50\nENDE: R2=R10\n");
  EXPECT_EQ(world.r(1), 3);
  EXPECT_EQ(world.r(2), 3);
  EXPECT_EQ(world.alarm("CALL \"PARTS\" BLOCK LAST TO FIRST\n"), "14080");
  EXPECT_EQ(world.alarm("CALL \"PARTS\" BLOCK NONE TO LAST\n"), "14080");
}

/// A semicolon within a text is text; behind the PROC line it begins a comment, whatever stands there.
TEST(SinumerikCalls, HeadersMayHoldSemicolonsInTextsAndBeforeComments) {
  World world;
  world.texts.add(
      "NOTE", "proc note(string[20] text=\"a;B\", real width=3) ; says \"so (1;2\nR11=STRLEN(TEXT)\nR12=WIDTH\nRET\n");
  world.run("NOTE\nR1=R11 R2=R12\nNOTE(\"xyzuv\",7)\n");
  EXPECT_EQ(world.r(1), 3);
  EXPECT_EQ(world.r(2), 3);
  EXPECT_EQ(world.r(11), 5);
  EXPECT_EQ(world.r(12), 7);
}

std::vector<std::string> messagesOf(const Diagnostics& found) {
  std::vector<std::string> messages;
  for (const Diagnostic& each : found)
    messages.push_back(std::to_string(each.place.line) + ":" + std::to_string(each.place.column) + " " + each.message);
  return messages;
}

TEST(SinumerikCalls, CheckNamesWhatIsWrongWithACall) {
  Texts library;
  library.add("SUB", "PROC SUB(REAL WIDTH, VAR REAL RESULT)\nAA: R1=1\nBB: R2=2\nRET\n");
  const auto program = SinumerikProgram::fromText("test.mpf",
                                                  "SUB(1)\n"
                                                  "SUB(1,2)\n"
                                                  "SUB(1,R1,3)\n"
                                                  "CALL \"SUB\" BLOCK BB TO AA\n"
                                                  "CALL BLOCK AA\n"
                                                  "MCALL NOTHING(1)\n"
                                                  "PCALL /_N_WKS_DIR/_N_A_WPD/_N_GONE_SPF(3)\n"
                                                  "CYCLE9777(1)\n"
                                                  "MCALL\n"
                                                  "PCALL /_N_WKS_DIR/_N_A_WPD/_N_UNENDED(3)\n"
                                                  "PCALL /_N_WKS_DIR/_N_A_WPD/_N_AB(3)\n");
  EXPECT_EQ(messagesOf(check(*program, {&library, {}})),
            (std::vector<std::string>{
                "1:1 argument 2 of SUB is missing: the VAR parameter RESULT needs a variable",
                "2:7 argument 2 of SUB: the VAR parameter RESULT needs a variable",
                "3:10 SUB has 2 parameters, but the call has 3 arguments",
                "4:24 the program SUB has no section from BB to AA",
                "5:14 TO expected after the first label",
                "6:7 there is no program and no cycle NOTHING",
                "7:7 there is no program GONE",
                "8:1 there is no program and no cycle CYCLE9777",
                "10:7 there is no program UNENDED",
                "11:7 there is no program AB",
            }));
}

TEST(SinumerikCalls, CalledProgramsAreCheckedToo) {
  Texts library;
  library.add("OUTER", "PROC OUTER\nINNER(1)\nOUTER\nR1=WIDHT\nRET\n");
  library.add("INNER", "PROC INNER(REAL K1)\nRET\n");
  const auto program = SinumerikProgram::fromText("test.mpf", "OUTER\nOUTER\nR1=1+\n");
  std::vector<std::string> places;
  for (const Diagnostic& each : check(*program, {&library, {}}))
    places.push_back(each.place.file + ":" + std::to_string(each.place.line));
  EXPECT_EQ(places, (std::vector<std::string>{"test.mpf:3", "OUTER.SPF:4", "INNER.SPF:1"}));
  World world;
  world.texts.add("INNER", "PROC INNER(REAL K1)\nRET\n");
  const execution::RunResult result = world.tryRun("INNER(1)\n");
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_EQ(result.diagnostics.front().code, "14020");
  EXPECT_NE(result.diagnostics.front().message.find("PROC line of INNER"), std::string::npos);
}

TEST(SinumerikCalls, AMistakeInDefIsSaidOnce) {
  const auto program = SinumerikProgram::fromText("test.mpf", "DEF REAL WIDTH=1, H, DEPTH[2]\nWIDTH=DEPTH[0]\n");
  EXPECT_EQ(messagesOf(check(*program, {})),
            (std::vector<std::string>{"1:19 H cannot name a variable: names begin with two letters or underscores"}));
}

TEST(SinumerikCalls, LabelsAreTheSameInSmallLetters) {
  World world;
  world.run("R1=0\nGOTOF maze_az\nR1=1\nMAZE_AZ: R2=2\n");
  EXPECT_EQ(world.r(1), 0);
  EXPECT_EQ(world.r(2), 2);
  world.run("GOTOF MAZE_AZ\nR2=1\nmaze_az: R2=3\n");
  EXPECT_EQ(world.r(2), 3);
}

TEST(SinumerikCalls, EncryptedProgramsAreNamed) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "SECRET.CPF";
  std::ofstream(path, std::ios::binary) << std::string("Header\0\1\2\3\xfe\xff", 12);
  const auto program = SinumerikProgram::open(path);
  ASSERT_FALSE(program);
  EXPECT_EQ(program.error().place.file, path.string());
  EXPECT_NE(program.error().message.find("encrypted"), std::string::npos);
  EXPECT_FALSE(program.error().advice.empty());
  // One such byte far behind, in a comment, is of a text.
  std::ofstream(path, std::ios::binary) << std::string(5000, ' ') + "\nR1=1 ;\x07 bell\nM30\n";
  EXPECT_TRUE(SinumerikProgram::open(path));
}

}  // namespace
}  // namespace probewright::language::sinumerik
