#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

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

/// On a trunnion a move in the tilted plane leaves Z of the machine where it is: at the end of its travel, but for the
/// roundings of the way through the tilted system.
TEST(Travel, RoundingsLeadNoAxisBeyondItsEnd) {
  std::mt19937_64 random(4);
  const auto angle = [&] { return std::uniform_real_distribution<double>(-25, 25)(random); };
  for (int i = 0; i < 40; ++i) {
    const double a = angle(), b = angle(), c = angle();
    const std::string klartext = fmt::format(
        "BEGIN PGM P MM\nTOOL CALL 1 Z S100\nL Z+10 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC{:+.3f} TURN "
        "FMAX\nL X+5 Y+5 R0 FMAX\nL X-5 R0 F1000\nEND PGM P MM\n",
        a, b, c);
    const std::string sinumerik = fmt::format(
        "T1 M6 D1\nG17 G90 G710 G94 G54\nSUPA G0 Z10 "
        "D0\nCYCLE800(1,\"\",0,57,0,0,0,{:.3f},{:.3f},{:.3f},0,0,0,1,100,1)\n"
        "D1\nG0 X5 Y5\nG1 X-5 F1000\nM30\n",
        a, b, c);
    for (const auto& [control, name, text] :
         {std::tuple("TNC640", "p.h", klartext), std::tuple("iTNC530", "p.h", klartext),
          std::tuple("840Dsl", "p.mpf", sinumerik)}) {
      Diagnostics mistakes;
      const auto setup = setup::parseSetup(
          fmt::format("[machine]\nname = \"mill5-table-table\"\n[control]\ntype = \"{}\"\n[[tool]]\nnumber = 1\n"
                      "kind = \"mill\"\nlength = 100\nradius = 5\nin_spindle = true\n",
                      control),
          "setup.toml", mistakes);
      ASSERT_TRUE(setup);
      const RunOutcome outcome = runText(name, text, *setup, RunOptions{}).outcome;
      for (const Diagnostic& diagnostic : outcome.result.diagnostics)
        ADD_FAILURE() << control << "\n" << text << format(diagnostic);
    }
  }
}

}  // namespace
}  // namespace probewright::setup
