#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "linuxcnc_simulator/example_mill.hpp"

/// The examples, and a program that writes a datum table, on LinuxCNC, opened in its screen and from outside, and on
/// the virtual machine: the same part, the same probe, the same touches. With PROBEWRIGHT_LONG_TESTS each by both ways
/// and at the feeds of the examples, which takes ten minutes; else by one way, with a faster machine and probe.
namespace probewright::testing {
namespace {

namespace fs = std::filesystem;

struct Example {
  const char* program;
  const char* setup;
  const char* way;  ///< without PROBEWRIGHT_LONG_TESTS
};

class ExamplesAgree : public ::testing::TestWithParam<Example> {
protected:
  static bool longRun() { return std::getenv("PROBEWRIGHT_LONG_TESTS") != nullptr; }

  double feed() const { return longRun() ? 300 : 600; }
  /// mm: a servo period at the probing feed.
  double bound() const { return within(feed()); }

  struct Reading {
    double value = 0;
    bool probed = false;  ///< the axis lies in the probing direction
  };
  /// X, Y and Z of all touches.
  std::vector<Reading> touches(const std::string& folder) const {
    std::vector<Reading> all;
    const auto results = nlohmann::json::parse(contents(session_.outside() / folder / "results.json"), nullptr, false);
    if (!results.is_object()) return all;
    for (const auto& cycle : results.at("cycles"))
      for (const auto& touch : cycle.at("touches"))
        for (std::size_t i = 0; i < 3; ++i)
          all.push_back({touch.at("axes").at(std::string(1, "XYZ"[i])).get<double>(),
                         std::abs(touch.at("direction")[i].get<double>()) > 0.9});
    return all;
  }
  /// What the control has written is the same but for numbers, and these as near as results of touches can be.
  void tablesAgree(const std::string& way) const {
    const std::regex number("[-+]?[0-9]+\\.[0-9]+");
    int tables = 0;
    // Not tools of a SINUMERIK: whether a wear is corrected is decided at a limit.
    for (const char* table : {"PRESET.PR", "ZERO.D", "TCHPROBE.TP", "TOOL.T", "FRAMES.UFR", "DATA.INI"}) {
      const std::string expected = contents(session_.outside() / "virtual" / table);
      const std::string found = contents(session_.outside() / way / table);
      tables += expected.empty() ? 0 : 1;
      EXPECT_EQ(std::regex_replace(found, number, "#"), std::regex_replace(expected, number, "#")) << way << table;
      auto a = std::sregex_iterator(found.begin(), found.end(), number);
      for (auto b = std::sregex_iterator(expected.begin(), expected.end(), number), end = std::sregex_iterator();
           a != end && b != end; ++a, ++b)
        EXPECT_NEAR(std::stod(a->str()), std::stod(b->str()), 3 * bound()) << way << table << "\n" << found;
    }
    EXPECT_GE(tables, 2);
  }
  ExampleMill mill_;
  const LinuxCncSession& session_ = mill_.session;
};

TEST_P(ExamplesAgree, WithTheVirtualMachine) {
  if (!mill_.feels()) GTEST_SKIP() << ExampleMill::unfelt;
  const std::string program = GetParam().program;
  const fs::path source = PROBEWRIGHT_SOURCE_DIR;
  for (const char* file : {"mill3.hal", "mill3.var"})
    fs::copy(mill_.example / file, session_.outside() / file);
  const fs::path ours = source / "tests/linuxcnc_simulator/programs";
  fs::copy((fs::exists(ours / program) ? ours : source / "examples/programs") / program, session_.outside() / program);
  fs::copy(ours / "ZERO.D", session_.outside() / "ZERO.D");
  fs::copy(source / "examples/parts/housing.step", session_.outside() / "housing.step");
  // What scatters does so anew in each run.
  std::string setup = contents(source / "examples/setups" / GetParam().setup);
  setup = std::regex_replace(setup, std::regex("\nrepeatability = [^\n]*"), "");
  setup = std::regex_replace(setup, std::regex("\\.\\./parts/"), "");
  setup = std::regex_replace(setup, std::regex("probing_feed = 300"), "probing_feed = " + std::to_string(feed()));
  session_.write("setup.toml", setup);
  // Nobody has set lengths and zero offsets at LinuxCNC: they are the setup's.
  session_.write("tool.tbl", "T1 P1 D0 Z0\nT2 P2 D0 Z0\n");
  // The machine of the setup.
  mill_.replace("MIN_LIMIT = -300\nMAX_LIMIT = 300", "MIN_LIMIT = -500\nMAX_LIMIT = 500");
  mill_.replace("MIN_LIMIT = -200\nMAX_LIMIT = 200", "MIN_LIMIT = -300\nMAX_LIMIT = 300");
  mill_.replace("MIN_LIMIT = -300\nMAX_LIMIT = 1\n", "MIN_LIMIT = -600\nMAX_LIMIT = 10\n");
  if (!longRun()) mill_.hurry();
  mill_.replace("SETUP = practice.toml", "SETUP = setup.toml");
  mill_.replace("CONTROL = control.toml\n", "");
  const std::string output = mill_.run("PROGRAM = '" + mill_.program() + "'\nname = '" + program + "'\nways = '" +
                                           (longRun() ? "measured outside" : GetParam().way) + R"('
import os, subprocess
desk.ready()
if 'measured' in ways:
    desk.run(name, 600)
    desk.until('results', lambda s: os.path.exists('measured/results.json'), 300)
    desk.mdi('G53 G0 Z0')
    desk.mdi('G10 L2 P1 X0 Y0 Z0 R0')
    desk.mdi('G10 L2 P3 X0 Y0 Z0 R0')
if 'outside' in ways:
    subprocess.run([PROGRAM, 'run', name, '--setup', 'setup.toml', '--machine', 'linuxcnc', '--out', 'outside', '--quiet'])
)",
                                       560);
  const auto file = [&](const std::string& name) { return " '" + (session_.outside() / name).string() + "'"; };
  const std::string virtually = PROBEWRIGHT_BUILD_DIR "/apps/probewright/probewright run --quiet" + file(program) +
                                " --setup" + file("setup.toml") + " --out" + file("virtual");
  EXPECT_LE(std::system(virtually.c_str()), 1 << 8);
  const std::vector<Reading> expected = touches("virtual");
  ASSERT_GE(expected.size(), 18U);
  for (const std::string way : {"measured", "outside"}) {
    if (!longRun() && way != GetParam().way) continue;
    const std::vector<Reading> found = touches(way);
    ASSERT_EQ(found.size(), expected.size()) << way << "\n" << output;
    double worst = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      // Where a touch lies across its direction follows from what was found before, a corner from extrapolated lines.
      EXPECT_NEAR(found[i].value, expected[i].value, found[i].probed ? bound() : 3 * bound())
          << way << ", touch " << i / 3 << ", axis " << i % 3;
      if (found[i].probed) worst = std::max(worst, std::abs(found[i].value - expected[i].value));
    }
    tablesAgree(way);
    std::printf("%s, %s: %zu touches, at most %.4f mm apart\n", program.c_str(), way.c_str(), found.size() / 3, worst);
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, ExamplesAgree,
                         ::testing::Values(Example{"corner.i", "housing-tnc640.toml", "measured"},
                                           Example{"datum.h", "housing-tnc640.toml", "measured"},
                                           Example{"housing.h", "housing-tnc640.toml", "measured"},
                                           Example{"housing.mpf", "housing-840dsl.toml", "outside"}),
                         [](const auto& test) {
                           return std::regex_replace(std::string(test.param.program), std::regex("\\."), "_");
                         });

}  // namespace
}  // namespace probewright::testing
