#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "app/block_world.hpp"
#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using nlohmann::json;

std::string expectedMistakes(const json& document) {
  std::ifstream stream(PROBEWRIGHT_SOURCE_DIR "/docs/study.schema.json");
  const json file = json::parse(stream);
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(file), schema);
  valijson::Validator validator;
  valijson::ValidationResults results;
  validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &results);
  std::string text;
  for (const auto& error : results) {
    for (const std::string& part : error.context)
      text += part;
    text += ": " + error.description + "\n";
  }
  return text;
}

json studyIn(const Folder& folder) {
  std::ifstream stream(folder / "out/study.json");
  return json::parse(stream);
}

const std::string study = R"(
trials = 60
sensitivity = "sobol"
sensitivity_trials = 20
[gauge]
[[source]]
name = "clamping"
quantity = "part.pose.x"
distribution = "normal"
mean = 0
standard_deviation = 0.02
[[measurand]]
result = "Q160"
truth = "part.feature[1].size[1]"
factor = 0.5
)";

TEST(StudyCommand, LeavesWhatItsSchemaSays) {
  const Folder folder;
  const Answer done = probewright({"study", folder.file("p.h", blockProgram("+20.1", "+19.9")), "--setup",
                                   folder.file("s.toml", blockSetup()), "--study", folder.file("t.toml", study),
                                   "--out", (folder / "out").string(), "--repeat", "10"});
  ASSERT_EQ(done.exit, 0) << done.errors;
  EXPECT_THAT(done.output, ::testing::HasSubstr("427@4 Q160"));
  EXPECT_THAT(done.output, ::testing::HasSubstr("Uncertainty budget"));
  const json document = studyIn(folder);
  EXPECT_EQ(expectedMistakes(document), "");
  EXPECT_EQ(document["trials"], 60);
  const json& result = document["results"][0];
  EXPECT_EQ(result["truth"], 20);
  // All that varies is where the block lies: one to one.
  EXPECT_NEAR(result["budget"][0]["sensitivity"].get<double>(), 1, 1e-6);
  EXPECT_NEAR(result["error"]["standardDeviation"].get<double>(), 0.02, 0.01);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/study.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/trials.csv"));
}

TEST(StudyCommand, GoesOnWithResumeAndOnlyWithTheSameStudy) {
  const Folder folder;
  const std::string program = folder.file("p.h", blockProgram()), setup = folder.file("s.toml", blockSetup());
  const std::string file = folder.file("t.toml", study), out = (folder / "out").string();
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"study", program, "--setup", setup, "--study", file, "--out", out, "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return probewright(words);
  };
  ASSERT_EQ(run({"--trials", "40"}).exit, 0);
  const Answer resumed = run({"--trials", "60", "--resume"});
  ASSERT_EQ(resumed.exit, 0) << resumed.errors;
  const json once = studyIn(folder);
  ASSERT_EQ(run({}).exit, 0);
  EXPECT_EQ(studyIn(folder), once);
  folder.file("s.toml", blockSetup() + "# another setup\n");
  const Answer other = run({"--resume"});
  EXPECT_EQ(other.exit, 2);
  EXPECT_THAT(other.errors, ::testing::HasSubstr("another study"));
}

