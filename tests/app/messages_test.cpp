#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.hpp"

/// Messages about programs and setups, as people read them.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Messages, TellWhatThereIsInstead) {
  const Folder folder;
  const std::string rowThree = R"(
[control]
type = "TNC640"
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 100
ball_radius = 3
[[preset]]
row = 3
active = true
)";
  const auto run = [&](const std::string& name, const std::string& text, const std::string& setup = {}) {
    return probewright(
        {"run", folder.file(name, text), "--setup", folder.file("s.toml", setup), "--out", (folder / "out").string()});
  };
  const auto block = [](const std::string& line) { return "0 BEGIN PGM P MM\n1 " + line + "\n2 END PGM P MM\n"; };
  // A setup that names rows has no others.
  const Answer preset = run("p.h", block("CYCL DEF 247 PRESETTING ~\nQ339=+1"), rowThree);
  EXPECT_EQ(preset.exit, 3);
  EXPECT_THAT(preset.errors, HasSubstr("The preset table has no row 1"));
  EXPECT_EQ(run("p.h", block("CYCL DEF 247 PRESETTING ~\nQ339=+3"), rowThree).exit, 0);
  EXPECT_THAT(run("p.h", block("TOOL CALL 9 Z"), rowThree).errors, HasSubstr("it has 1 PROBE"));
  EXPECT_THAT(run("p.h", block("TOOL CALL \"NOTHERE\" Z"), rowThree).errors, HasSubstr("it has 1 PROBE"));
  EXPECT_THAT(run("p.mpf", "M30\n", rowThree).errors, HasSubstr("name a setup whose [control] type is 840Dsl"));
  // Klartext under the ending of the other language.
  const Answer other = run("p.mpf", block("L X+1 FMAX"), "");
  EXPECT_EQ(other.exit, 2);
  EXPECT_THAT(other.errors, HasSubstr("it was read as SINUMERIK because of its ending, but looks like Klartext"));
  EXPECT_THAT(probewright({"check", (folder / "p.mpf").string()}).errors, HasSubstr("but looks like Klartext"));
  EXPECT_THAT(probewright({"check", "-dash.h"}).errors, HasSubstr("write ./-dash.h"));
  EXPECT_THAT(probewright({"check", folder.file("u.h", std::string("\xFF\xFE\0\0B\0\0\0", 8))}).errors,
              HasSubstr("this file is UTF-32"));
}

TEST(Messages, HaveOneFormAndAreSaidOnce) {
  const Folder folder;
  const std::string world = folder.file("s.toml", "[control]\ntype = \"840Dsl\"\n");
  const std::string text = "R1=1\nR2=R1/0\nM30\n";
  const Answer answer =
      probewright({"run", folder.file("p.mpf", text), "--setup", world, "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 3);
  // file:line:column: error: number: text
  EXPECT_THAT(answer.errors, ::testing::ContainsRegex("p\\.mpf:2:1: error: [0-9]+: "));
  EXPECT_THAT(answer.output, HasSubstr("STOPPED  (line 2)"));
  EXPECT_THAT(answer.output, Not(HasSubstr("ivision")));
}

}  // namespace
}  // namespace probewright::app::testing
