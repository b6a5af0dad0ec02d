#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "app/block_world.hpp"
#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;

const std::string program = "examples/programs/housing.h";
const std::string setup = "examples/setups/housing-tnc640.toml";

const std::string loggedProgram = blockProgram("+0", "+0", 1);

TEST(CommandLine, NamesTheWordItDoesNotKnow) {
  EXPECT_THAT(probewright({"frobnicate"}).errors, HasSubstr("there is no subcommand frobnicate"));
  EXPECT_THAT(probewright({"run", "--foo"}).errors, HasSubstr("run has no option --foo"));
  EXPECT_THAT(probewright({"--foo"}).errors, HasSubstr("there is no option --foo"));
  EXPECT_THAT(probewright({"run"}).errors, HasSubstr("PROGRAM is required"));
  for (const auto& [option, value, message] :
       std::vector<std::array<std::string, 3>>{{"--on-stop", "foo", "foo is not one of continue, abort, ask"},
                                               {"--language", "fr", "fr is not one of en, de, ru, sv, zh, pl"},
                                               {"--step-limit", "-1", "-1 is not a whole number of 0 or more"},
                                               {"--search", "0", "0 is not a whole number of 1 or more"},
                                               {"--seed", "x", "x is not a whole number"}}) {
    const Answer answer = probewright({"run", program, "--setup", setup, option, value});
    EXPECT_EQ(answer.exit, 2) << option;
    EXPECT_THAT(answer.errors, HasSubstr(message));
  }
  const std::string help = probewright({"run", "--help"}).output;
  EXPECT_THAT(help, HasSubstr("messages and logs: en, de, ru, sv, zh, pl"));
  EXPECT_EQ(help.find('\0'), std::string::npos);
  EXPECT_EQ(probewright({"run", program, "--setup", setup, "--language", "SV", "--out", "/dev/null/x"}).exit, 2)
      << "any case, but no folder";
}

TEST(CommandLine, TakesNumbersOnly) {
  for (const char* value : {"nan", "inf", "x"}) {
    const Answer compared = probewright({"compare", "one", "other", "--tolerance", value});
    EXPECT_EQ(compared.exit, 2);
    EXPECT_THAT(compared.errors, HasSubstr("--tolerance: " + std::string(value) + " is not a number"));
    for (const char* option : {"--set-up", "--dist"}) {
      const Answer converted = probewright({"convert", program, "no-folder/x.mpf", option, value});
      EXPECT_EQ(converted.exit, 2);
      EXPECT_THAT(converted.errors, HasSubstr(option + (": " + std::string(value)) + " is not a number"));
    }
  }
}

TEST(CommandLine, RefusesUnknownWords) {
  const Answer control = probewright({"run", program, "--setup", setup, "--control", "TNC7"});
  EXPECT_EQ(control.exit, 2);
  EXPECT_THAT(control.errors, HasSubstr("TNC7 is not one of TNC640, iTNC530, 840Dsl"));
  const Answer other = probewright({"run", program, "--setup", setup, "--control", "840Dsl"});
  EXPECT_EQ(other.exit, 2);
  EXPECT_THAT(other.errors, HasSubstr("this is a Klartext program, which the 840Dsl does not read"));
  EXPECT_EQ(messages(other.errors), 1U) << other.errors;
  EXPECT_EQ(probewright({"run", program}).exit, 2);
  EXPECT_EQ(probewright({"measure"}).exit, 2);
  EXPECT_EQ(probewright({}).exit, 2);
  EXPECT_EQ(probewright({"run", program, "--setup", setup, "--on-stop", "dance"}).exit, 2);
}

TEST(CommandLine, NoticesThatItsOutputDidNotArrive) {
  const Folder folder;
  EXPECT_EQ(probewright({"cycles"}, "/dev/full").exit, 2);
  EXPECT_EQ(probewright({"--help"}, "/dev/full").exit, 2);
  const Answer answer = probewright({"run", folder.file("a.h", loggedProgram), "--setup",
                                     folder.file("block.toml", blockSetup()), "--out", (folder / "out").string()},
                                    "/dev/full");
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("standard output could not be written"));
}

}  // namespace
}  // namespace probewright::app::testing
