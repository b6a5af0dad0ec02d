#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <regex>
#include <sstream>
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

/// The lines of each page that hold text, without the places where words may be divided.
std::vector<std::vector<std::string>> pagesOf(const Folder& folder) {
  const std::string text = (folder / "report.txt").string();
  const std::string command = "pdftotext -layout '" + (folder / "out/report.pdf").string() + "' '" + text + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << "pdftotext is needed: apt-get install poppler-utils";
  std::vector<std::vector<std::string>> pages(1);
  std::istringstream stream(textOf(text));
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("\f")) {
      pages.emplace_back();
      line.erase(0, 1);
    }
    const std::string softHyphen = "\xC2\xAD";
    for (std::size_t at = line.find(softHyphen); at != std::string::npos; at = line.find(softHyphen, at))
      line.erase(at, softHyphen.size());
    if (line.find_first_not_of(" \f\r") != std::string::npos) pages.back().push_back(line);
  }
  if (pages.back().empty()) pages.pop_back();
  return pages;
}

/// The housing's program with the inspection of bore and spigot 40 times: a sheet of many pages.
std::string longProgram() {
  std::string text = textOf(std::string(PROBEWRIGHT_SOURCE_DIR) + "/examples/programs/housing.h");
  text.resize(text.find("28 * - INSPECT: POCKET"));
  text = std::regex_replace(text, std::regex("CALL LBL 1"), "; next");
  text.insert(text.find("22 * - INSPECT: BORE"), "LBL 9\n");
  return text + "CALL LBL 9 REP 39\nEND PGM HOUSING MM\n";
}

TEST(Pdf, BreaksALongSheetBetweenFeatures) {
  const Folder folder;
  const Answer answer = run(folder, folder.file("long.h", longProgram()), "examples/setups/housing-tnc640.toml",
                            {"--pdf", "--job", "part=Housing <A & B> \"1\"", "--job", "serial=0017"});
  ASSERT_EQ(answer.exit, 0) << answer.errors << answer.output;
  const auto pages = pagesOf(folder);
  ASSERT_GE(pages.size(), 6U);
  const std::regex cycle(R"(^\s*(\d+) (?:TOP FACE|FRONT SIDE|BORE 40|INSPECT: ).*)"),
      // The words of a narrow cell may stand above and below the line with its values.
      row(R"(^\s*(\d+)\.(\d)\s+(?:centre|diameter|coordinate|0\.0000 ).*)");
  std::smatch found;
  int cycles = 0, rows = 0;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    SCOPED_TRACE("page " + std::to_string(i + 1));
    // The foot names part, serial number, program and page, as they are.
    const std::string& foot = pages[i].back();
    EXPECT_THAT(foot, HasSubstr("Housing <A & B> \"1\""));
    EXPECT_THAT(foot, HasSubstr("0017"));
    EXPECT_THAT(foot, HasSubstr("long.h"));
    EXPECT_THAT(foot, HasSubstr("Page " + std::to_string(i + 1) + " / " + std::to_string(pages.size())));
    bool head = false, headingLast = false;
    int open = 0;  // the cycle whose head is on this page
    for (const std::string& line : pages[i]) {
      if (line.find("Characteristic") != std::string::npos && line.find("Nominal") != std::string::npos) head = true;
      const bool heading = std::regex_match(line, std::regex("(Inspection|Corrections|Against the truth|Messages)"));
      if (&line != &pages[i].back()) headingLast = heading;
      if (std::regex_match(line, found, cycle)) {
        EXPECT_TRUE(head) << "the head of the table is on every page of it: " << line;
        open = std::stoi(found[1]);
        EXPECT_EQ(open, ++cycles);
      } else if (std::regex_match(line, found, row)) {
        EXPECT_EQ(std::stoi(found[1]), open) << "a row stands with the name of its feature: " << line;
        ++rows;
      }
    }
    EXPECT_FALSE(headingLast) << "a heading at the end of a page";
  }
  EXPECT_EQ(cycles, 83);
  EXPECT_EQ(rows, 244);
  // What is known of the preset stands on one page.
  const auto holds = [](const std::vector<std::string>& page, const std::string& expression) {
    return std::ranges::any_of(
        page, [&](const std::string& line) { return std::regex_search(line, std::regex(expression)); });
  };
  const auto truth = std::ranges::find_if(pages, [&](const auto& page) { return holds(page, "preset 1"); });
  ASSERT_NE(truth, pages.end());
  for (const char* column : {"SPC +0\\.79", "X +\u221258\\.6", "Y +\u221240\\.8", "Z +\u2212469\\.5"})
    EXPECT_TRUE(holds(*truth, column)) << column;
  EXPECT_TRUE(holds(pages.back(), "Signature"));
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

/// Whoever is trained can look into every file.
TEST(Report, OfABlindRunHoldsNothingOfTheWorld) {
  const Folder folder;
  // A part that lies 0.6543 mm beside where the control believes it, with a hole that is 0.0123 mm too large.
  std::string world = textOf(std::string(PROBEWRIGHT_SOURCE_DIR) + "/" + setup);
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = world.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    world.replace(at, from.size(), to);
  };
  replace("x = 0.7", "x = 0.6543");
  replace("diameter = 30.01", "diameter = 30.0123");
  const Answer answer = run(folder, program, folder.file("blind.toml", world),
                            {"--blind", "--clearance", "--export", "csv,xlsx,qif,dfq,dmis,junit"});
  ASSERT_LE(answer.exit, 1) << answer.errors;
  const json page = json::parse(testing_support::pageData(textOf(folder / "out/report.html")));
  EXPECT_TRUE(page["scene"]["meshes"].empty());
  EXPECT_TRUE(page["scene"]["tools"].empty());
  EXPECT_TRUE(page["scene"]["machine"].is_null());
  EXPECT_TRUE(page["scene"]["collisions"].empty());
  EXPECT_FALSE(page["scene"]["touches"]["centres"].get<std::string>().empty()) << "what was touched is drawn";
  EXPECT_EQ(page["scene"]["path"]["points"], "") << "the way of the true tip";
  for (const std::string& text : {answer.output, textOf(folder / "out/results.json"), page["results"].dump(),
                                  textOf(folder / "out/inspection.csv"), textOf(folder / "out/inspection.qif"),
                                  textOf(folder / "out/inspection.dmo"), textOf(folder / "out/junit.xml")}) {
    EXPECT_THAT(text, ::testing::Not(HasSubstr("truth")));
    EXPECT_THAT(text, ::testing::Not(HasSubstr("\"clearance\":")));
  }
}

TEST(Report, RefusesAJobThatItDoesNotKnow) {
  const Folder folder;
  const Answer answer = run(folder, program, setup, {"--job", "colour=red"});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("colour=red is not NAME=TEXT with one of part, drawing"));
}

}  // namespace
}  // namespace probewright::app::testing
