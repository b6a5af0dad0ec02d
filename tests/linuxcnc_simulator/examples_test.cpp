#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/linuxcnc_session.hpp"

/// The examples as the documents start them, without a screen.
namespace probewright::testing {
namespace {

class LinuxCncExamples : public ::testing::Test {
protected:
  void SetUp() override {
    if (!session_.needModule("linuxcnc/feel/probewright_feel.so"))
      GTEST_SKIP() << "only root can lend LinuxCNC a module that is not installed";
  }
  std::string start(const std::string& words) const {
    return session_.command("env PROBEWRIGHT_BUILD='" + session_.build().string() + "' '" +
                            (session_.source() / "examples/linuxcnc/start").string() + "' " + words);
  }
  LinuxCncSession session_{PROBEWRIGHT_SOURCE_DIR, PROBEWRIGHT_BUILD_DIR};
};

/// The numbers of the line that begins with `word`.
std::vector<double> line(const std::string& output, const std::string& word) {
  const std::size_t at = output.find("\n" + word + " ");
  if (at == std::string::npos) return {};
  return LinuxCncSession::told("desk: " + output.substr(at + 1), word);
}

constexpr double bound = 300.0 / 60 * 0.001 + 1e-4;  // mm: a servo period at the probing feed
constexpr double pretravel = 0.004;

TEST_F(LinuxCncExamples, FindTheMiddleOfABoreOnTheMill) {
  const std::string output = start("mill3 bore.ngc");
  const auto bore = line(output, "bore");
  ASSERT_EQ(bore.size(), 4U) << output;
  EXPECT_NEAR(bore[0], 1.7, bound) << output;
  EXPECT_NEAR(bore[1], -0.9, bound);
  // Ball radius 3; the signals come by the pretravel too late.
  EXPECT_NEAR(bore[2], -0.9 + 30.01 / 2 - 3 + pretravel, bound);
  EXPECT_NEAR(bore[3], -0.9 - 30.01 / 2 + 3 - pretravel, bound);
}

TEST_F(LinuxCncExamples, RunAKlartextProgramAndLeaveItsPresetInG54) {
  const std::string output = start("mill3 bore.h");
  std::ifstream parameters(session_.outside() / "linuxcnc/configs/probewright-mill3/mill3.var");
  std::map<int, double> values;
  int number = 0;
  for (double value = 0; parameters >> number >> value;)
    values[number] = value;
  EXPECT_NEAR(values[5221], 1.7, bound) << output;
  EXPECT_NEAR(values[5222], -0.9, bound);
  EXPECT_NEAR(values[5223], -250, bound);
  EXPECT_TRUE(std::filesystem::exists(session_.outside() / "linuxcnc/configs/probewright-mill3/measured/report.html"));
}

/// The axes of all touches that are in these results.
std::vector<double> touchesIn(const std::filesystem::path& results) {
  std::ifstream file(results);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  std::vector<double> all;
  if (!json.is_object()) return all;
  for (const auto& cycle : json.at("cycles"))
    for (const auto& touch : cycle.at("touches"))
      for (const char* axis : {"X", "Y", "Z", "A", "C"})
        all.push_back(touch.at("axes").at(axis).get<double>());
  return all;
}

TEST_F(LinuxCncExamples, TiltThePlaneAsTheVirtualMachineDoes) {
  const std::string output = start("mill5 tilted.h");
  const std::filesystem::path folder = session_.outside() / "linuxcnc/configs/probewright-mill5";
  const std::vector<double> measured = touchesIn(folder / "measured/results.json");
  ASSERT_EQ(measured.size(), 10U) << output;
  std::ifstream practice(folder / "practice.toml");
  std::ofstream(folder / "both.toml") << practice.rdbuf()
                                      << "\n[control]\ntype = \"TNC640\"\n[[preset]]\nrow = 1\norigin = [0, 0, -250]\n"
                                         "active = true\n";
  const std::string command = PROBEWRIGHT_BUILD_DIR "/apps/probewright/probewright run --quiet '" +
                              (folder / "tilted.h").string() + "' --setup '" + (folder / "both.toml").string() +
                              "' --out '" + (folder / "virtual").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::vector<double> expected = touchesIn(folder / "virtual/results.json");
  ASSERT_EQ(expected.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(measured[i], expected[i], bound) << "touch " << i / 5 << ", axis " << i % 5;
  EXPECT_NEAR(std::abs(expected[8]), 30, 1e-9) << "the table was tilted";
}

TEST_F(LinuxCncExamples, TouchTheSamePlaceUprightAndTilted) {
  const std::string output = start("mill5 tilted.ngc");
  const auto top = line(output, "top");
  ASSERT_EQ(top.size(), 2U) << output;
  // The top lies at Z-250, the centre of the ball 3 mm above it. Pretravel acts across the stylus only, and along the
  // way: tilted by 30 degrees a quarter of it.
  EXPECT_NEAR(top[0], -247, bound) << output;
  EXPECT_NEAR(top[1], -247 - pretravel / 4, bound) << output;
}

}  // namespace
}  // namespace probewright::testing
