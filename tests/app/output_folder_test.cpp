#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <openssl/evp.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/block_world.hpp"
#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

const std::string program = "examples/programs/housing.h";
const std::string setup = "examples/setups/housing-tnc640.toml";

const std::string loggedProgram = blockProgram("+0", "+0", 1);

/// SHA-256 in hexadecimal digits.
std::string checksumOf(const std::string& path) {
  const std::string bytes = textOf(path);
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr);
  std::string text;
  for (unsigned int i = 0; i < size; ++i)
    text += fmt::format("{:02x}", digest[i]);
  return text;
}

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

/// Whether a report of an earlier run is still the one that it left is asked without holding it in memory.
TEST(OutputFolder, ChecksLargeFilesPieceByPiece) {
  const Folder folder;
  const std::filesystem::path out = folder / "out", report = out / "report.html";
  std::filesystem::create_directory(out);
  folder.file("out/report.html", "");
  std::filesystem::resize_file(report, std::uintmax_t{120} << 20U);  // zeros
  const auto list = [&](const std::string& checksum) {
    folder.file("out/.probewright.json", json{{"title", "the files of a Probewright run and their SHA-256"},
                                              {"files", {{"report.html", checksum}}}}
                                             .dump());
  };
  const std::vector<std::string> words = {
      "run", folder.file("a.mpf", "M30\n"), "--setup", "examples/setups/housing-840dsl.toml", "--out", out.string()};
  list("5c4fb902a2d45300919e27920c96fa090d0a3e42f7ee8e778ca852a30a2905b3");
  const Answer other = probewright(words);
  EXPECT_EQ(other.exit, 2);
  EXPECT_EQ(std::filesystem::file_size(report), std::uintmax_t{120} << 20U);
  list("5c4fb902a2d45300919e27920c96fa090d0a3e42f7ee8e778ca852a30a2905b2");
  const Answer same = probewright(words);
  EXPECT_EQ(same.exit, 0) << same.errors;
  EXPECT_LT(std::filesystem::file_size(report), std::uintmax_t{10} << 20U);
  EXPECT_LT(same.peakMegabytes, 110);
  EXPECT_LT(other.peakMegabytes, 110);
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

/// All that is in a folder and below it.
std::vector<std::string> allIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    names.push_back(entry.path().lexically_relative(folder).string());
  std::ranges::sort(names);
  return names;
}

/// A machine adapter that leaves a file as soon as somebody starts it.
std::string notingAdapter(const Folder& folder) {
  const std::string path = folder.file(
      "adapter", "#!/bin/sh\ntouch '" + (folder / "started").string() + "'\nexec examples/adapters/plane.py\n");
  std::filesystem::permissions(path, std::filesystem::perms(0755));
  return path;
}

