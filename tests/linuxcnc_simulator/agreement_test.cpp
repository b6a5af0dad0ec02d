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

#include "support/linuxcnc_session.hpp"

/// The examples on LinuxCNC, opened in its screen and from outside, and on the virtual machine: the same part, the same
/// probe, the same touches. With PROBEWRIGHT_LONG_TESTS all of them, which takes ten minutes; else the shortest.
namespace probewright::testing {
namespace {

namespace fs = std::filesystem;

constexpr double bound = 300.0 / 60 * 0.001 + 1e-4;  // mm: a servo period at the probing feed

std::string contents(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Example {
  const char* program;
  const char* setup;
};
void PrintTo(const Example& example, std::ostream* out) { *out << example.program << " with " << example.setup; }

class ExamplesAgree : public ::testing::TestWithParam<Example> {
protected:
  static bool longRun() { return std::getenv("PROBEWRIGHT_LONG_TESTS") != nullptr; }

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
  LinuxCncSession session_{PROBEWRIGHT_SOURCE_DIR, PROBEWRIGHT_BUILD_DIR};
};

TEST_P(ExamplesAgree, WithTheVirtualMachine) {
  if (!session_.needModule("linuxcnc/feel/probewright_feel.so"))
    GTEST_SKIP() << "only root can lend LinuxCNC a module that is not installed";
  const std::string program = GetParam().program;
  if (!longRun() && program != "corner.i") GTEST_SKIP() << "set PROBEWRIGHT_LONG_TESTS to run it";
  const fs::path source = PROBEWRIGHT_SOURCE_DIR, example = source / "examples/linuxcnc/mill3";
  for (const char* file : {"mill3.hal", "mill3.var"})
    fs::copy(example / file, session_.outside() / file);
  fs::copy(source / "examples/programs" / program, session_.outside() / program);
  fs::copy(source / "examples/parts/housing.step", session_.outside() / "housing.step");
  // What scatters does so anew in each run.
  std::string setup = contents(source / "examples/setups" / GetParam().setup);
  setup = std::regex_replace(setup, std::regex("\nrepeatability = [^\n]*"), "");
  setup = std::regex_replace(setup, std::regex("\\.\\./parts/"), "");
  session_.write("setup.toml", setup);
  // Nobody has set lengths and zero offsets at LinuxCNC: they are the setup's.
  session_.write("tool.tbl", "T1 P1 D0 Z0\nT2 P2 D0 Z0\n");
  // The machine of the setup.
  std::string ini = contents(example / "mill3.ini");
  const auto replace = [&](const std::string& what, const std::string& by) {
    ASSERT_NE(ini.find(what), std::string::npos) << what;
    for (std::size_t at = 0; (at = ini.find(what, at)) != std::string::npos; at += by.size())
      ini.replace(at, what.size(), by);
  };
  const std::string binary = (session_.build() / "apps/probewright/probewright").string();
  replace("MIN_LIMIT = -300\nMAX_LIMIT = 300", "MIN_LIMIT = -500\nMAX_LIMIT = 500");
  replace("MIN_LIMIT = -200\nMAX_LIMIT = 200", "MIN_LIMIT = -300\nMAX_LIMIT = 300");
  replace("MIN_LIMIT = -300\nMAX_LIMIT = 1\n", "MIN_LIMIT = -600\nMAX_LIMIT = 10\n");
  replace("DISPLAY = axis", "DISPLAY = ./display.py");
  replace("HALFILE = probewright_feel.tcl",
          "HALFILE = " + (session_.source() / "linuxcnc/feel/probewright_feel.tcl").string());
  replace("libprobewright_interp.so", (session_.build() / "linuxcnc/interpreter/libprobewright_interp.so").string());
  replace("SETUP = practice.toml", "SETUP = setup.toml\nPROGRAM = " + binary);
  replace("CONTROL = control.toml\n", "");
  session_.write("test.ini", ini);
  session_.display("PROGRAM = '" + binary + "'\nname = '" + program + R"('
import os, subprocess
desk.ready()
desk.run(name, 600)
for _ in range(15000):
    if os.path.exists('measured/results.json'): break
    time.sleep(0.02)
desk.mdi('G53 G0 Z0')
desk.mdi('G10 L2 P1 X0 Y0 Z0 R0')
desk.mdi('G10 L2 P3 X0 Y0 Z0 R0')
if )" + std::string(longRun() ? "True" : "False") +
                   R"(:
    subprocess.run([PROGRAM, 'run', name, '--setup', 'setup.toml', '--machine', 'linuxcnc', '--out', 'outside', '--quiet'])
)");
  const std::string output = session_.run("test.ini", 560);
  const auto file = [&](const std::string& name) { return " '" + (session_.outside() / name).string() + "'"; };
  const std::string virtually = PROBEWRIGHT_BUILD_DIR "/apps/probewright/probewright run --quiet" + file(program) +
                                " --setup" + file("setup.toml") + " --out" + file("virtual");
  EXPECT_LE(std::system(virtually.c_str()), 1 << 8);
  const std::vector<Reading> expected = touches("virtual");
  ASSERT_GE(expected.size(), 18U);
  for (const char* way : {"measured", "outside"}) {
    if (std::string(way) == "outside" && !longRun()) continue;
    const std::vector<Reading> found = touches(way);
    ASSERT_EQ(found.size(), expected.size()) << way << "\n" << output;
    double worst = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      // Where a touch lies across its direction follows from what was found before, a corner from extrapolated lines.
      EXPECT_NEAR(found[i].value, expected[i].value, found[i].probed ? bound : 3 * bound)
          << way << ", touch " << i / 3 << ", axis " << i % 3;
      if (found[i].probed) worst = std::max(worst, std::abs(found[i].value - expected[i].value));
    }
    std::printf("%s, %s: %zu touches, at most %.4f mm apart\n", program.c_str(), way, found.size() / 3, worst);
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, ExamplesAgree,
                         ::testing::Values(Example{"corner.i", "housing-tnc640.toml"},
                                           Example{"housing.h", "housing-tnc640.toml"},
                                           Example{"housing.mpf", "housing-840dsl.toml"}),
                         [](const auto& test) {
                           return std::regex_replace(std::string(test.param.program), std::regex("\\."), "_");
                         });

}  // namespace
}  // namespace probewright::testing