TEST(StudyCommand, SharesTrialsAmongRanksOfMpi) {
  if (!std::filesystem::exists(std::filesystem::path(PROBEWRIGHT_PROGRAM).parent_path() / "probewright-mpi.so"))
    GTEST_SKIP() << "built without MPI";
  const Folder folder;
  const std::vector<std::string> words = {"study",    folder.file("p.h", blockProgram("+20.1", "+19.9")),
                                          "--setup",  folder.file("s.toml", blockSetup()),
                                          "--study",  folder.file("t.toml", study),
                                          "--repeat", "5"};
  const auto ranks = [&](int count, const std::string& out) {
    std::string command =
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe --mca btl "
        "self,vader --mca rmaps_base_oversubscribe 1 -n " +
        std::to_string(count) + " " PROBEWRIGHT_PROGRAM;
    for (const std::string& word : words)
      command += " " + word;
    command += " --threads 1 --out " + (folder / out).string() + " >" + (folder / (out + ".txt")).string() + " 2>&1";
    return std::system(command.c_str());
  };
  ASSERT_EQ(ranks(1, "one"), 0) << textOf(folder / "one.txt");
  ASSERT_EQ(ranks(2, "two"), 0) << textOf(folder / "two.txt");
  ASSERT_EQ(ranks(3, "three"), 0) << textOf(folder / "three.txt");
  const std::string expected = textOf(folder / "one/study.json");
  EXPECT_NE(expected, "");
  EXPECT_EQ(textOf(folder / "two/study.json"), expected);
  EXPECT_EQ(textOf(folder / "three/study.json"), expected);
  // Several ranks hand in sums: the values stay where they are, unless --keep asks for them.
  EXPECT_FALSE(std::filesystem::exists(folder / "two/trials.csv"));
}

/// What a study cannot write leaves the study before it whole.
TEST(StudyCommand, LeavesAllFilesOfTheStudyBeforeIfItsOwnDoNotFit) {
  const Folder folder;
  const std::string program = folder.file("p.h", blockProgram()), setup = folder.file("s.toml", blockSetup());
  const std::string file = folder.file("t.toml", study), out = (folder / "out").string();
  ASSERT_EQ(
      probewright({"study", program, "--setup", setup, "--study", file, "--out", out, "--trials", "30", "--quiet"})
          .exit,
      0);
  const auto files = [&] {
    std::string all;
    for (const std::string& name : namesIn(folder / "out"))
      all += name + "\n" + textOf(folder / ("out/" + name));
    return all;
  };
  const std::string before = files();
  const std::string said = (folder / "said").string();
  // No file larger than a block: the signal is ignored, so that the write fails.
  const std::string command = "(ulimit -f 1; trap '' XFSZ; exec " PROBEWRIGHT_PROGRAM " study " + program +
                              " --setup " + setup + " --study " + file + " --out " + out +
                              " --trials 40 --quiet; ) 2>&1 | cat >" + said;
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(textOf(said), ::testing::HasSubstr("trials.csv: error: cannot write this file"));
  EXPECT_EQ(files(), before);
}

/// One that fails after its first trials leaves those alone: results belong to the trials beside them.
TEST(StudyCommand, LeavesNoResultsBesideTrialsOfAnotherStudy) {
  const Folder folder;
  const std::string setup = folder.file("s.toml", blockSetup()), out = (folder / "out").string();
  const std::string file = folder.file("t.toml", study), said = (folder / "said").string();
  // The signal for files that are too large is ignored, so that the write fails.
  const auto run = [&](const std::string& program, const std::string& more, const std::string& largest) {
    const std::string command = "(trap '' XFSZ; exec prlimit --fsize=" + largest + " " PROBEWRIGHT_PROGRAM " study " +
                                program + " --setup " + setup + " --study " + file + " --out " + out + " --quiet " +
                                more + ") >" + said + " 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  };
  const auto hasOnlyTrials = [&] { return namesIn(folder / "out") == std::vector<std::string>{"trials.csv"}; };
  const std::string first = folder.file("p.h", blockProgram()), second = folder.file("q.h", blockProgram("+20.1"));
  ASSERT_EQ(run(first, "--trials 60", "unlimited"), 0) << textOf(said);
  EXPECT_THAT(namesIn(folder / "out"), ::testing::IsSupersetOf({"study.json", "study.csv", "trials.csv"}));
  const std::string before = textOf(folder / "out/trials.csv");
  // 500 trials are written at a time, with about 75 bytes each.
  ASSERT_EQ(run(second, "--trials 2000", "60000"), 2) << textOf(said);
  EXPECT_THAT(textOf(said), ::testing::HasSubstr("trials.csv: error: cannot add trials to the file"));
  EXPECT_TRUE(textOf(folder / "out/trials.csv") != before) << "its own trials";
  EXPECT_TRUE(hasOnlyTrials());
  // It goes on from there; what it has then is a set again.
  ASSERT_EQ(run(second, "--trials 2000 --resume", "unlimited"), 0) << textOf(said);
  EXPECT_EQ(studyIn(folder)["trials"], 2000);
  // A study that goes on has more trials than its earlier results count.
  const auto size = std::filesystem::file_size(folder / "out/trials.csv");
  ASSERT_EQ(run(second, "--trials 4000 --resume", std::to_string(size + 60000)), 2) << textOf(said);
  EXPECT_TRUE(hasOnlyTrials());
}

TEST(StudyCommand, NeverReplacesWhatIsNotOfAStudy) {
  const Folder folder;
  std::filesystem::create_directory(folder / "out");
  folder.file("out/trials.csv", "mine\n");
  const Answer refused =
      probewright({"study", folder.file("p.h", blockProgram()), "--setup", folder.file("s.toml", blockSetup()),
                   "--study", folder.file("t.toml", study), "--out", (folder / "out").string()});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, ::testing::HasSubstr("not of a study"));
}

