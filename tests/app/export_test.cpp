#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/program.hpp"

/// Files for other programs, left by a run.
namespace probewright::app::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

const std::vector<std::string> housing = {"run", "examples/programs/housing.h", "--setup",
                                          "examples/setups/housing-tnc640.toml", "--quiet"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Export, LeavesFilesOfEveryFormatBesideTheResults) {
  const Folder folder;
  const std::string out = (folder / "out").string();
  const Answer answer =
      probewright(with(housing, {"--out", out, "--export", "csv,XLSX", "--export", "qif,dfq,dmis,junit"}));
  ASSERT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_THAT(namesIn(out), IsSupersetOf({"inspection.csv", "inspection.xlsx", "inspection.qif", "inspection.dfq",
                                          "inspection.dmo", "junit.xml", "results.json"}));
  // The same values as in the results.
  const auto results = nlohmann::json::parse(textOf(folder / "out/results.json"));
  const std::string csv = textOf(folder / "out/inspection.csv");
  std::size_t rows = 0;
  for (const auto& cycle : results["cycles"]) {
    for (const auto& result : cycle["results"]) {
      if (!result["main"]) continue;
      ++rows;
      EXPECT_THAT(csv, HasSubstr("," + result["name"].get<std::string>() + "," + result["unit"].get<std::string>()));
    }
  }
  EXPECT_GT(rows, 20U);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), rows + 1);
  // A run without the option takes them away again, as all that the run before has left.
  ASSERT_EQ(probewright(with(housing, {"--out", out})).exit, 0);
  EXPECT_THAT(namesIn(out), Not(Contains("inspection.csv")));
}

TEST(Export, RefusesAFormatThatIsNotThere) {
  const Folder folder;
  const Answer answer = probewright(with(housing, {"--out", (folder / "out").string(), "--export", "csv,pdf"}));
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("pdf is not one of csv, xlsx, qif, dfq, dmis, junit"));
  EXPECT_TRUE(namesIn(folder / "out").empty());
}

TEST(Export, KeepsItsNamesFromTheProgram) {
  const Folder folder;
  const std::string program = folder.file(
      "A.H", "0 BEGIN PGM A MM\n1 FN 16: F-PRINT A.A / other.txt\n2 FN 16: F-PRINT A.A / junit.xml\n3 END PGM A MM\n");
  folder.file("A.A", "\"mine\";\n");
  const Answer answer = probewright({"run", program, "--setup", "examples/setups/housing-tnc640.toml", "--quiet",
                                     "--out", (folder / "out").string(), "--export", "junit"});
  EXPECT_EQ(answer.exit, 3);
  EXPECT_THAT(answer.errors, HasSubstr(":3:"));
  EXPECT_THAT(answer.errors, HasSubstr("--export junit leaves a file of this name"));
  EXPECT_THAT(textOf(folder / "out/junit.xml"), HasSubstr("the program runs to its end"))
      << "what there is, is written";
  EXPECT_THAT(textOf(folder / "out/other.txt"), HasSubstr("mine"));
}

TEST(Export, KeepsItsNamesFromMeasuringLogs) {
  const Folder folder;
  const Answer answer =
      probewright({"run", "examples/programs/housing.mpf", "--setup", "examples/setups/housing-840dsl.toml", "--quiet",
                   "--out", (folder / "out").string(), "--export", "csv", "--measuring-log", "inspection.csv"});
  EXPECT_NE(answer.exit, 0);
  EXPECT_THAT(answer.errors, HasSubstr("--export csv leaves a file of this name"));
}

}  // namespace
}  // namespace probewright::app::testing
