#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "machine/machine_file.hpp"
#include "session/run.hpp"
#include "support/scripted_machine.hpp"

/// Whole runs through the session on a machine that is no simulation: this program links none.
namespace probewright::session {
namespace {

using control::ControlKind;
using testing::AllOf;
using testing::HasSubstr;
using testing_support::ScriptedMachine;

/// Probe T1 (length 100, ball radius 2) in the spindle; the workpiece lies at Z-400: the axis Z reads 300 less than the
/// program has.
control::Beliefs probeAbove(ControlKind kind) {
  control::Beliefs beliefs;
  beliefs.file = "beliefs.toml";
  beliefs.control = kind;
  control::BelievedTool tool;
  tool.number = 1;
  tool.name = "PROBE";
  tool.kind = "probe";
  tool.length = 100;
  tool.radius = tool.axialRadius = 2;
  tool.inSpindle = true;
  beliefs.tools.push_back(tool);
  control::BelievedFrame frame;
  frame.index = 1;
  frame.origin = {0, 0, -400};
  frame.active = true;
  (kind == ControlKind::TNC640 ? beliefs.presets : beliefs.zeroOffsets).push_back(frame);
  return beliefs;
}

/// A machine whose changer has put the probe in, and that signals where `signals` say.
ScriptedMachine machineWithProbe(const std::vector<ScriptedMachine::Signal>& signals = {}) {
  ScriptedMachine machine(*machine::readMachine("mill3"));
  machine.changeTool({1, "PROBE"});
  machine.signals.assign(signals.begin(), signals.end());
  return machine;
}

/// The bore that is measured: 40 mm about (0.3, -0.2), so the ball's centre stays within 18 mm of its middle.
constexpr double boreX = 0.3, boreY = -0.2, reach = 20 - 2;

TEST(WholeRun, OfKlartextLeavesTablesAndResults) {
  // Four ways out from the origin.
  const double alongX = std::sqrt(reach * reach - boreY * boreY), alongY = std::sqrt(reach * reach - boreX * boreX);
  ScriptedMachine machine =
      machineWithProbe({{0, boreX + alongX}, {1, boreY + alongY}, {0, boreX - alongX}, {1, boreY - alongY}});
  const control::Beliefs beliefs = probeAbove(ControlKind::TNC640);
  const std::string program =
      "BEGIN PGM BORE MM\n"
      "TOOL CALL 1 Z\n"
      "L X+0 Y+0 Z+20 R0 FMAX\n"
      "TCH PROBE 412 PRESET INSIDE CIRCLE ~\n"
      "Q321=+0 Q322=+0 Q262=+40 Q325=+0 Q247=+90 Q261=-5 Q320=+2 Q260=+20 Q301=+0 Q305=+3 Q331=+0 Q332=+0 Q303=+1 ~\n"
      "Q381=+0 Q382=+0 Q383=+0 Q384=+0 Q333=+0 Q423=+4 Q365=+1\n"
      "END PGM BORE MM\n";
  const RunOutcome outcome = runText("BORE.H", program, beliefs, machine, {});
  ASSERT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  EXPECT_NEAR(outcome.variable("Q151"), 0.3, 1e-9);
  EXPECT_NEAR(outcome.variable("Q152"), -0.2, 1e-9);
  EXPECT_NEAR(outcome.variable("Q153"), 40, 1e-9);
  EXPECT_THAT(outcome.files.at("PRESET.PR"), HasSubstr("0.3"));
  EXPECT_THAT(outcome.files.at("TOOL.T"), HasSubstr("PROBE"));
  EXPECT_EQ(outcome.info.machine, machine.description().name);
  EXPECT_EQ(outcome.info.seed, std::nullopt) << "only the builder of a machine knows of random effects";
  EXPECT_EQ(outcome.machineFromWorkpiece->translation(), Vector3(0, 0, -400));
}

TEST(WholeRun, OfASinumerikLeavesDataAndResults) {
  // Along X through the origin, then along Y through the middle that was found.
  const double alongX = std::sqrt(reach * reach - boreY * boreY);
  ScriptedMachine machine =
      machineWithProbe({{0, boreX + alongX}, {0, boreX - alongX}, {1, boreY + reach}, {1, boreY - reach}});
  const control::Beliefs beliefs = probeAbove(ControlKind::Sinumerik840Dsl);
  const std::string program =
      "G17 G54 G90\nT1 D1\nG0 X0 Y0 Z-5\n"
      "CYCLE977(101,10001,,1,40,,,8,4,0,,,,1,1,\"\",,0,,0,0,,,,,1,)\n"
      "R5=_OVR[4]\n"
      "M30\n";
  const RunOutcome outcome = runText("BORE.MPF", program, beliefs, machine, {});
  ASSERT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  ASSERT_EQ(outcome.journal.cycles.size(), 1u);
  EXPECT_EQ(outcome.journal.cycles[0].touches.size(), 4u);
  EXPECT_NEAR(outcome.variable("R5"), 40, 0.003) << "the chord along X is 0.0022 mm shorter than the diameter";
  EXPECT_TRUE(std::isnan(outcome.variable("R6")));
  EXPECT_THAT(outcome.files.at("FRAMES.UFR"),
              AllOf(HasSubstr("$P_UIFR[1,X,TR]=0.3"), HasSubstr("$P_UIFR[1,Y,TR]=-0.1999")));
  EXPECT_THAT(outcome.files.at("TOOLS.TOA"), HasSubstr("PROBE"));
}

TEST(WholeRun, TracesWhereTheProgramStands) {
  ScriptedMachine machine = machineWithProbe();
  const control::Beliefs beliefs = probeAbove(ControlKind::TNC640);
  RunOptions options;
  options.trace = true;
  const std::string program =
      "BEGIN PGM WAY MM\n"
      "TOOL CALL 1 Z\n"
      "L X+10 Y-5 Z+20 R0 FMAX\n"
      "TRANS DATUM AXIS X+3\n"
      "L X+10 F500\n"
      "END PGM WAY MM\n";
  const records::RunTrace trace = runText("WAY.H", program, beliefs, machine, options).trace;
  EXPECT_EQ(trace.files, std::vector<std::string>{"WAY.H"});
  std::vector<std::uint32_t> lines;
  for (const auto& block : trace.blocks)
    lines.push_back(block.line);
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6, 6})) << "the last one ends with the run";
  const auto& before = trace.blocks[3];
  EXPECT_NEAR((before.position - Vector3(10, -5, 20)).norm(), 0, 1e-9);
  EXPECT_NEAR(before.axes[2], -400 + 20 + 100, 1e-9) << "the spindle nose, 100 mm above the tip";
  const auto& after = trace.blocks[4];
  EXPECT_NEAR((after.position - Vector3(7, -5, 20)).norm(), 0, 1e-9) << "the same place seen from the shifted datum";
  const auto& state = trace.states[after.state];
  EXPECT_EQ(state.follows, records::RunTrace::State::Follows::LinearAxes) << "nothing turns on a mill with three axes";
  EXPECT_NEAR((state.programFrom * Vector3(after.axes[0], after.axes[1], after.axes[2]) - after.position).norm(), 0,
              1e-9);
  EXPECT_FALSE(state.diameter);
  EXPECT_EQ(trace.states[after.state].tool, "1 PROBE");
  EXPECT_EQ(trace.states[after.state].preset, "1");
  EXPECT_GT(trace.blocks.back().seconds, after.seconds);
  options.trace = false;
  EXPECT_TRUE(runText("WAY.H", program, beliefs, machine, options).trace.blocks.empty());
}