TEST(OutputFolder, RefusesAFolderItCannotWriteToBeforeAnythingMoves) {
  namespace fs = std::filesystem;
  const Folder folder;
  const std::string path = folder.file("a.h", "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 L Z-150 R0 FMAX\n3 END PGM A MM\n");
  const std::string world = folder.file(
      "s.toml",
      "[control]\ntype = \"TNC640\"\n[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 100\nball_radius = 3\n");
  const std::string adapter = notingAdapter(folder);
  for (const char* name : {"locked", "above", "above/inside"})
    fs::create_directory(folder / name);
  folder.file("locked/mine.txt", "mine");
  folder.file("file", "kept");
  for (const char* name : {"locked", "above"})
    fs::permissions(folder / name, fs::perms(0555));
  const auto before = allIn(folder / "");
  const auto run = [&](const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> words = {"run", path, "--setup", world, "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    return probewrightOfAUser(words);
  };
  const std::string absolute = (folder / "").string();
  for (const auto& [out, what] : {std::pair{"locked", "cannot write into this folder: Permission denied"},
                                  {"above/missing", "Permission denied"},
                                  {"above/missing/too/far", "Permission denied"},
                                  {"file", "a file has its name"},
                                  {"file/out", "Not a directory"},
                                  {"file/out/deeper", "Not a directory"}}) {
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--machine", adapter}, {}, {"--blind"}}) {
      const Answer answer = run(absolute + out, more);
      EXPECT_EQ(answer.exit, 2) << out;
      EXPECT_THAT(answer.errors, HasSubstr(what)) << out;
      EXPECT_THAT(answer.errors, HasSubstr("--out")) << out;
      EXPECT_EQ(messages(answer.errors), 1U) << answer.errors;
      EXPECT_EQ(allIn(folder / ""), before) << out;
    }
  }
  // The record of many runs is known as early.
  for (const char* record : {"above/record.csv", "file", "a.h/record.csv"}) {
    const Answer answer = run(absolute + "out", {"--machine", adapter, "--append", absolute + record});
    EXPECT_EQ(answer.exit, 2) << record;
    EXPECT_THAT(answer.errors, HasSubstr("--append")) << record;
    EXPECT_EQ(allIn(folder / ""), before) << record;
  }
  // What can be written is: folders that are missing are made, and inside of a folder that nobody else can change.
  for (const char* out : {"above/inside", "new/and/deeper"}) {
    const Answer answer = run(absolute + out, {"--machine", adapter});
    EXPECT_EQ(answer.exit, 0) << answer.errors;
    EXPECT_TRUE(fs::exists(folder / out / "results.json")) << out;
    EXPECT_TRUE(fs::remove(folder / "started")) << "the machine";
  }
  EXPECT_EQ(namesIn(folder / "above"), std::vector<std::string>{"inside"});
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
  EXPECT_THAT(namesIn(folder / "out"), ::testing::ElementsAre(".probewright.json", "PRESET.PR", "TCHPROBE.TP", "TOOL.T",
                                                              "mine.txt", "report.html", "results.json"));

  // A program that cannot be read: no result may look like its own.
  ASSERT_EQ(run("c.h", "0 BEGIN PGM C MM\n1 FOO\n2 END PGM C MM\n").exit, 2);
  EXPECT_THAT(namesIn(folder / "out"), ::testing::ElementsAre("mine.txt"));
}

TEST(OutputFolder, KeepsTheTablesItBeginsFromWhenAProgramIsWrong) {
  const Folder folder;
  const std::string first = folder.file("first.toml", blockSetup());
  const std::string out = (folder / "out").string();
  ASSERT_EQ(probewright({"run", folder.file("a.h", loggedProgram), "--setup", first, "--out", out}).exit, 0);
  std::string next = blockSetup();
  next.insert(next.find("[part]"), "tables = \"out\"\n");
  const std::string wrong = folder.file("b.h", "0 BEGIN PGM B MM\n1 FOO\n2 END PGM B MM\n");
  const Answer answer = probewright({"run", wrong, "--setup", folder.file("next.toml", next), "--out", out});
  ASSERT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("b.h:2"));
  EXPECT_THAT(namesIn(folder / "out"), IsSupersetOf({"PRESET.PR", "TOOL.T"}));
  EXPECT_THAT(namesIn(folder / "out"), Not(::testing::Contains("results.json")));
}

