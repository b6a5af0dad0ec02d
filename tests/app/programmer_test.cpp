#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
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

/// Every cycle of the catalogue with the controls that have it.
json catalogue() { return json::parse(probewright({"cycles", "--json"}).output); }

TEST(CycleTemplates, AreCallsThatCanBePasted) {
  const Folder folder;
  std::string klartext = "BEGIN PGM ALL MM\n", sinumerik;
  int count = 0;
  for (const json& cycle : catalogue()) {
    const std::string name = cycle["name"];
    const Answer answer = probewright({"cycles", name, "--template"});
    ASSERT_EQ(answer.exit, 0) << name << answer.errors;
    EXPECT_THAT(answer.output, HasSubstr(name));
    (cycle["controls"][0] == "840Dsl" ? sinumerik : klartext) += answer.output;
    ++count;
  }
  EXPECT_GT(count, 60);
  // What is to be filled in may be missing or contradict itself; the form of the blocks may not be wrong.
  const std::string files[] = {folder.file("ALL.H", klartext + "END PGM ALL MM\n"), folder.file("ALL.MPF", sinumerik)};
  for (const std::string& file : files) {
    for (const json& each : json::parse(probewright({"check", file, "--format", "json"}).output)) {
      const std::string message = each["message"];
      EXPECT_TRUE(each["severity"] != "error" || message.find("expected") == std::string::npos)
          << each["file"] << ":" << each["line"] << " " << message;
    }
  }
}

TEST(CycleTemplates, HaveTheTextsOfTheControl) {
  const Answer answer = probewright({"cycles", "421", "--template"});
  EXPECT_THAT(answer.output, HasSubstr("TCH PROBE 421 MEASURE HOLE ~\n    Q273=+0      ;CENTER IN 1ST AXIS ~\n"));
  EXPECT_EQ(probewright({"cycles", "--template"}).exit, 2);
}

}  // namespace
}  // namespace probewright::app::testing