/// What the control of a lathe shows: diameters under DIAMON, and positions that do not turn with the main spindle.
TEST(WholeRun, TracesWhatALatheShows) {
  ScriptedMachine machine(*machine::readMachine("lathe2c"));
  control::Beliefs beliefs = probeAbove(ControlKind::Sinumerik840Dsl);
  beliefs.technology = control::Technology::Turning;
  beliefs.zeroOffsets[0].origin = {0, 0, 180};
  RunOptions options;
  options.trace = true;
  const std::string program = "G54 G18 G90 DIAMON\nG0 X120 Z50\nSPOS=180\nG0 X60\nDIAMOF\nG0 X45\nM30\n";
  const RunOutcome outcome = runText("SHAFT.MPF", program, beliefs, machine, options);
  ASSERT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  const auto& trace = outcome.trace;
  const auto xAxis = machine.description().axisIndex("X"), zAxis = machine.description().axisIndex("Z");
  const auto at = [&](std::uint32_t line) {
    return *std::ranges::find(trace.blocks, line, &records::RunTrace::Block::line);
  };
  for (const auto& block : trace.blocks) {
    const auto& state = trace.states[block.state];
    EXPECT_EQ(state.follows, records::RunTrace::State::Follows::LinearAxes) << block.line;
    EXPECT_NEAR((state.programFrom * Vector3(block.axes[*xAxis], 0, block.axes[*zAxis]) - block.position).norm(), 0,
                1e-9)
        << block.line;
    EXPECT_EQ(state.diameter, block.line < 6 && block.line > 0) << block.line;
  }
  EXPECT_NEAR(at(3).position.x(), 60, 1e-9) << "positions are radii, `diameter` says how they are shown";
  EXPECT_NEAR(at(4).position.x(), 60, 1e-9) << "half a turn later";
  EXPECT_NE(at(4).axes[*machine.description().mainSpindle], at(3).axes[*machine.description().mainSpindle]);
  EXPECT_NEAR(at(7).position.x(), 45, 1e-9);
}