/// The first of the runs that each begin with what the one before has left.
TEST(OutputFolder, MayBeMissingAsTheTablesOfTheRunThatMakesIt) {
  const Folder folder;
  const std::string out = (folder / "deep/out").string();
  const auto setupWith = [&](const std::string& name, const std::string& tables) {
    std::string text = blockSetup();
    text.insert(text.find("[part]"), "tables = \"" + tables + "\"\n");
    return folder.file(name, text);
  };
  const std::string own = setupWith("own.toml", "deep/../deep/out"), typo = setupWith("typo.toml", "deep/uot");
  const std::string path = folder.file(
      "a.h",
      "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 L X+0 Y+0 Z+50 R0 FMAX\n3 TCH PROBE 417 PRESET IN TS AXIS ~\nQ263=+0 ~\n"
      "Q264=+0 ~\nQ294=+0 ~\nQ320=+0 ~\nQ260=+20 ~\nQ305=+20 ~\nQ333=-7.25 ~\nQ303=+1\n4 END PGM A MM\n");
  const std::string empty = folder.file("b.h", "0 BEGIN PGM B MM\n1 END PGM B MM\n");
  // A preview leaves nothing, not even the folder.
  const Answer preview = probewright({"run", path, "--setup", own, "--out", out, "--preview"});
  EXPECT_EQ(preview.exit, 0) << preview.errors;
  EXPECT_EQ(namesIn(folder / ""), (std::vector<std::string>{"a.h", "b.h", "own.toml", "typo.toml"}));

  const Answer first = probewright({"run", path, "--setup", own, "--out", out});
  EXPECT_EQ(first.exit, 0) << first.errors;
  EXPECT_THAT(first.errors, ::testing::ContainsRegex("own.toml:4:.* note: there is no folder .*deep/out\" yet"));
  const std::string tables = textOf(folder / "deep/out/PRESET.PR");
  EXPECT_THAT(tables, ::testing::ContainsRegex("\n *20 [^\n]*-472\\.75"));
  const Answer second = probewright({"run", empty, "--setup", own, "--out", out});
  EXPECT_EQ(second.exit, 0) << second.errors;
  EXPECT_EQ(second.errors, "");
  EXPECT_EQ(textOf(folder / "deep/out/PRESET.PR"), tables) << "what the first run has found";
  // A preview of a later run begins with the tables and leaves them alone, as it does with everything else.
  const auto before = allIn(folder / "");
  folder.file("wrong.h", "0 BEGIN PGM B MM\n1 FOO\n2 END PGM B MM\n");
  EXPECT_EQ(probewright({"run", (folder / "wrong.h").string(), "--setup", own, "--out", out, "--preview"}).exit, 2);
  std::filesystem::remove(folder / "wrong.h");
  EXPECT_EQ(allIn(folder / ""), before);

  for (const auto& [world, elsewhere] :
       {std::pair{typo, out}, {typo, (folder / "deep").string()}, {own, (folder / "other").string()}}) {
    std::filesystem::remove_all(folder / "deep");
    const Answer answer = probewright({"run", path, "--setup", world, "--out", elsewhere});
    EXPECT_EQ(answer.exit, 2) << elsewhere;
    EXPECT_THAT(answer.errors, HasSubstr("error: there is no folder"));
  }
}

TEST(OutputFolder, KeepsWhatAListNamesThatCameFromElsewhere) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  std::filesystem::create_directory(folder / "out");
  folder.file("outside.txt", "kept");
  folder.file("out/thesis.txt", "mine");
  const std::string path = folder.file("out/a.h", loggedProgram);
  const std::string names = R"("../outside.txt", ".", "", 7, "thesis.txt", "a.h")";
  folder.file("out/results.json", R"({"schema": "probewright results", "files": [)" + names + "]}");
  const std::string checksum(64, '0');
  folder.file("out/.probewright.json",
              R"({"title": "the files of a Probewright run and their SHA-256", "files": {"../outside.txt": ")" +
                  checksum + R"(", "thesis.txt": ")" + checksum + R"(", "a.h": 7}})");
  const auto before = namesIn(folder / "out");
  const std::string out = (folder / "out").string();
  // results.json is somebody else's: nothing is written over it.
  const Answer answer = probewright({"run", path, "--setup", world, "--out", out});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("out/results.json: error: this file is not one that an earlier run left"));
  EXPECT_EQ(namesIn(folder / "out"), before);
  // Nor does a program with a mistake take anything along.
  ASSERT_EQ(probewright({"run", folder.file("b.h", "nothing\n"), "--setup", world, "--out", out}).exit, 2);
  EXPECT_EQ(namesIn(folder / "out"), before);
  EXPECT_EQ(textOf(folder / "outside.txt"), "kept");
  EXPECT_EQ(textOf(folder / "out/thesis.txt"), "mine");
}

