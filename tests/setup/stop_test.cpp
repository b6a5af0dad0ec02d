#include <gtest/gtest.h>

#include <stop_token>

#include "support/heidenhain_bench.hpp"

/// A run that somebody stops from outside.
namespace probewright::testing_support {
namespace {

/// Runs cycle 1410 on an edge whose points the operator shows, and stops the run while the cycle asks for the second.
session::RunOutcome runEdge(bool stops) {
  Bench bench(ControlKind::TNC640);
  bench.probeOf(110, 2);
  bench.preset(1, {0, 0, -400});
  bench.part(simulation::Box({-50, 0, -40}, {150, 60, 0}), pose({0, 0, -400}));
  std::stop_source source;
  session::RunOptions options;
  options.control = bench.control;
  options.stop = source.get_token();
  int questions = 0;
  options.answer = [&](const control::Question&) -> std::optional<std::string> {
    ++questions;
    if (stops && questions == 2) source.request_stop();
    return questions == 1 ? "10 -10 50; 10 -10 -8" : "90 -10 50; 90 -10 -8";
  };
  const std::string block =
      probe(1410, {{372, 2}, {320, 0}, {260, 60}, {1125, 0}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 0}},
            " ~\n QS1100= \"?10\" ;X ~\n QS1101= \"?0\" ;Y ~\n QS1102= \"?-8\" ;Z ~\n QS1103= \"?90\" ;X ~\n"
            " QS1104= \"?0\" ;Y ~\n QS1105= \"?-8\" ;Z");
  session::RunOutcome outcome =
      setup::runText("BENCH.H", "BEGIN PGM BENCH MM\nTOOL CALL 1 Z\n" + block + "END PGM BENCH MM\n", bench.setup,
                     options)
          .outcome;
  EXPECT_EQ(questions, 2);
  return outcome;
}

TEST(Stop, EndsAMeasuringCycleAtItsNextMove) {
  const session::RunOutcome whole = runEdge(false);
  ASSERT_EQ(whole.result.end, execution::RunEnd::Finished);
  ASSERT_EQ(whole.journal.cycles.size(), 1u);
  const std::size_t touches = whole.journal.cycles[0].touches.size();
  EXPECT_EQ(touches, 2u);

  const session::RunOutcome stopped = runEdge(true);
  EXPECT_EQ(stopped.result.end, execution::RunEnd::Cancelled);
  EXPECT_EQ(stopped.info.exit, records::ExitState::Stopped);
  for (const control::CycleRecord& cycle : stopped.journal.cycles)
    EXPECT_LT(cycle.touches.size(), touches);
}

}  // namespace
}  // namespace probewright::testing_support
