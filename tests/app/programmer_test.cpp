#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/program.hpp"

/// What editors, build servers and programmers ask of `check` and `cycles`.
namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string wrong = "0 BEGIN PGM A MM\n1 L X+1 Y+\n2 CALL LBL 7\n3 END PGM A MM\n";

TEST(CheckFormats, GiveEachMessageAsData) {
  const Folder folder;
  const std::string file = folder.file("A B.H", wrong);
  const Answer text = probewright({"check", file});
  const Answer answer = probewright({"check", file, "--format", "json"});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_EQ(answer.errors, "");
  const json found = json::parse(answer.output);
  ASSERT_EQ(found.size(), 2U) << answer.output;
  EXPECT_EQ(found[0]["severity"], "error");
  EXPECT_EQ(found[0]["file"], file);
  EXPECT_EQ(found[0]["line"], 2);
  EXPECT_EQ(found[1]["line"], 3);
  for (const auto& each : found)
    EXPECT_THAT(text.errors, HasSubstr(file + ":" + std::to_string(each["line"].get<int>()) + ":" +
                                       std::to_string(each["column"].get<int>()) +
                                       ": error: " + each["message"].get<std::string>()));
}

TEST(CheckFormats, GiveSarif) {
  const Folder folder;
  const std::string file = folder.file("A B.H", wrong);
  const json document = json::parse(probewright({"check", file, "--format", "sarif"}).output);
  EXPECT_EQ(document["version"], "2.1.0");
  const json& run = document["runs"][0];
  EXPECT_EQ(run["tool"]["driver"]["name"], "Probewright");
  ASSERT_EQ(run["results"].size(), 2U);
  const json& first = run["results"][0];
  EXPECT_EQ(first["level"], "error");
  EXPECT_EQ(first["locations"][0]["physicalLocation"]["region"]["startLine"], 2);
  EXPECT_THAT(first["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].get<std::string>(),
              HasSubstr("/A%20B.H"));
}

/// SARIF counts in UTF-16: letters as one, whatever their bytes, and what lies beyond U+FFFF as two.
TEST(CheckFormats, CountColumnsOfSarifInUtf16) {
  const Folder folder;
  const auto columnIn = [&](const std::string& file) {
    const json run = json::parse(probewright({"check", file, "--format", "sarif"}).output)["runs"][0];
    EXPECT_EQ(run["columnKind"], "utf16CodeUnits");
    for (const json& each : run["results"]) {
      const json& region = each["locations"][0]["physicalLocation"]["region"];
      if (region["startLine"] == 2) return region["startColumn"].get<int>();
    }
    return 0;
  };
  const std::string before = "BEGIN PGM A MM\nTOOL CALL \"", after = "\" Z S+Xx\nEND PGM A MM\n";
  // The place is behind 11 characters, the name and 6 more.
  EXPECT_EQ(columnIn(folder.file("a.h", before + "ABC" + after)), 18 + 3);
  EXPECT_EQ(columnIn(folder.file("b.h", before + "ÄÖÜ" + after)), 18 + 3);
  EXPECT_EQ(columnIn(folder.file("c.h", before + "孔" + after)), 18 + 1);
  EXPECT_EQ(columnIn(folder.file("d.h", before + "😀" + after)), 18 + 2);
  EXPECT_EQ(columnIn(folder.file("e.h", before + "ÄÖÜ孔😀" + after)), 18 + 6);
  EXPECT_EQ(columnIn(folder.file("windows-1252.h", before + "\xC4\xD6\xDC" + after)), 18 + 3);
  // At the end of the line, and with a byte order mark, which is not counted.
  EXPECT_EQ(columnIn(folder.file("f.mpf", "G17\nMSG(\"ÄÖÜ孔😀\") X=\nM30\n")), 5 + 6 + 5 + 1);
  EXPECT_EQ(columnIn(folder.file("g.h", "\xEF\xBB\xBF" + before + "ÄÖÜ" + after)), 18 + 3);
}

TEST(CheckFormats, CountColumnsOfWhatIsPipedIn) {
  const Folder folder;
  const std::string file = folder.file("a.h", "TOOL CALL \"ÄÖÜ孔😀\" Z S+Xx\n");
  const std::string output = (folder / "output").string();
  const std::string command =
      "'" PROBEWRIGHT_PROGRAM "' check - --control TNC640 --format sarif < '" + file + "' > '" + output + "'";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  const json run = json::parse(textOf(output))["runs"][0];
  EXPECT_EQ(run["results"][0]["locations"][0]["physicalLocation"]["region"]["startColumn"], 24);
}

TEST(CheckFormats, HaveNothingToSayOfGoodPrograms) {
  const Answer answer = probewright({"check", "examples/programs/housing.h", "--format", "json"});
  EXPECT_EQ(answer.exit, 0);
  EXPECT_EQ(json::parse(answer.output), json::array());
}

TEST(Check, ReadsStandardInput) {
  const Folder folder;
  const std::string file = folder.file("A.H", wrong);
  std::ostringstream command;
  const std::string errors = (folder / "errors").string();
  command << "'" PROBEWRIGHT_PROGRAM "' check - --control TNC640 < '" << file << "' 2> '" << errors << "'";
  EXPECT_EQ(WEXITSTATUS(std::system(command.str().c_str())), 2);
  EXPECT_THAT(textOf(errors), HasSubstr("standard input:2:"));
}

/// Whether `check` has nothing to say of a program that holds the template and what is before every cycle: for each
/// cycle of a control, the languages by turns.
class CycleTemplates : public ::testing::TestWithParam<const char*> {};

TEST_P(CycleTemplates, ArePrintedAsCheckTakesThem) {
  const std::string control = GetParam();
  const bool sinumerik = control.find("TNC") == std::string::npos;
  const json cycles = json::parse(probewright({"cycles", "--control", control, "--json"}).output);
  const Folder folder;
  std::vector<std::string> words = {"check", "--control", control, "--format", "json"};
  constexpr std::array languages = {"en", "de", "ru", "sv", "zh", "pl"};
  std::size_t next = 0;
  for (const json& cycle : cycles) {
    const std::string name = cycle["name"], language = languages.at(next++ % languages.size());
    const Answer answer = probewright({"cycles", name, "--template", "--control", control, "--language", language});
    ASSERT_EQ(answer.exit, 0) << name << answer.errors;
    EXPECT_THAT(answer.output, HasSubstr(name));
    // Each parameter that the control has can be filled in.
    const bool inParts = !sinumerik && cycle["number"] < 400;
    for (const json& parameter : cycle["parameters"]) {
      const std::string own = sinumerik ? "; " + parameter["name"].get<std::string>() + " "
                                        : "    " + parameter["name"].get<std::string>() + "=";
      const auto& controls = parameter["controls"];
      const bool has = sinumerik || std::ranges::find(controls, json(control)) != controls.end();
      if (!inParts) {
        EXPECT_EQ(answer.output.find(own) != std::string::npos, has) << name << own;
      }
    }
    const std::string program = sinumerik ? "T1 D1\nM6\nG54 G17\n" + answer.output + "M30\n"
                                          : "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\n" + answer.output + "END PGM A MM\n";
    words.push_back(folder.file(language + name + (sinumerik ? ".mpf" : ".h"), program));
  }
  EXPECT_GE(cycles.size(), sinumerik ? 16U : 49U);
  const Answer answer = probewright(words);
  EXPECT_EQ(answer.exit, 0);
  std::set<std::string> told;
  for (const json& each : json::parse(answer.output))
    told.insert(std::filesystem::path(each["file"].get<std::string>()).filename().string() + ": " +
                each["message"].get<std::string>());
  EXPECT_THAT(told, ::testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Controls, CycleTemplates, ::testing::Values("TNC640", "iTNC530", "840Dsl", "828D"));

TEST(CycleTemplate, HasTheTextsOfTheControl) {
  const Answer answer = probewright({"cycles", "421", "--template"});
  EXPECT_THAT(answer.output, HasSubstr("TCH PROBE 421 MEASURE HOLE ~\n    Q273=+0      ;CENTER IN 1ST AXIS ~\n"));
  EXPECT_EQ(probewright({"cycles", "--template"}).exit, 2);
}

}  // namespace
}  // namespace probewright::app::testing
