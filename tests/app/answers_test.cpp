#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>

#include "app/block_world.hpp"
#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// Feels the front of the block, whose place the program does not know; it wishes it at Y-14.
const std::string program =
    "0 BEGIN PGM EDGE MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n3 TCH PROBE 1410 EDGE ~\nQS1100=\"?\" ~\nQS1101=\"?-14\" "
    "~\n"
    "QS1102=\"?\" ~\nQS1103=\"?\" ~\nQS1104=\"?-14\" ~\nQS1105=\"?\" ~\nQ372=+2 ~\nQ320=+0 ~\nQ260=+40 ~\nQ1125=+0 ~\n"
    "Q309=+0 ~\nQ1126=+0 ~\nQ1120=+1 ~\nQ1121=+0\n4 END PGM EDGE MM\n";

const std::string answers =
    "[answers]\n\"1410 point 1\" = \"-10 -22 20; -10 -22 -8\"\n\"1410 point 2\" = \"10 -22 20; 10 -22 -8\"\n";

/// Runs the program with this setup and, if there are any, these answers of a file.
Answer runEdge(const Folder& folder, const std::string& setup, const std::string& file = {}) {
  std::vector<std::string> words = {"run",   folder.file("EDGE.H", program), "--setup", folder.file("edge.toml", setup),
                                    "--out", (folder / "out").string()};
  if (!file.empty()) words.insert(words.end(), {"--answers", folder.file("ANSWERS.TXT", file)});
  return probewright(words);
}

double found(const Folder& folder, const std::string& name) {
  const json results = json::parse(textOf(folder / "out/results.json"));
  for (const json& result : results["cycles"].at(0)["results"]) {
    if (result["name"] == name) return result["value"];
  }
  ADD_FAILURE() << "no result " << name;
  return 0;
}

TEST(RunAnswers, ComeFromTheSetupAndTheFileGoesBeforeIt) {
  const Folder folder;
  const Answer ofSetup = runEdge(folder, blockSetup(answers));
  ASSERT_EQ(ofSetup.exit, 0) << ofSetup.errors << ofSetup.output;
  EXPECT_NEAR(found(folder, "Q950"), -10, 1e-6);
  EXPECT_NEAR(found(folder, "Q951"), -15, 1e-6);
  EXPECT_NEAR(found(folder, "Q953"), 10, 1e-6);
  EXPECT_NEAR(found(folder, "Q981"), -1, 1e-6);
  const Answer ofBoth = runEdge(folder, blockSetup(answers), "1410 point 1 = 5 -22 20; 5 -22 -8\n");
  ASSERT_EQ(ofBoth.exit, 0) << ofBoth.errors;
  EXPECT_NEAR(found(folder, "Q950"), 5, 1e-6);
  EXPECT_NEAR(found(folder, "Q953"), 10, 1e-6);
}

/// Runs the program at a terminal of its own, on which these lines are typed.
/// Whatever is typed is there before the program asks, but for Ctrl-C: that comes once it has said `question`.
Answer onTerminal(std::vector<std::string> words, const std::string& typed, const std::string& question = {}) {
  words.insert(words.begin(), PROBEWRIGHT_PROGRAM);
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  EXPECT_GT(child, 0);
  EXPECT_EQ(write(terminal, typed.data(), typed.size()), static_cast<ssize_t>(typed.size()));
  Answer seen;
  std::array<char, 4096> part{};
  bool interrupted = question.empty();
  for (ssize_t count = 0; (count = read(terminal, part.data(), part.size())) > 0;) {
    seen.output.append(part.data(), static_cast<std::size_t>(count));
    if (interrupted || seen.output.find(question) == std::string::npos) continue;
    interrupted = true;
    EXPECT_EQ(write(terminal, "\x03", 1), 1);
  }
  close(terminal);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  if (WIFEXITED(status)) seen.exit = WEXITSTATUS(status);
  return seen;
}

TEST(RunAnswers, AreAskedForOnTheTerminal) {
  const Folder folder;
  const std::vector<std::string> words = {"run",     folder.file("EDGE.H", program),
                                          "--setup", folder.file("edge.toml", blockSetup()),
                                          "--out",   (folder / "out").string()};
  // What is no position is asked for again.
  const std::string seen =
      onTerminal(words, "over there\n-10 -22\n-10 -22 20; -10 -22 -8\n10 -22 20; 10,-22,-8 Z\n10 -22 20; 10,-22,-8\n")
          .output;
  EXPECT_THAT(seen, HasSubstr("1410 point 1: "));
  EXPECT_THAT(seen, HasSubstr("1410 point 2: "));
  EXPECT_NEAR(found(folder, "Q950"), -10, 1e-6);
  EXPECT_NEAR(found(folder, "Q981"), -1, 1e-6);
  // With --on-stop ask the dialog comes first.
  std::vector<std::string> asking = words;
  asking.insert(asking.end(), {"--on-stop", "ask"});
  const std::string dialog = onTerminal(asking, "y\n-10 -22 20; -10 -22 -8\ny\n10 -22 20; 10 -22 -8\n").output;
  EXPECT_THAT(dialog, HasSubstr("move the probe in front of the point, probing direction Y+, then NC start"));
  EXPECT_THAT(dialog, HasSubstr("Continue? [Y/n]"));
  EXPECT_THAT(seen, HasSubstr("\"-10 -22\" cannot be read as an answer"));
}

