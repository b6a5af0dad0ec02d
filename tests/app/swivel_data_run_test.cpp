#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "app/program.hpp"

/// What CYCLE996 corrects is among the tables of a run, and the next run computes with it.
namespace probewright::app::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// The two numbers of the message "Off by A, now by B".
std::pair<double, double> off(const Answer& answer) {
  const std::string before = "Off by ", after = ", now by ";
  const std::size_t first = answer.output.find(before), second = answer.output.find(after);
  if (first == std::string::npos || second == std::string::npos) {
    ADD_FAILURE() << answer.output << answer.errors;
    return {};
  }
  return {std::stod(answer.output.substr(first + before.size())),
          std::stod(answer.output.substr(second + after.size()))};
}

TEST(SwivelData, AreCorrectedAndKept) {
  const Folder folder;
  const std::string program = PROBEWRIGHT_SOURCE_DIR "/examples/programs/kinematics.mpf";
  std::string setup = textOf(PROBEWRIGHT_SOURCE_DIR "/examples/setups/kinematics-840dsl.toml");
  const Answer first =
      probewright({"run", program, "--setup", folder.file("one.toml", setup), "--out", (folder / "out").string()});
  ASSERT_EQ(first.exit, 0) << first.errors;
  EXPECT_GT(off(first).first, 0.03);
  EXPECT_LT(off(first).second, 0.005);
  EXPECT_THAT(textOf(folder / "out/TOOLS.TOA"), HasSubstr("$TC_CARR4[1]="));
  EXPECT_THAT(textOf(folder / "out/MIXED_BC_M1.SPF"), ContainsRegex("\\$TC_CARR4\\[1\\]=0\\.0[23]"));

  const std::string type = "type = \"840Dsl\"\n";
  setup.insert(setup.find(type) + type.size(), "tables = \"out\"\n");
  const Answer second =
      probewright({"run", program, "--setup", folder.file("two.toml", setup), "--out", (folder / "more").string()});
  ASSERT_EQ(second.exit, 0) << second.errors;
  EXPECT_LT(off(second).first, 0.005) << "corrected before";
}

/// A belief of the setup that is as wrong as the truth is other than the drawing shows nothing to correct.
TEST(SwivelData, AreTheBeliefsOfTheSetup) {
  const Folder folder;
  const std::string program = PROBEWRIGHT_SOURCE_DIR "/examples/programs/kinematics.mpf";
  std::string setup = textOf(PROBEWRIGHT_SOURCE_DIR "/examples/setups/kinematics-840dsl.toml");
  std::istringstream lines(setup);
  bool errors = false;
  std::string beliefs;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) errors = line.starts_with("[errors.rotary.");
    if (!errors) continue;
    const std::size_t table = line.find("[errors.rotary.");
    if (table == 0) line.replace(0, 15, "[control.kinematics.");
    beliefs += line + "\n";
  }
  const Answer answer = probewright(
      {"run", program, "--setup", folder.file("s.toml", setup + beliefs), "--out", (folder / "out").string()});
  ASSERT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_LT(off(answer).first, 0.005);
}

}  // namespace
}  // namespace probewright::app::testing
