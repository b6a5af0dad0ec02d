#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "linuxcnc_simulator/example_mill.hpp"

/// The examples as the documents start them, without a screen.
namespace probewright::testing {
namespace {

class LinuxCncExamples : public ::testing::Test {
protected:
  void SetUp() override {
    if (!session_.needModule("linuxcnc/feel/probewright_feel.so")) GTEST_SKIP() << ExampleMill::unfelt;
  }
  std::string start(const std::string& words) const {
    return session_.command("env PROBEWRIGHT_BUILD='" + session_.build().string() + "' '" +
                            (session_.source() / "examples/linuxcnc/start").string() + "' " + words);
  }
  LinuxCncSession session_{PROBEWRIGHT_SOURCE_DIR, PROBEWRIGHT_BUILD_DIR};
};

constexpr double bound = within(300);
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

/// The preset of the plate stands in G54, and the report is there.
void expectPreset(const std::filesystem::path& home, const std::string& output) {
  std::ifstream parameters(home / "linuxcnc/configs/probewright-mill3/mill3.var");
  std::map<int, double> values;
  int number = 0;
  for (double value = 0; parameters >> number >> value;)
    values[number] = value;
  EXPECT_NEAR(values[5221], 1.7, bound) << output;
  EXPECT_NEAR(values[5222], -0.9, bound);
  EXPECT_NEAR(values[5223], -250, bound);
  EXPECT_TRUE(std::filesystem::exists(home / "linuxcnc/configs/probewright-mill3/measured/report.html"));
}

TEST_F(LinuxCncExamples, RunAKlartextProgramAndLeaveItsPresetInG54) {
  expectPreset(session_.outside(), start("mill3 bore.h"));
}

TEST_F(LinuxCncExamples, RunASinumerikProgramAndLeaveItsOffsetInG54) {
  expectPreset(session_.outside(), start("mill3 bore.mpf"));
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
  // The top lies at Z0 of G54, the centre of the ball 3 mm above it. Pretravel acts across the stylus only, and along
  // the way: tilted by 30 degrees a quarter of it.
  EXPECT_NEAR(top[0], 3, bound) << output;
  EXPECT_NEAR(top[1], 3 - pretravel / 4, bound) << output;
}

/// In one session: each program, and after each of them each.
TEST_F(LinuxCncExamples, RunOneAfterTheOther) {
  constexpr double feed = 1200, near = within(feed);
  ExampleMill mill;
  if (!mill.feels()) GTEST_SKIP() << ExampleMill::unfelt;
  mill.copyAll();
  mill.hurry();
  mill.replace("control.toml", "probing_feed = 300", "probing_feed = 1200");
  for (const char* macro : {"bore.ngc", "corner.ngc"})
    mill.replace(macro, "F300", "F1200");
  const std::map<char, std::string> programs = {
      {'h', "bore.h"}, {'s', "bore.mpf"}, {'b', "bore.ngc"}, {'c', "corner.ngc"}};
  const std::string order = "hhshbhcssbscbbcch";
  std::string script = R"(
import os
def measure(number, name):
    desk.messages.clear()
    desk.run(name)
    if not name.endswith('.ngc'):
        desk.until('results', lambda s: os.path.exists('measured/results.json'), 300)
        desk.until('the end', lambda s: s.interp_state == linuxcnc.INTERP_IDLE and s.inpos)
        os.rename('measured', 'measured-%d' % number)
    desk.mdi('(PRINT,desk: after%d #5221 #5222 #5223 #5230 #5241 #5242 #5243)' % number)
    desk.tell('said%d' % number, *[message.replace(chr(10), ' ') for message in desk.messages])
desk.ready()
)";
  for (std::size_t i = 0; i < order.size(); ++i)
    script += "measure(" + std::to_string(i) + ", '" + programs.at(order[i]) + "')\n";
  const std::string output = mill.run(script, 560);
  std::vector<double> before, corner;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::string which = "run " + std::to_string(i) + ", " + programs.at(order[i]);
    const std::vector<double> now = LinuxCncSession::told(output, "after" + std::to_string(i));
    ASSERT_EQ(now.size(), 7U) << which << output;
    std::smatch said;
    ASSERT_TRUE(std::regex_search(output, said, std::regex("desk: said" + std::to_string(i) + "([^\n]*)")));
    const std::string messages = said[1];
    if (order[i] == 'c') {
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_EQ(now[k], before[k]) << which << ": the corner is none of G54's business";
      // One touch a side of a skewed plate: near the corner, at the same place each time.
      EXPECT_NEAR(now[4], 1.7 - 40, 0.6) << which;
      EXPECT_NEAR(now[5], -0.9 - 30, 0.6) << which;
      if (!corner.empty()) {
        EXPECT_NEAR(now[4], corner[4], 2 * near) << which;
        EXPECT_NEAR(now[5], corner[5], 2 * near) << which;
      }
      corner = now;
      EXPECT_NE(messages.find("the corner is at X-38."), std::string::npos) << which << messages;
    } else {
      EXPECT_NEAR(now[0], 1.7, near) << which << output;
      EXPECT_NEAR(now[1], -0.9, near) << which;
      EXPECT_NEAR(now[2], -250, near) << which;
      EXPECT_EQ(now[3], 0) << which;
    }
    if (order[i] == 'b') {
      std::smatch diameter;
      ASSERT_TRUE(std::regex_search(messages, diameter,
                                    std::regex("the bore is at X1\\.[67][0-9]* Y-0\\.[89][0-9]*, "
                                               "its diameter is ([0-9.]+)")))
          << messages;
      EXPECT_NEAR(std::stod(diameter[1]), 30.01 + 2 * pretravel, 2 * near);
    }
    if (order[i] == 'h' || order[i] == 's') {
      const auto results = nlohmann::json::parse(
          contents(mill.session.outside() / ("measured-" + std::to_string(i)) / "results.json"), nullptr, false);
      EXPECT_NE(results.dump().find(R"("exit":{"code":0)"), std::string::npos) << which << messages;
    }
    before = now;
  }
}

