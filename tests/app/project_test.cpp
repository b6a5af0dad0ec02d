#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <thread>

#include "app/program.hpp"

/// Many runs: projects and records.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string root = PROBEWRIGHT_SOURCE_DIR;
const std::string cookbook = root + "/examples/cookbook/";

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

TEST(Projects, BeginEachProgramWithTheTablesOfTheOneBefore) {
  const Folder folder;
  const auto out = folder / "out";
  const Answer answer = probewright({"project", cookbook + "plate-project.toml", "--out", out.string()});
  // The bore of 40.012 is good, and where the preset that the first program has set says.
  EXPECT_EQ(answer.exit, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("Plate, set up and inspected\n"));
  EXPECT_THAT(answer.output, HasSubstr("   1  set-up.h                         good "));
  EXPECT_THAT(answer.output, HasSubstr("   2  inspect.h                        good "));
  EXPECT_THAT(answer.output, HasSubstr("Q151      actual centre, main axis                         60.0000 mm"));
  const std::vector<std::string> rows = linesOf(textOf(out / "project.csv"));
  EXPECT_EQ(std::ranges::count_if(rows, [](const std::string& row) { return row.find(",inspect.h,") != row.npos; }), 3);
  // Once more: the values of this run only.
  EXPECT_EQ(probewright({"project", cookbook + "plate-project.toml", "--out", out.string()}).exit, 0);
  EXPECT_EQ(linesOf(textOf(out / "project.csv")).size(), rows.size());
}

