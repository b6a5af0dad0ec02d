#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string worldOf(const char* control) {
  return std::string("[control]\ntype = \"") + control +
         "\"\n[part]\nname = \"block\"\n[[part.feature]]\nshape = \"box\"\nsize = [40, 40, 20]\n";
}

Answer runWith(const Folder& folder, const std::string& program, const std::string& setup, const std::string& skip) {
  std::vector<std::string> words = {"run", program, "--setup", setup, "--out", (folder / "out").string()};
  if (!skip.empty()) words.insert(words.end(), {"--skip", skip});
  return probewright(words);
}

TEST(BlockSkip, LeavesOutTheLevelsThatAreSwitchedOn) {
  const Folder folder;
  const std::string setup = folder.file("world.toml", worldOf("840Dsl"));
  const std::string program =
      folder.file("part.mpf", "MSG(\"always\")\n/MSG(\"plain\")\n/3 MSG(\"third\")\n/5 MSG(\"fifth\")\nM30\n");
  const Answer all = runWith(folder, program, setup, "");
  ASSERT_EQ(all.exit, 0) << all.errors;
  for (const char* text : {"always", "plain", "third", "fifth"})
    EXPECT_THAT(all.output, HasSubstr(text));
  EXPECT_THAT(all.output, Not(HasSubstr("blocks skipped")));
  const auto results = [&] { return nlohmann::json::parse(std::ifstream(folder / "out" / "results.json")); };
  EXPECT_FALSE(results()["run"].contains("skipLevels"));

  const Answer some = runWith(folder, program, setup, "0,3");
  ASSERT_EQ(some.exit, 0) << some.errors;
  EXPECT_THAT(some.output, HasSubstr("always"));
  EXPECT_THAT(some.output, Not(HasSubstr("plain")));
  EXPECT_THAT(some.output, Not(HasSubstr("third")));
  EXPECT_THAT(some.output, HasSubstr("fifth"));
  EXPECT_THAT(some.output, HasSubstr("blocks skipped: level 0, 3"));
  EXPECT_EQ(results()["run"]["skipLevels"], (nlohmann::json{0, 3}));
}

TEST(BlockSkip, HoldsForTheLanguagesOfHeidenhain) {
  const Folder folder;
  const std::string setup = folder.file("world.toml", worldOf("TNC640"));
  const std::string klartext =
      folder.file("part.h", "0 BEGIN PGM PART MM\n1 FN 14: ERROR = 1000\n/2 FN 14: ERROR = 1001\n3 END PGM PART MM\n");
  const std::string iso = folder.file("part.i", "%PART G71 *\n/N10 D14 P01 1001*\nN99999999 %PART G71 *\n");
  const std::string open = folder.file("open.h", "0 BEGIN PGM OPEN MM\n/1 this is no block\n2 END PGM OPEN MM\n");
  EXPECT_EQ(probewright({"check", open}).exit, 2);
  EXPECT_EQ(probewright({"check", open, "--skip", "0"}).exit, 0);
  EXPECT_EQ(probewright({"check", open, "--skip", "3"}).exit, 2) << "a / alone has level 0";
  EXPECT_EQ(runWith(folder, iso, setup, "").exit, 3);
  EXPECT_EQ(runWith(folder, iso, setup, "0").exit, 0);
  EXPECT_THAT(runWith(folder, klartext, setup, "0").errors, Not(HasSubstr("1001")));
}

TEST(BlockSkip, IsAListOfLevels) {
  const Folder folder;
  const std::string program = folder.file("part.mpf", "M30\n");
  for (const char* wrong : {"10", "0,", ",1", "a", "", "1 2", "-1"}) {
    const Answer answer = probewright({"check", program, "--skip", wrong});
    EXPECT_EQ(answer.exit, 2) << wrong;
    EXPECT_THAT(answer.errors, HasSubstr("--skip")) << wrong;
  }
  EXPECT_EQ(probewright({"check", program, "--skip", "0,1,2,3,4,5,6,7,8,9"}).exit, 0);
}

TEST(Languages, ThatNobodyReadsHereAreNamed) {
  const Folder folder;
  for (const auto& [name, text] :
       std::vector<std::pair<std::string, std::string>>{{"probe.ngc", "%\nG21\nG38.2 Z-10 F100\nM2\n%\n"},
                                                        {"probe.nc", "O1000 (PROBE)\nG21 G90\nG38.2 Z-10 F100\nM30\n"},
                                                        {"probe.tap", "#100=5\nG0 X#100\nM30\n"},
                                                        {"plain.nc", "(made by hand)\nG90 G94\nG0 X1\nM30\n"}}) {
    for (const std::vector<std::string>& control : {std::vector<std::string>{}, {"--control", "840Dsl"}}) {
      std::vector<std::string> words = {"check", folder.file(name, text)};
      words.insert(words.end(), control.begin(), control.end());
      const Answer answer = probewright(words);
      EXPECT_EQ(answer.exit, 2) << name;
      EXPECT_THAT(answer.errors, HasSubstr("this looks like an RS-274 program")) << name;
    }
  }
  const Answer siemens = probewright({"check", folder.file("own.txt", "G71 G90\nR1=5\nG0 X1 ; (a comment)\nM30\n")});
  EXPECT_EQ(siemens.exit, 0) << siemens.errors;
  EXPECT_THAT(probewright({"check", folder.file("wrong.mpf", "G21\nM30\n")}).errors, HasSubstr("RS-274"));
}

}  // namespace
}  // namespace probewright::app::testing
