#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Check, FindsNothingWrongWithTheExamples) {
  for (const std::string& name : namesIn(PROBEWRIGHT_SOURCE_DIR "/examples/programs")) {
    const Answer answer = probewright({"check", "examples/programs/" + name});
    EXPECT_EQ(answer.exit, 0) << name << "\n" << answer.errors;
    EXPECT_EQ(answer.output, "examples/programs/" + name + ": no mistakes found\n");
    EXPECT_EQ(answer.errors, "");
  }
}

TEST(Check, NamesEveryMistakeWithItsPlace) {
  const Folder folder;
  const std::string path = folder.file(
      "wrong.h",
      "0 BEGIN PGM WRONG MM\n1 L X+ZZ\n2 FN 9: IF +1 EQU +1 GOTO LBL 7\n3 TCH PROBE 499 NONE\n4 END PGM WRONG MM\n");
  const Answer answer = probewright({"check", path});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr(path + ":2:7: error:"));
  EXPECT_THAT(answer.errors, HasSubstr(path + ":3:"));
  EXPECT_THAT(answer.errors, HasSubstr(path + ":4:"));
  EXPECT_THAT(answer.errors, HasSubstr("1 L X+ZZ"));
}

TEST(Check, FindsParametersThatTheCatalogueDoesNotAllow) {
  const Folder folder;
  const std::string path = folder.file(
      "cycle.h",
      "0 BEGIN PGM CYCLE MM\n1 TOOL CALL 1 Z\n2 TCH PROBE 417 TOP ~\nQ263=+0 ~\nQ264=+0 ~\nQ294=+0 ~\nQ320=-1 ~\n"
      "Q260=+50 ~\nQ305=+1 ~\nQ333=+0 ~\nQ303=+1\n3 END PGM CYCLE MM\n");
  const Answer answer = probewright({"check", path});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr(path + ":7:1: error: Q320"));
  EXPECT_THAT(answer.errors, HasSubstr("0 to 99999.9999 mm"));
}

TEST(Check, ReadsAllProgramsEvenIfOneIsWrong) {
  const Folder folder;
  const std::string good = folder.file("good.h", "0 BEGIN PGM GOOD MM\n1 END PGM GOOD MM\n");
  const Answer answer = probewright({"check", (folder / "none.h").string(), good});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("none.h: error: cannot open"));
  EXPECT_THAT(answer.output, HasSubstr("good.h: no mistakes found"));
}

TEST(Check, StartsInLessThanFiftyMilliseconds) {
  if (!PROBEWRIGHT_OPTIMIZED) GTEST_SKIP() << "only the release build is measured";
  // Processor time, and the best of some: other programs on the machine are not what is measured.
  double best = 1;
  for (int i = 0; i < 10; ++i)
    best = std::min(best, probewright({"check", "examples/programs/housing.h"}).cpuSeconds);
  EXPECT_LT(best, 0.05);
}

TEST(Cycles, AreListedAndExplained) {
  const Answer all = probewright({"cycles"});
  EXPECT_EQ(all.exit, 0);
  EXPECT_THAT(all.output, HasSubstr("412"));
  EXPECT_THAT(all.output, HasSubstr("CYCLE977"));
  const Answer old = probewright({"cycles", "--control", "iTNC530"});
  EXPECT_THAT(old.output, HasSubstr("412"));
  EXPECT_THAT(old.output, Not(HasSubstr("CYCLE977")));
  const Answer one = probewright({"cycles", "cycle977"});
  EXPECT_EQ(one.exit, 0);
  EXPECT_THAT(one.output, HasSubstr("S_MVAR"));
  EXPECT_THAT(one.output, HasSubstr("_OVR[4]"));
  const auto everything = nlohmann::json::parse(probewright({"cycles", "--json"}).output);
  std::size_t lines = 0;
  for (const char c : all.output)
    lines += c == '\n' ? 1 : 0;
  EXPECT_EQ(everything.size(), lines);
  const auto bore = nlohmann::json::parse(probewright({"cycles", "412", "--json"}).output);
  ASSERT_EQ(bore.size(), 1U);
  EXPECT_EQ(bore[0]["controls"], (nlohmann::json{"TNC640", "iTNC530"}));
  EXPECT_EQ(bore[0]["parameters"][0]["name"], "Q321");
  const Answer none = probewright({"cycles", "4711"});
  EXPECT_EQ(none.exit, 2);
  EXPECT_EQ(none.errors, "probewright: there is no cycle 4711; `probewright cycles` lists them all\n");
}

TEST(Program, TellsItsVersion) {
  const Answer answer = probewright({"--version"});
  EXPECT_EQ(answer.exit, 0);
  EXPECT_EQ(answer.output, PROBEWRIGHT_PROGRAM_VERSION "\n");
}

}  // namespace
}  // namespace probewright::app::testing
