#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "app/program.hpp"
#include "support/page_data.hpp"

/// The report as a user orders it: on paper, in a language, with the head of a job.
namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string program = "examples/first/plate.h", setup = "examples/first/plate.toml";

Answer run(const Folder& folder, const std::string& nc, const std::string& world,
           const std::vector<std::string>& more) {
  std::vector<std::string> words = {"run", nc, "--setup", world, "--out", (folder / "out").string()};
  words.insert(words.end(), more.begin(), more.end());
  return probewright(words);
}

TEST(Pdf, HasThePagesOfTheReport) {
  const Folder folder;
  const Answer answer = run(folder, program, setup, {"--pdf", "--job", "serial=0017"});
  ASSERT_LE(answer.exit, 1) << answer.errors;
  const std::string pdf = textOf(folder / "out/report.pdf");
  EXPECT_TRUE(pdf.starts_with("%PDF-")) << answer.errors;
  EXPECT_GT(pdf.size(), 20'000U) << "with the picture of the part";
  EXPECT_THAT(pdf, HasSubstr("/Type /Page"));
}

TEST(Pdf, NeedsAChromiumBeforeTheRunBegins) {
  const Folder folder;
  setenv("PROBEWRIGHT_CHROMIUM", (folder / "none").c_str(), 1);
  const Answer answer = run(folder, program, setup, {"--pdf"});
  unsetenv("PROBEWRIGHT_CHROMIUM");
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("apt-get install chromium"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/report.html"));
}

TEST(Report, IsInTheLanguageAndHasTheJobThatWereAskedFor) {
  const Folder folder;
  const Answer answer =
      run(folder, program, setup, {"--language", "de", "--job", "serial=0017", "--job", "operator=M. Weber"});
  ASSERT_LE(answer.exit, 1) << answer.errors;
  const json page = json::parse(testing_support::pageData(textOf(folder / "out/report.html")));
  EXPECT_EQ(page["language"], "de");
  EXPECT_EQ(page["results"]["run"]["job"], json::parse(R"({"serial": "0017", "operator": "M. Weber"})"));
  EXPECT_FALSE(page["trace"]["states"].empty()) << "the replay has something to follow";
}

TEST(Report, RefusesAJobThatItDoesNotKnow) {
  const Folder folder;
  const Answer answer = run(folder, program, setup, {"--job", "colour=red"});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("colour=red is not NAME=TEXT with one of part, drawing"));
}

}  // namespace
}  // namespace probewright::app::testing