TEST(OutputFolder, KeepsTheInputsOfTheRunEvenIfTheListNamesThem) {
  // The very folder that everything lies in, and a list with the right checksum of program and setup.
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  const std::string path = folder.file("a.h", loggedProgram);
  ASSERT_EQ(probewright({"run", path, "--setup", world, "--out", (folder / "").string()}).exit, 0);
  EXPECT_EQ(textOf(path), loggedProgram);
  json list = json::parse(textOf(folder / ".probewright.json"));
  list["files"]["a.h"] = checksumOf(path);
  list["files"]["block.toml"] = checksumOf(world);
  folder.file(".probewright.json", list.dump());
  const Answer answer = probewright({"run", path, "--setup", world, "--out", (folder / "").string()});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_EQ(textOf(path), loggedProgram);
  EXPECT_EQ(textOf(world), blockSetup());
}

TEST(OutputFolder, KeepsAFileThatWasChangedSince) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  const std::string out = (folder / "out").string();
  const auto run = [&](const std::string& text) {
    return probewright({"run", folder.file("a.h", text), "--setup", world, "--out", out});
  };
  ASSERT_EQ(run(loggedProgram).exit, 0);
  folder.file("out/TCHPR427.TXT", "with my notes");
  // A program that leaves no log removes none that is no longer its own.
  ASSERT_EQ(run("0 BEGIN PGM A MM\n1 END PGM A MM\n").exit, 0);
  EXPECT_EQ(textOf(folder / "out/TCHPR427.TXT"), "with my notes");
  // One that leaves a log of this name is stopped where it does.
  const Answer answer = run(loggedProgram);
  EXPECT_EQ(answer.exit, 3);
  EXPECT_THAT(answer.errors, HasSubstr("a.h:4:"));
  EXPECT_THAT(answer.errors, HasSubstr("The file \"TCHPR427.TXT\" cannot be written"));
  EXPECT_EQ(textOf(folder / "out/TCHPR427.TXT"), "with my notes");
  // And the tables stand for all of them: nothing begins that could not be written at its end.
  folder.file("out/PRESET.PR", "mine");
  const Answer refused = run(loggedProgram);
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, HasSubstr("out/PRESET.PR: error: this file is not one that an earlier run left"));
  EXPECT_EQ(textOf(folder / "out/PRESET.PR"), "mine");
}

TEST(OutputFolder, KeepsTheTablesOfTheUser) {
  const Folder folder;
  const std::string begin = folder.file("begin.toml", blockSetup());
  const std::string made = (folder / "made").string();
  ASSERT_EQ(probewright({"run", folder.file("a.h", loggedProgram), "--setup", begin, "--out", made}).exit, 0);
  std::filesystem::create_directory(folder / "T");
  for (const char* name : {"TOOL.T", "PRESET.PR", "TCHPROBE.TP"})
    std::filesystem::copy(folder / "made" / name, folder / "T" / name);
  const std::string begun = folder.file(
      "with.toml", "[control]\ntype = \"TNC640\"\ntables = \"T\"\n" + blockSetup().substr(blockSetup().find("[part]")));
  const std::string table = textOf(folder / "T/PRESET.PR");
  const std::string tables = (folder / "T").string();
  const auto before = namesIn(folder / "T");
  EXPECT_EQ(probewright({"run", folder.file("a.h", loggedProgram), "--setup", begun, "--out", tables}).exit, 2);
  EXPECT_EQ(probewright({"run", folder.file("b.h", "nothing\n"), "--setup", begin, "--out", tables}).exit, 2);
  EXPECT_EQ(namesIn(folder / "T"), before);
  EXPECT_EQ(textOf(folder / "T/PRESET.PR"), table);
}

