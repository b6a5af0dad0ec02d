#include <gtest/gtest.h>

#include <numbers>

#include "setup/simulated_run.hpp"

namespace probewright::setup {
namespace {

using namespace session;

/// Runs a Klartext program on a machine with a cutter of 100 mm in the spindle; the way that its totals tell.
double wayOf(const std::string& machine, const std::string& moves) {
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup("[machine]\nname = \"" + machine +
                                           "\"\n[control]\ntype = \"TNC640\"\n[[tool]]\nnumber = 1\nkind = "
                                           "\"mill\"\nlength = 100\nradius = 5\nin_spindle = true\n",
                                       "setup.toml", diagnostics);
  for (const Diagnostic& diagnostic : diagnostics)
    ADD_FAILURE() << format(diagnostic);
  if (!setup) return -1;
  const RunOutcome outcome =
      runText("p.h", "BEGIN PGM P MM\nTOOL CALL 1 Z S100\n" + moves + "END PGM P MM\n", *setup, RunOptions{}).outcome;
  for (const Diagnostic& diagnostic : outcome.result.diagnostics)
    ADD_FAILURE() << format(diagnostic);
  return outcome.info.totalPathLength;
}

TEST(Travel, CountsWhatAHeadSwingsTheTip) {
  // The axis of B lies 150 mm above the spindle nose: the tip swings on a circle of 250 mm.
  EXPECT_NEAR(wayOf("mill5-head-table", "L X+100 R0 FMAX M91\nL B+90 FMAX\n"), 100 + 250 * std::numbers::pi / 2, 1e-3);
}

TEST(Travel, CountsWhatATableTurnsBeneathTheTip) {
  // At X100 the tip stands 100 mm from the axis of C, at X0 above it.
  EXPECT_NEAR(wayOf("mill5-table-table", "L C+180 FMAX\nL X+100 R0 FMAX M91\nL C+90 FMAX\n"),
              100 + 100 * std::numbers::pi / 2, 1e-3);
}

}  // namespace
}  // namespace probewright::setup
