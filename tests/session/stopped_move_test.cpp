#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <stop_token>
#include <thread>

#include "session/run.hpp"
#include "support/virtual_world.hpp"

/// Ctrl-C in the middle of a move: the token of the run reaches the machine.
namespace probewright::session {
namespace {

using testing::HasSubstr;
using testing_support::perfectWorld;
using testing_support::place;

/// A single block that takes long: the table turns a million degrees under a probe that just misses the part. Only a
/// stop that reaches the move can end the run before the program ends by itself.
TEST(Stop, EndsTheRunWithinAMove) {
  simulation::Setup setup;
  setup.control = control::ControlKind::TNC640;
  setup.truth = perfectWorld("mill5-table-table");
  place(setup.truth, simulation::Box({-50, -50, -20}, {50, 50, 0}), Pose(Eigen::Translation3d(0, 0, -400)));
  simulation::BelievedTool probe;
  probe.number = 1;
  probe.name = "PROBE";
  probe.kind = "probe";
  probe.length = 100;
  probe.radius = probe.axialRadius = 2;
  setup.tools.push_back(probe);
  std::stop_source source;
  RunOptions options;
  options.stop = source.get_token();
  std::jthread operatorsHand([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    source.request_stop();
  });
  const RunOutcome outcome = runText("TURN.H",
                                     "BEGIN PGM TURN MM\nTOOL CALL 1 Z\nL X+30 Y+0 Z-399.5 R0 FMAX\n"
                                     "L C+1500000 FMAX\nEND PGM TURN MM\n",
                                     setup, options);
  EXPECT_EQ(outcome.result.end, language::RunEnd::Cancelled);
  EXPECT_EQ(outcome.info.exit, records::ExitState::Stopped);
  EXPECT_THAT(outcome.info.exitText, HasSubstr("the run was interrupted at this block"));
  const auto& axes = *outcome.machine;
  EXPECT_LT(axes.position()[*axes.description().axisIndex("C")], 1.5e6);
}

}  // namespace
}  // namespace probewright::session