TEST(OutputFolder, KeepsTheDefinitionFilesOfTheUser) {
  const Folder folder;
  std::filesystem::create_directory(folder / "T");
  folder.file("T/UGUD.DEF", "DEF NCK REAL _MINE\nM17\n");
  const std::string world = folder.file("s.toml", "[control]\ntype = \"840Dsl\"\ntables = \"T\"\n");
  const std::string tables = (folder / "T").string();
  const std::string first = folder.file("a.mpf", "_MINE=3\nM30\n");
  const Answer answer = probewright({"run", first, "--setup", world, "--out", tables});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_EQ(probewright({"run", folder.file("b.mpf", "FOO BAR\n"), "--setup", world, "--out", tables}).exit, 2);
  const std::string other = folder.file("t.toml", "[control]\ntype = \"TNC640\"\n");
  EXPECT_EQ(
      probewright({"run", folder.file("c.h", "0 BEGIN PGM C MM\n1 END PGM C MM\n"), "--setup", other, "--out", tables})
          .exit,
      0);
  EXPECT_EQ(textOf(folder / "T/UGUD.DEF"), "DEF NCK REAL _MINE\nM17\n");
}

struct Target {
  std::string name, reason;
};

TEST(OutputFolder, LetsNoProgramWriteOverOtherFiles) {
  // By FN 16 and by WRITE: the run's own files, the program, the setup, what is not a name of a file.
  const std::vector<Target> targets = {{"PRESET.PR", "The run writes"},
                                       {"report.html", "The run writes"},
                                       {"Results.JSON", "The run writes"},
                                       {"p.h", "is read by this run"},
                                       {"s.toml", "is read by this run"},
                                       {"mine.txt", "not one that an earlier run left"},
                                       {"..", ""},
                                       {std::string(300, 'X'), ""}};
  for (const auto& [name, reason] : targets) {
    const Folder folder;
    const std::string world = folder.file("s.toml", blockSetup());
    folder.file("M.A", "\"X\";\n");
    folder.file("mine.txt", "mine");
    const std::string text = "0 BEGIN PGM P MM\n1 FN 16: F-PRINT M.A / " + name + "\n2 END PGM P MM\n";
    const std::string path = folder.file("p.h", text);
    const Answer answer = probewright({"run", path, "--setup", world, "--out", (folder / "").string()});
    EXPECT_EQ(answer.exit, 3) << name << answer.errors;
    EXPECT_THAT(answer.errors, HasSubstr("p.h:2:")) << name;
    if (!reason.empty()) {
      EXPECT_THAT(answer.errors, HasSubstr(reason)) << name;
    }
    EXPECT_EQ(textOf(folder / "mine.txt"), "mine");
    EXPECT_EQ(textOf(path), text);
    EXPECT_EQ(textOf(world), blockSetup());
  }
  const Folder folder;
  const std::string world = folder.file("s.toml", "[control]\ntype = \"840Dsl\"\n");
  const std::string text = "DEF INT ERR\nWRITE(ERR,\"p.mpf\",\"X\")\nM30\n";
  const std::string path = folder.file("p.mpf", text);
  const Answer answer = probewright({"run", path, "--setup", world, "--out", (folder / "").string()});
  EXPECT_EQ(answer.exit, 3) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr("p.mpf:2:"));
  EXPECT_EQ(textOf(path), text);
}

TEST(OutputFolder, SaysWhatIsWrongWithItsName) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup()), path = folder.file("a.h", loggedProgram);
  std::filesystem::create_symlink("nowhere", folder / "link");
  const auto errors = [&](const std::string& out) {
    const Answer answer = probewright({"run", path, "--setup", world, "--out", out});
    EXPECT_EQ(answer.exit, 2);
    return answer.errors;
  };
  EXPECT_THAT(errors((folder / "link").string()), HasSubstr("a symbolic link that leads nowhere"));
  EXPECT_THAT(errors(""), HasSubstr("its name is empty"));
  EXPECT_THAT(errors(path), HasSubstr("--out"));
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
