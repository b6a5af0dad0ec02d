#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/block_world.hpp"
#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

const std::string program = "examples/programs/housing.h";
const std::string setup = "examples/setups/housing-tnc640.toml";

const std::string loggedProgram = blockProgram("+0", "+0", 1);

TEST(OutputFolder, HoldsNoFileThatTheProgramHasDeleted) {
  const Folder folder;
  const std::string text =
      "DEF INT ERR\nWRITE(ERR,\"NOTE\",\"A\")\nWRITE(ERR,\"KEPT\",\"B\")\nDELETE(ERR,\"NOTE\")\nM30\n";
  const Answer answer = probewright({"run", folder.file("a.mpf", text), "--setup",
                                     "examples/setups/housing-840dsl.toml", "--out", (folder / "out").string()});
  ASSERT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_EQ(textOf(folder / "out/KEPT"), "B\n");
  EXPECT_THAT(namesIn(folder / "out"), Not(::testing::Contains("NOTE")));
}

TEST(OutputFolder, RefusesAFolderItCannotWriteTo) {
  const Folder folder;
  const std::string file = folder.file("file", "kept");
  const Answer answer = probewright({"run", program, "--setup", setup, "--out", file + "/out"});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("--out"));
  EXPECT_EQ(messages(answer.errors), 1U) << answer.errors;
  EXPECT_EQ(textOf(file), "kept");
}

TEST(OutputFolder, LeavesNothingOfAnEarlierRun) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  const auto run = [&](const std::string& name, const std::string& text) {
    return probewright({"run", folder.file(name, text), "--setup", world, "--out", (folder / "out").string()});
  };
  ASSERT_EQ(run("a.h", loggedProgram).exit, 0);
  folder.file("out/mine.txt", "kept");
  EXPECT_THAT(namesIn(folder / "out"), IsSupersetOf({"TCHPR427.TXT", "results.json", "report.html"}));

  // Another program in the same folder: the log of the first is gone, and what somebody put there is not.
  ASSERT_EQ(run("b.h", "0 BEGIN PGM B MM\n1 END PGM B MM\n").exit, 0);
  EXPECT_THAT(namesIn(folder / "out"),
              ::testing::ElementsAre("PRESET.PR", "TCHPROBE.TP", "TOOL.T", "mine.txt", "report.html", "results.json"));

  // A program that cannot be read: no result may look like its own.
  ASSERT_EQ(run("c.h", "0 BEGIN PGM C MM\n1 FOO\n2 END PGM C MM\n").exit, 2);
  EXPECT_THAT(namesIn(folder / "out"), ::testing::ElementsAre("mine.txt"));
}

TEST(OutputFolder, KeepsTheTablesItBeginsFromWhenAProgramIsWrong) {
  const Folder folder;
  const std::string first = folder.file("first.toml", blockSetup());
  const std::string out = (folder / "out").string();
  ASSERT_EQ(probewright({"run", folder.file("a.h", loggedProgram), "--setup", first, "--out", out}).exit, 0);
  const std::string next = folder.file("next.toml", "tables = \"out\"\n" + blockSetup());
  const std::string wrong = folder.file("b.h", "0 BEGIN PGM B MM\n1 FOO\n2 END PGM B MM\n");
  ASSERT_EQ(probewright({"run", wrong, "--setup", next, "--out", out}).exit, 2);
  EXPECT_THAT(namesIn(folder / "out"), IsSupersetOf({"PRESET.PR", "TOOL.T"}));
  EXPECT_THAT(namesIn(folder / "out"), Not(::testing::Contains("results.json")));
}

TEST(OutputFolder, RemovesOnlyPlainFilesThatItsResultsList) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  std::filesystem::create_directory(folder / "out");
  folder.file("outside.txt", "kept");
  folder.file("out/results.json",
              R"({"schema": "probewright results", "files": ["../outside.txt", ".", "", 7, "LOG.TXT"]})");
  folder.file("out/LOG.TXT", "old");
  const std::string out = (folder / "out").string();
  ASSERT_EQ(probewright({"run", folder.file("a.h", loggedProgram), "--setup", world, "--out", out}).exit, 0);
  EXPECT_EQ(textOf(folder / "outside.txt"), "kept");
  EXPECT_THAT(namesIn(folder / "out"), Not(::testing::Contains("LOG.TXT")));
  // Somebody else's file of that name.
  folder.file("out/results.json", R"({"files": ["TOOL.T"]})");
  ASSERT_EQ(probewright({"run", folder.file("b.h", "nothing\n"), "--setup", world, "--out", out}).exit, 2);
  EXPECT_THAT(namesIn(folder / "out"), IsSupersetOf({"TOOL.T", "results.json"}));
}

TEST(OutputFolder, WritesAllFilesOrNone) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  const std::string out = (folder / "out").string();
  std::filesystem::create_directories(folder / "out/report.html");  // a folder: no file can have its name
  const Answer answer = probewright({"run", folder.file("a.h", loggedProgram), "--setup", world, "--out", out});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("report.html: error: cannot write this file"));
  EXPECT_THAT(namesIn(folder / "out"), ::testing::ElementsAre("report.html"));
}

}  // namespace
}  // namespace probewright::app::testing
