#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <thread>

#include "app/block_world.hpp"
#include "app/program.hpp"

/// What one run leaves in tables is where the next one begins.
namespace probewright::app::testing {
namespace {

/// The block's setup, the block 0.5 mm aside, beginning from the tables in `tables` unless that is empty.
std::string shiftedBlock(const std::string& tables) {
  std::string text = blockSetup();
  text.replace(text.find("pose = {"), 8, "pose = { x = 0.5,");
  if (!tables.empty()) text.insert(text.find("[part]"), "tables = \"" + tables + "\"\n");
  return text;
}

TEST(RunAfterRun, InspectsWithThePresetThatTheRunBeforeHasSet) {
  const Folder folder;
  const std::string set =
      "0 BEGIN PGM SET MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n"
      "3 TCH PROBE 419 PRESET IN ONE AXIS ~\nQ263=+20 ~\nQ264=+0 ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+30 ~\n"
      "Q272=+1 ~\nQ267=-1 ~\nQ305=+1 ~\nQ333=+20 ~\nQ303=+1\n4 END PGM SET MM\n";
  const auto run = [&](const std::string& name, const std::string& program, const std::string& tables,
                       const std::string& out) {
    return probewright({"run", folder.file(name + ".h", program), "--setup",
                        folder.file(name + ".toml", shiftedBlock(tables)), "--out", (folder / out).string()});
  };
  const std::string inspect = blockProgram("+20.01", "+19.99");
  EXPECT_EQ(run("before", inspect, "", "none").exit, 1) << "the preset of the setup is 0.5 mm off";
  ASSERT_EQ(run("set", set, "", "first").exit, 0);
  const Answer inspected = run("inspect", inspect, "first", "second");
  EXPECT_EQ(inspected.exit, 0) << inspected.errors << inspected.output;
  // And on from there, also in one and the same folder.
  EXPECT_EQ(run("again", inspect, "second", "second").exit, 0);
  EXPECT_EQ(run("again", inspect, "second", "second").exit, 0);
}

TEST(RunAfterRun, FindsToolsOfATableByNumberWhereTheSetupHasNoName) {
  const Folder folder;
  std::filesystem::create_directory(folder / "T");
  folder.file("T/TOOL.T",
              "BEGIN TOOL.T MM\nT     NAME                L           R           TP_NO\n"
              "0     NULLWERKZEUG        +0.0000     +0.0000\n"
              "1     TS460               +100.0000   +3.0000     1\n[END]\n");
  const auto run = [&](const std::string& name, const std::string& program, const std::string& setup) {
    return probewright({"run", folder.file(name + ".h", program), "--setup", folder.file(name + ".toml", setup),
                        "--out", (folder / name).string()});
  };
  std::string unnamed = blockSetup();
  unnamed.insert(unnamed.find("[part]"), "tables = \"T\"\n");
  unnamed.erase(unnamed.find("name = \"PROBE\"\n"), 15);
  const std::string inspect = blockProgram("+20.01", "+19.99");
  const Answer found = run("unnamed", inspect, unnamed);
  EXPECT_EQ(found.exit, 0) << found.errors;
  // Every tool table has a row 0, with a name on most machines: the empty spindle all the same.
  std::string emptied = inspect;
  emptied.insert(emptied.find("1 TOOL CALL 1 Z"), "1 TOOL CALL 1 Z\n1 TOOL CALL 0 Z\n");
  const Answer empty = run("empty", emptied, unnamed);
  EXPECT_EQ(empty.exit, 0) << empty.errors;
  // Two names that contradict each other are not taken for one tool.
  std::string other = blockSetup();
  other.insert(other.find("[part]"), "tables = \"T\"\n");
  const Answer refused = run("other", inspect, other);
  EXPECT_EQ(refused.exit, 3);
  const auto checked = [&](const std::string& name) {
    return probewright({"check", (folder / (name + ".h")).string(), "--setup", (folder / (name + ".toml")).string()});
  };
  EXPECT_THAT(checked("other").errors,
              ::testing::HasSubstr("warning: the control has tool 1, the virtual machine of the setup does not"));
  for (const char* name : {"unnamed", "empty"})
    EXPECT_EQ(checked(name).errors, "") << name;
  EXPECT_THAT(refused.errors, ::testing::HasSubstr("holds no tool \"TS460\"; its tool 1 is \"PROBE\""));
}

TEST(RunAfterRun, TakesTheRowsOfATableInInches) {
  const Folder folder;
  std::filesystem::create_directory(folder / "T");
  folder.file("T/PRESET.PR",
              "BEGIN PRESET.PR INCH\nNO     X              Y              Z\n"
              "0      +0.00000       +0.00000       +0.00000\n1      +1.00000       +0.00000       -10.00000\n[END]\n");
  const std::string world = folder.file("s.toml", R"(
[control]
type = "TNC640"
tables = "T"
[[preset]]
row = 1
origin = [1, 2, 3]
active = true
[[preset]]
row = 4
origin = [4, 5, 6]
)");
  const auto expect = [](const std::string& row, const std::string& value) {
    return "FN 18: SYSREAD Q1 = ID507 NR" + row + " IDX1\nFN 2: Q2 = +Q1 - +" + value +
           "\nFN 12: IF +Q2 LT -0.0001 GOTO LBL 9\nFN 11: IF +Q2 GT +0.0001 GOTO LBL 9\n";
  };
  const std::string text = "0 BEGIN PGM P MM\n" + expect("1", "25.4") + expect("4", "4") +
                           "FN 9: IF +1 EQU +1 GOTO LBL 8\nLBL 9\nFN 14: ERROR = 1000\nLBL 8\n99 END PGM P MM\n";
  const Answer answer =
      probewright({"run", folder.file("p.h", text), "--setup", world, "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 0) << answer.errors << "row 1 is the table's, row 4 the setup's";
}

TEST(RunAfterRun, HandsOnZeroOffsetsToolsAndUserData) {
  const Folder folder;
  const std::string head = "[control]\ntype = \"840Dsl\"\n";
  const std::string beliefs = R"(
[[tool]]
number = 1
kind = "mill"
length = 80
radius = 5
[[zero_offset]]
name = "G54"
origin = [1, 2, 3]
active = true
)";
  const std::string first = folder.file("first.toml", head + beliefs);
  const std::string next = folder.file("next.toml", head + "tables = \"one\"\n" + beliefs);
  const std::string set = folder.file("set.mpf", "$P_UIFR[1,X,TR]=7.25\n$TC_DP3[1,1]=81.5\nR100=4\nM30\n");
  ASSERT_EQ(probewright({"run", set, "--setup", first, "--out", (folder / "one").string()}).exit, 0);
  // A division by zero stops the run.
  const std::string read = folder.file(
      "read.mpf",
      "IF ($P_UIFR[1,X,TR]<>7.25) OR ($P_UIFR[1,Y,TR]<>2) OR ($TC_DP3[1,1]<>81.5) OR (R100<>4)\nR1=1/0\nENDIF\nM30\n");
  const Answer answer = probewright({"run", read, "--setup", next, "--out", (folder / "two").string()});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_EQ(probewright({"run", read, "--setup", first, "--out", (folder / "three").string()}).exit, 3);
}

/// Held as a run holds a folder while it writes or reads there.
class Held {
public:
  Held(const std::filesystem::path& folder, int how)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    EXPECT_EQ(::flock(descriptor_, how), 0);
  }
  ~Held() { ::close(descriptor_); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

private:
  int descriptor_;
};

TEST(RunAfterRun, WaitsForTablesThatAnotherRunReplaces) {
  using namespace std::chrono_literals;
  const Folder folder;
  std::filesystem::create_directory(folder / "T");
  const auto presets = [&](const std::string& x) {
    folder.file("T/PRESET.PR", "BEGIN PRESET.PR MM\nNO     X              Y              Z\n1      " + x +
                                   "        +0.0000        +0.0000\n[END]\n");
  };
  const std::string program = folder.file(
      "a.h",
      "0 BEGIN PGM A MM\n1 FN 18: SYSREAD Q1 = ID507 NR1 IDX1\n2 FN 38: SEND / \"X IS %F\" / +Q1\n3 END PGM A MM\n");
  const auto begin = [&](const std::string& out) {
    const std::string world =
        folder.file("s.toml", "[control]\ntype = \"TNC640\"\ntables = \"T\"\n[[preset]]\nrow = 1\nactive = true\n");
    return std::async(std::launch::async, [=, path = (folder / out).string()] {
      return probewright({"run", program, "--setup", world, "--out", path});
    });
  };
  presets("+1.0000");
  std::future<Answer> reader;
  {
    const Held writer(folder / "T", LOCK_EX);
    reader = begin("out");
    EXPECT_EQ(reader.wait_for(500ms), std::future_status::timeout);
    presets("+7.0000");
  }
  const Answer read = reader.get();
  EXPECT_EQ(read.exit, 0) << read.errors;
  EXPECT_THAT(read.output, ::testing::HasSubstr("X IS 7.000"));
  // Who reads holds off who writes, but not other readers.
  const auto written = std::filesystem::last_write_time(folder / "out/results.json");
  std::future<Answer> replacing;
  {
    const Held other(folder / "out", LOCK_SH), same(folder / "T", LOCK_SH);
    replacing = begin("out");
    EXPECT_EQ(replacing.wait_for(500ms), std::future_status::timeout);
    EXPECT_EQ(std::filesystem::last_write_time(folder / "out/results.json"), written);
  }
  const Answer replaced = replacing.get();
  EXPECT_EQ(replaced.exit, 0) << replaced.errors;
  EXPECT_NE(std::filesystem::last_write_time(folder / "out/results.json"), written);
}

}  // namespace
}  // namespace probewright::app::testing
