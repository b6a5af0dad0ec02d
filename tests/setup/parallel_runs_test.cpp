#include <gtest/gtest.h>

#include <array>
#include <barrier>
#include <string>
#include <thread>
#include <vector>

#include "records/results.hpp"
#include "setup/simulated_run.hpp"

/// Runs of one process that go on at the same time have nothing in common.
namespace probewright::setup {
namespace {

struct Case {
  const char *program, *setup;
};

/// Both vendors, all controls; tools, kinematics, turning, tilted planes, calibration.
constexpr std::array<Case, 8> cases = {{{"programs/kinematics.h", "setups/kinematics-tnc640.toml"},
                                        {"programs/kinematics.mpf", "setups/kinematics-840dsl.toml"},
                                        {"programs/tool.h", "setups/tool-tnc640.toml"},
                                        {"programs/tool.mpf", "setups/tool-840dsl.toml"},
                                        {"programs/shaft.mpf", "setups/shaft-lathe.toml"},
                                        {"programs/tools-lathe.mpf", "setups/tools-lathe.toml"},
                                        {"cookbook/tilted-datum.h", "cookbook/tilted-datum.toml"},
                                        {"cookbook/calibrate.h", "cookbook/calibrate.toml"}}};

/// All that a run leaves, as bytes.
std::string bytesOf(const Case& which) {
  const std::string examples = PROBEWRIGHT_EXAMPLES "/";
  Diagnostics diagnostics;
  const auto setup = readSetup(examples + which.setup, diagnostics);
  if (!setup) return "";
  session::RunOptions options;
  options.trace = true;
  const SimulatedRun run = runProgram(examples + which.program, *setup, options);
  std::string bytes = records::resultsText(run.outcome.journal, run.outcome.info);
  for (const Diagnostic& diagnostic : run.outcome.diagnostics)
    bytes += format(diagnostic);
  for (const auto& [name, content] : run.outcome.files)
    bytes += name + "\n" + content;
  return bytes;
}

TEST(ParallelRuns, OfEightKindsLeaveTheBytesThatEachLeavesAlone) {
  std::array<std::string, cases.size()> alone;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    alone[i] = bytesOf(cases[i]);
    ASSERT_GT(alone[i].size(), 1000U) << cases[i].program;
  }
  for (int round = 0; round < 3; ++round) {
    std::array<std::string, cases.size()> together;
    {
      std::barrier begin(static_cast<std::ptrdiff_t>(cases.size()));
      std::vector<std::jthread> threads;
      for (std::size_t i = 0; i < cases.size(); ++i)
        threads.emplace_back([&, i] {
          begin.arrive_and_wait();
          together[i] = bytesOf(cases[i]);
        });
    }
    for (std::size_t i = 0; i < cases.size(); ++i)
      EXPECT_TRUE(together[i] == alone[i]) << cases[i].program << " in round " << round;
  }
}

}  // namespace
}  // namespace probewright::setup