TEST(Projects, TakeTheTablesOfTheSetupWhereTheySaySo) {
  // Without the preset of the first program the bore is not where the second looks for it.
  const Folder folder;
  const std::string setup = cookbook + "set-up.toml";
  const std::string file =
      folder.file("job.toml", "[[run]]\nprogram = \"" + cookbook + "set-up.h\"\nsetup = \"" + setup +
                                  "\"\n[[run]]\nprogram = \"" + cookbook + "inspect.h\"\ntables = \"setup\"\n");
  const Answer answer = probewright({"project", file, "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 1) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("job\n"));
  EXPECT_THAT(answer.output, HasSubstr("inspect.h                        out of tolerance"));
}

/// The tables of the setup are the folder of the project's own last run: the first time it is not there yet.
TEST(Projects, MayBeginWithWhatTheirLastTimeHasLeft) {
  const Folder folder;
  folder.file("a.h", "0 BEGIN PGM A MM\n1 END PGM A MM\n");
  folder.file("s.toml", "[control]\ntype = \"TNC640\"\ntables = \"out/2-a\"\n");
  const std::string file = folder.file(
      "job.toml", "[[run]]\nprogram = \"a.h\"\nsetup = \"s.toml\"\n[[run]]\nprogram = \"a.h\"\nname = \"again\"\n");
  const auto run = [&](const std::string& out) {
    return probewright({"project", file, "--out", (folder / out).string()});
  };
  const Answer first = run("out"), next = run("out"), elsewhere = run("other");
  EXPECT_EQ(first.exit, 0) << first.errors;
  EXPECT_THAT(first.errors, HasSubstr("out/2-a\" yet: the control begins without tables"));
  EXPECT_EQ(next.exit, 0);
  EXPECT_EQ(next.errors, "");
  std::filesystem::remove_all(folder / "out");
  EXPECT_EQ(elsewhere.exit, 0) << "there by then";
  EXPECT_EQ(run("other").exit, 2);
}

TEST(Projects, EndWhereAProgramStops) {
  const Folder folder;
  const std::string stops = folder.file("STOPS.H", "0 BEGIN PGM STOPS MM\n1 TOOL CALL 7 Z\n2 END PGM STOPS MM\n");
  const std::string file =
      folder.file("job.toml", "[[run]]\nprogram = \"STOPS.H\"\nsetup = \"" + cookbook +
                                  "set-up.toml\"\n[[run]]\nprogram = \"STOPS.H\"\nname = \"again\"\n");
  const Answer answer = probewright({"project", file, "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 3);
  EXPECT_THAT(answer.output, HasSubstr("STOPS.H                          stopped"));
  EXPECT_THAT(answer.output, HasSubstr("again                            not run"));
}

TEST(Projects, SayWhatIsWrongInTheirFile) {
  const Folder folder;
  const auto mistake = [&](const std::string& text) {
    const Answer answer = probewright({"project", folder.file("job.toml", text), "--out", (folder / "out").string()});
    EXPECT_EQ(answer.exit, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    return answer.errors;
  };
  EXPECT_THAT(mistake("name = \"x\"\n"), HasSubstr("job.toml"));
  EXPECT_THAT(mistake("[[run]]\nprogram = \"a.h\"\n"), HasSubstr("setup"));
  EXPECT_THAT(mistake("[[run]]\nsetup = \"a.toml\"\n"), HasSubstr("program"));
  EXPECT_THAT(mistake("[[run]]\nprogram = \"a.h\"\nsetup = \"a.toml\"\ntables = \"previous\"\n"),
              HasSubstr("job.toml:4:"));
  EXPECT_THAT(mistake("[[run]]\nprogramm = \"a.h\"\n"), HasSubstr("program"));
  EXPECT_EQ(probewright({"project", (folder / "none.toml").string()}).exit, 2);
}

TEST(Projects, LeaveAFileAloneThatIsNotTheirs) {
  const Folder folder;
  std::filesystem::create_directory(folder / "out");
  const std::string mine = folder.file("out/project.csv", "my,own\r\n");
  const Answer answer = probewright({"project", cookbook + "plate-project.toml", "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("stays as it is"));
  EXPECT_EQ(textOf(mine), "my,own\r\n");
}

std::vector<std::string> inspectInto(const std::string& record, const Folder& folder, const std::string& name) {
  return {"run",    cookbook + "inspect.h",   "--setup",  cookbook + "inspect.toml",
          "--out",  (folder / name).string(), "--append", record,
          "--quiet"};
}

TEST(Records, GrowByEveryRun) {
  const Folder folder;
  const std::string record = (folder / "values/record.csv").string();
  for (int run = 1; run <= 3; ++run) {
    EXPECT_EQ(probewright(inspectInto(record, folder, "out")).exit, 1);
    const std::vector<std::string> rows = linesOf(textOf(record));
    ASSERT_EQ(rows.size(), 1U + 3U * static_cast<std::size_t>(run));
    EXPECT_TRUE(rows.front().starts_with("started,setup,part,seed,cycle,name,"));
    EXPECT_THAT(rows.back(),
                HasSubstr("inspect.toml,plate,1,1,421,MEASURE HOLE,inspect.h,5,BORE 40 H7,diameter,Q153,mm,"));
  }
}

TEST(Records, HoldEveryRunOfManyAtOnce) {
  const Folder folder;
  const std::string record = (folder / "record.csv").string();
  {
    std::vector<std::jthread> runs;
    for (int i = 0; i < 4; ++i)
      runs.emplace_back(
          [&, i] { EXPECT_EQ(probewright(inspectInto(record, folder, "out" + std::to_string(i))).exit, 1); });
  }
  EXPECT_EQ(linesOf(textOf(record)).size(), 1U + 3U * 4U);
}

TEST(Records, AreNotAddedToOtherFiles) {
  const Folder folder;
  for (const char* text : {"my,own,table\r\n", "started"}) {
    const std::string other = folder.file("other.csv", text);
    const Answer answer = probewright(inspectInto(other, folder, "out"));
    EXPECT_EQ(answer.exit, 2);
    EXPECT_THAT(answer.errors, HasSubstr("not that of a record of runs"));
    EXPECT_EQ(textOf(other), text);
  }
  // A run that was lost in the middle of its line.
  const std::string record = (folder / "record.csv").string();
  EXPECT_EQ(probewright(inspectInto(record, folder, "out")).exit, 1);
  std::string text = textOf(record);
  text.resize(text.size() - 5);
  folder.file("record.csv", text);
  const Answer answer = probewright(inspectInto(record, folder, "out"));
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("the last line has no end"));
  EXPECT_EQ(textOf(record), text);
  EXPECT_EQ(probewright(inspectInto((folder / "out").string(), folder, "out")).exit, 2);
}

TEST(Tables, OfTheCommandLineTakeThePlaceOfTheSetups) {
  const Folder folder;
  const std::string first = (folder / "first").string(), second = (folder / "second").string();
  ASSERT_EQ(probewright({"run", cookbook + "set-up.h", "--setup", cookbook + "set-up.toml", "--out", first}).exit, 0);
  const Answer answer = probewright(
      {"run", cookbook + "inspect.h", "--setup", cookbook + "set-up.toml", "--tables", first, "--out", second});
  EXPECT_EQ(answer.exit, 0) << answer.output;
  const Answer none = probewright({"run", cookbook + "inspect.h", "--setup", cookbook + "set-up.toml", "--tables",
                                   (folder / "none").string(), "--out", second});
  EXPECT_EQ(none.exit, 2);
  EXPECT_THAT(none.errors, HasSubstr("there is no such folder of tables"));
}

}  // namespace
}  // namespace probewright::app::testing