TEST(WholeRun, TracesALongProgramInBoundedMemory) {
  ScriptedMachine machine = machineWithProbe();
  const control::Beliefs beliefs = probeAbove(ControlKind::Sinumerik840Dsl);
  RunOptions options;
  options.trace = true;
  const std::string program =
      "G17 G54 G90\nT1 D1\nR1=0\nOUTER:\nG0 X1\nG0 X2\nR2=0\nINNER:\nR2=R2+1\nIF R2<300 GOTOB INNER\n"
      "R1=R1+1\nIF R1<400 GOTOB OUTER\nM30\n";
  const RunOutcome outcome = runText("LOOP.MPF", program, beliefs, machine, options);
  ASSERT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  const auto& blocks = outcome.trace.blocks;
  EXPECT_GT(outcome.result.blocks, 300'000U);
  EXPECT_LE(blocks.size(), 60'001U);
  EXPECT_GT(blocks.size(), 800U) << "all that took time";
  for (std::size_t i = 1; i < blocks.size(); ++i)
    ASSERT_LE(blocks[i - 1].seconds, blocks[i].seconds);
  EXPECT_EQ(outcome.trace.states[blocks.back().state].tool, "T1 PROBE D1");
  EXPECT_EQ(outcome.trace.states[blocks.back().state].preset, "G54");
}

TEST(WholeRun, WithMistakesMovesNothing) {
  ScriptedMachine machine(*machine::readMachine("mill3"));
  const control::Beliefs beliefs = probeAbove(ControlKind::TNC640);
  const std::string program = "BEGIN PGM WRONG MM\nL X+10 FMAX\nLL Y+3\nEND PGM WRONG MM\n";
  const RunOutcome outcome = runText("WRONG.H", program, beliefs, machine, {});
  EXPECT_EQ(outcome.info.exit, records::ExitState::InputMistake);
  ASSERT_FALSE(outcome.diagnostics.empty());
  EXPECT_EQ(outcome.diagnostics.front().place.line, 3u);
  EXPECT_TRUE(machine.lines.empty());
}

TEST(WholeRun, EndsWithAnAlarmThatNamesTheMachinesReason) {
  ScriptedMachine machine = machineWithProbe();
  machine.events[0] = {machine::MoveEnd::Collision, 0.5};
  const control::Beliefs beliefs = probeAbove(ControlKind::TNC640);
  const RunOutcome outcome =
      runText("HIT.H", "BEGIN PGM HIT MM\nTOOL CALL 1 Z\nL X+10 R0 FMAX\nEND PGM HIT MM\n", beliefs, machine, {});
  EXPECT_EQ(outcome.info.exit, records::ExitState::Stopped);
  EXPECT_THAT(outcome.info.exitText, HasSubstr("as the script has it"));
}

}  // namespace
}  // namespace probewright::session