TEST_F(LinuxCncExamples, RunOneAfterTheOtherOnFiveAxes) {
  ExampleMill mill("mill5");
  if (!mill.feels()) GTEST_SKIP() << ExampleMill::unfelt;
  mill.copyAll();
  mill.hurry();
  const std::string output = mill.run(R"(
import os
desk.ready()
for number, name in enumerate(('tilted.h', 'tilted.h', 'tilted.ngc', 'tilted.ngc', 'tilted.h')):
    desk.tell('begin', number)
    desk.run(name)
    if name == 'tilted.h':
        desk.until('results', lambda s: os.path.exists('measured/results.json'), 300)
        desk.until('the end', lambda s: s.interp_state == linuxcnc.INTERP_IDLE and s.inpos)
        os.rename('measured', 'measured-%d' % number)
)",
                                      560);
  for (const int number : {2, 3}) {
    const auto top =
        line(output.substr(std::min(output.size(), output.find("begin " + std::to_string(number)))), "top");
    ASSERT_EQ(top.size(), 2U) << output;
    EXPECT_NEAR(top[0], 3, bound) << output;
    EXPECT_NEAR(top[1], 3 - pretravel / 4, bound) << output;
  }
  const std::vector<double> first = touchesIn(mill.session.outside() / "measured-0/results.json");
  ASSERT_EQ(first.size(), 10U) << output;
  for (const char* again : {"measured-1", "measured-4"}) {
    const std::vector<double> touches = touchesIn(mill.session.outside() / again / "results.json");
    ASSERT_EQ(touches.size(), 10U) << again << output;
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_NEAR(touches[i], first[i], bound) << again << ", touch " << i / 5 << ", axis " << i % 5;
  }
}

}  // namespace
}  // namespace probewright::testing