TEST(RunAnswers, CtrlCEndsTheRunAlsoWhereAnAnswerIsWaitedFor) {
  const Folder folder;
  std::vector<std::string> words = {"run",     folder.file("EDGE.H", program),
                                    "--setup", folder.file("edge.toml", blockSetup()),
                                    "--out",   (folder / "out").string()};
  const Answer first = onTerminal(words, "-10 -22 20; -10 -22 -8\n", "1410 point 2: position");
  EXPECT_EQ(first.exit, 3);
  EXPECT_THAT(first.output, HasSubstr("the run was interrupted at this block"));
  EXPECT_THAT(first.output, HasSubstr("1 touch"));
  EXPECT_THAT(first.output, Not(HasSubstr("without operator")));
  words.insert(words.end(), {"--on-stop", "ask"});
  const Answer dialog = onTerminal(words, "", "Continue? [Y/n]");
  EXPECT_EQ(dialog.exit, 3);
  EXPECT_THAT(dialog.output, HasSubstr("the run was interrupted at this block"));
}

/// Q1125 = 1 and 2 are ignored after probing by hand, 0 is not: the way over the block is free, as it is not with -1.
TEST(RunAnswers, LeaveTheWayToTheClearanceHeightAtTheEndOfTheCycle) {
  const Folder folder;
  const std::string over = "4 L X+0 Y+0 R0 FMAX\n5 END";
  for (const auto& [mode, exit] : {std::pair("+0", 0), std::pair("-1", 3), std::pair("+1", 3)}) {
    std::string text = program;
    text.replace(text.find("4 END"), 5, over);
    text.replace(text.find("Q1125=+0"), 8, std::string("Q1125=") + mode);
    const Answer ran = probewright({"run", folder.file("OVER.H", text), "--setup",
                                    folder.file("edge.toml", blockSetup(answers)), "--out", (folder / "out").string()});
    EXPECT_EQ(ran.exit, exit) << mode << ran.output << ran.errors;
  }
}

TEST(RunAnswers, SayWhetherAStopIsTheEnd) {
  const Folder folder;
  const std::vector<std::string> words = {
      "run",       folder.file("STOP.H", "0 BEGIN PGM STOP MM\n1 STOP\n2 STOP\n3 END PGM STOP MM\n"),
      "--setup",   folder.file("edge.toml", blockSetup()),
      "--out",     (folder / "out").string(),
      "--on-stop", "ask"};
  EXPECT_EQ(onTerminal(words, "y\n\n").exit, 0) << "the enter key is NC start";
  const Answer wondering = onTerminal(words, "perhaps\ny\nn\n");
  EXPECT_EQ(wondering.exit, 3);
  EXPECT_THAT(wondering.output, HasSubstr("y or n?"));
  EXPECT_THAT(wondering.output, HasSubstr("was not continued"));
  EXPECT_EQ(probewright(words).exit, 3) << "nobody sits there";
}

TEST(RunAnswers, AreMissedByName) {
  const Folder folder;
  const Answer nobody = runEdge(folder, blockSetup());
  EXPECT_EQ(nobody.exit, 3);
  EXPECT_THAT(nobody.errors, HasSubstr("Semi-automatic probing without operator"));
  EXPECT_THAT(nobody.errors, HasSubstr("'1410 point 1 = MAIN MINOR TOOL'"));
  const Answer half = runEdge(folder, blockSetup(), "1410 point 1 = -10 -22 20; -10 -22 -8\n");
  EXPECT_EQ(half.exit, 3);
  EXPECT_THAT(half.errors, HasSubstr("'1410 point 2 = MAIN MINOR TOOL'"));
  const Answer wrong = runEdge(folder, blockSetup("[answers]\n\"1410 point 1\" = 5\n"));
  EXPECT_EQ(wrong.exit, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("\"1410 point 1\" in [answers] must be a text"));
}

}  // namespace
}  // namespace probewright::app::testing