TEST(StudyCommand, NamesMistakesOfItsFiles) {
  const Folder folder;
  const Answer refused = probewright(
      {"study", folder.file("p.h", blockProgram()), "--setup", folder.file("s.toml", blockSetup()), "--study",
       folder.file("t.toml", "[[source]]\nquantity = \"part.pose.x\"\ndistribution = \"nomal\"\n"), "--out",
       (folder / "out").string()});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, ::testing::HasSubstr("Did you mean \"normal\"?"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(StudyCommand, RefusesNumbersThatNoSetupHas) {
  const Folder folder;
  const Answer refused = probewright(
      {"study", folder.file("p.h", blockProgram()), "--setup", folder.file("s.toml", blockSetup()), "--study",
       folder.file("t.toml",
                   "[[source]]\nquantity = \"part.pose.q\"\ndistribution = \"uniform\"\nminimum = "
                   "0\nmaximum = 1\n"),
       "--out", (folder / "out").string()});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, ::testing::HasSubstr("t.toml:2:12: error: quantity \"part.pose.q\": unknown key \"q\""));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/study.json"));
}

TEST(StudyCommand, SaysThatThereIsNothingToGoOnWith) {
  const Folder folder;
  const Answer refused =
      probewright({"study", folder.file("p.h", blockProgram()), "--setup", folder.file("s.toml", blockSetup()),
                   "--study", folder.file("t.toml", study), "--out", (folder / "none").string(), "--resume"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, ::testing::HasSubstr("cannot read the trials"));
  EXPECT_THAT(refused.errors, ::testing::HasSubstr("leave out --resume, or name the folder of the interrupted study"));
}

TEST(StudyCommand, EndsWithoutAResultWhereEveryTrialIsStopped) {
  const Folder folder;
  const Answer done = probewright(
      {"study", folder.file("p.h", blockProgram()), "--setup", folder.file("s.toml", blockSetup()), "--study",
       folder.file("t.toml",
                   "block = 20\nsensitivity = \"none\"\n[[source]]\nname = \"aside\"\nquantity = "
                   "\"part.pose.x\"\ndistribution = \"normal\"\nmean = 300\nstandard_deviation = "
                   "0.001\n"),
       "--out", (folder / "out").string()});
  EXPECT_EQ(done.exit, 3);
  EXPECT_THAT(done.output, ::testing::HasSubstr("no trial came to its end: nothing was measured"));
  const json document = studyIn(folder);
  EXPECT_EQ(document["end"], "no result");
  EXPECT_EQ(document["trials"], 20);
  EXPECT_EQ(expectedMistakes(document), "");
  ASSERT_FALSE(document["alarms"].empty());
}

}  // namespace
}  // namespace probewright::app::testing
