#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <numbers>
#include <stop_token>
#include <thread>

#include "execution/interpreter.hpp"
#include "execution/klartext/host.hpp"
#include "execution/sinumerik/host.hpp"
#include "machine/machine_file.hpp"
#include "session/heidenhain/beliefs.hpp"
#include "session/sinumerik/beliefs.hpp"
#include "session/source.hpp"
#include "support/scripted_machine.hpp"

/// Controls on a machine that is no simulation: whole programs of both vendors, and everything that can end them.
namespace probewright::session {
namespace {

using control::ControlKind;
using control::EventKind;
using execution::RunEnd;
using execution::RunResult;
using machine::MoveEnd;
using testing::ElementsAre;
using testing::HasSubstr;
using testing_support::ScriptedMachine;

/// Probe T1 (length 100, ball radius 2), cutter T2, and T5 that the control has in its table only. The workpiece lies
/// at Z-400: with the probe in the spindle the axis Z reads 300 less than the program has.
control::Beliefs beliefsOf(ControlKind kind) {
  control::Beliefs beliefs;
  beliefs.control = kind;
  const auto add = [&](int number, const char* name, const char* toolKind, double length, double radius) {
    control::BelievedTool tool;
    tool.number = number;
    tool.name = name;
    tool.kind = toolKind;
    tool.length = length;
    tool.radius = tool.axialRadius = radius;
    beliefs.tools.push_back(tool);
  };
  add(1, "PROBE", "probe", 100, 2);
  add(2, "MILL", "mill", 80, 5);
  add(5, "DRILL", "drill", 120, 4);
  control::BelievedFrame frame;
  frame.index = 1;
  frame.name = kind == ControlKind::TNC640 ? "" : "G54";
  frame.origin = {0, 0, -400};
  frame.active = true;
  (kind == ControlKind::TNC640 ? beliefs.presets : beliefs.zeroOffsets).push_back(frame);
  return beliefs;
}

class NoOtherPrograms : public language::ProgramLibrary {
public:
  Result<std::shared_ptr<language::Program>> open(std::string_view, const language::Program*) override {
    return fail("there are no other programs");
  }
  bool exists(std::string_view, const language::Program*) override { return false; }
};

/// What both controls are run by.
RunResult runOn(ScriptedMachine& machine, execution::Host& host, const char* name, const std::string& text,
                ControlKind kind, const std::stop_token& stop) {
  machine.stopOn(stop);
  NoOtherPrograms library;
  execution::InterpreterOptions options;
  options.stop = stop;
  return execution::Interpreter(library, host, options).run(programOf(name, text, languageFor(kind, name, text)));
}

template <class Control>
std::vector<std::string> told(const Control& control, EventKind kind) {
  std::vector<std::string> texts;
  for (const control::EventRecord& event : control.journal.events) {
    if (event.kind == kind) texts.push_back(event.text);
  }
  return texts;
}

struct Klartext {
  Klartext() { control.activatePreset(1); }
  RunResult run(const std::string& blocks, const std::stop_token& stop = {}) {
    execution::klartext::KlartextHost host(control, {});
    return runOn(machine, host, "MAIN.H", "BEGIN PGM MAIN MM\n" + blocks + "END PGM MAIN MM\n", ControlKind::TNC640,
                 stop);
  }
  control::Beliefs beliefs = beliefsOf(ControlKind::TNC640);
  Diagnostics diagnostics;
  ScriptedMachine machine{*machine::readMachine("mill3")};
  control::heidenhain::Control control{ControlKind::TNC640, machine,
                                       heidenhain::heidenhainTables(beliefs, ControlKind::TNC640, diagnostics),
                                       heidenhain::machineParameters(beliefs, ControlKind::TNC640, diagnostics)};
};

struct Sinumerik {
  Sinumerik() {
    control.activateSettable(1);
    control.applyFrames();
  }
  RunResult run(const std::string& blocks, const std::stop_token& stop = {}) {
    execution::sinumerik::SinumerikHost host(control);
    return runOn(machine, host, "MAIN.MPF", "G17 G54 G90\n" + blocks + "M30\n", ControlKind::Sinumerik840Dsl, stop);
  }
  double r(int number) { return control.data.number("R", {number}, -1e99); }
  control::Beliefs beliefs = beliefsOf(ControlKind::Sinumerik840Dsl);
  Diagnostics diagnostics;
  ScriptedMachine machine{*machine::readMachine("mill3")};
  control::sinumerik::Control control{machine, sinumerik::sinumerikData(beliefs, diagnostics).store};
};

std::string why(const RunResult& result) {
  return result.diagnostics.empty() ? std::string() : format(result.diagnostics.front());
}

const std::string measureHole =
    "TOOL CALL 2 Z S1500\n"
    "L X+10 Y+0 Z+50 R0 F5000 M3\n"
    "L X+0 M8\n"
    "TOOL CALL S800\n"
    "M9\n"
    "M5\n"
    "TOOL CALL 1 Z\n"
    "L X+0 Y+0 Z+20 R0 FMAX\n"
    "TCH PROBE 421 MEASURE HOLE ~\n"
    "Q273=+0 Q274=+0 Q262=+40 Q325=+0 Q247=+90 Q261=-5 Q320=+2 Q260=+20 Q301=+0 Q275=+40.5 Q276=+39.5 Q279=+1 ~\n"
    "Q280=+1 Q281=+0 Q309=+0 Q330=+0\n";

/// The readings of X and Y at which the ball in a bore of 40 mm about (x, y) signals on its ways out from the origin.
void scriptBore(ScriptedMachine& machine, double x, double y) {
  const double reach = 20 - 2;
  const double alongX = std::sqrt(reach * reach - y * y), alongY = std::sqrt(reach * reach - x * x);
  using Signal = ScriptedMachine::Signal;
  machine.signals = {Signal{0, x + alongX}, Signal{1, y + alongY}, Signal{0, x - alongX}, Signal{1, y - alongY}};
}

TEST(ScriptedMachineUnderKlartext, MeasuresABoreAndTurnsTheSpindle) {
  Klartext world;
  scriptBore(world.machine, 0.3, -0.2);
  const RunResult result = world.run(measureHole);
  ASSERT_EQ(result.end, RunEnd::Finished) << why(result);
  EXPECT_NEAR(world.control.q.q(151), 0.3, 1e-9);
  EXPECT_NEAR(world.control.q.q(152), -0.2, 1e-9);
  EXPECT_NEAR(world.control.q.q(153), 40, 1e-9);
  EXPECT_THAT(world.machine.orders,
              ElementsAre("tool 2", "clockwise 1500", "M8", "clockwise 800", "M9", "spindle off", "tool 1"));
  EXPECT_EQ(world.machine.measured, std::vector<machine::Sensor>(4, machine::Sensor::TouchProbe));
  EXPECT_EQ(world.control.tables.probes.text("1", "SERIAL"), "4711");
}

TEST(ScriptedMachineUnderKlartext, ATouchThatDoesNotComeIsTheControlsAlarm) {
  Klartext world;
  scriptBore(world.machine, 0, 0);
  world.machine.signals[1].reset();
  const RunResult result = world.run(measureHole);
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(result.diagnostics.front().code, "Touch point inaccessible");
  EXPECT_EQ(world.machine.measured.size(), 2u);
}

/// The end of a program stops what still runs.
TEST(ScriptedMachineUnderKlartext, TheEndOfTheProgramStopsSpindleAndCoolant) {
  Klartext world;
  ASSERT_EQ(world.run("TOOL CALL 2 Z S1500\nM14\n").end, RunEnd::Finished);
  EXPECT_THAT(world.machine.orders, ElementsAre("tool 2", "counterclockwise 1500", "M8", "spindle off", "M9"));
}

TEST(ScriptedMachineUnderKlartext, AnArcIsOnePath) {
  Klartext world;
  const RunResult result =
      world.run("TOOL CALL 2 Z S1500\nL X+20 Y+0 Z+50 R0 FMAX\nCC X+0 Y+0\nC X-20 Y+0 DR+ F1000\n");
  ASSERT_EQ(result.end, RunEnd::Finished) << why(result);
  EXPECT_EQ(world.machine.paths, 1u);
  const auto pieces = std::ranges::count_if(world.machine.lines, &ScriptedMachine::Line::ofPath);
  EXPECT_GT(pieces, 50);
  EXPECT_NEAR(world.machine.position()[0], -20, 1e-9);
  // From Z320 (the spindle nose at Z0 of the machine, less the cutter) to Z50 and X20, then half a circle of 40 mm.
  EXPECT_NEAR(world.control.channel.pathLength(), std::hypot(20, 270) + 20 * std::numbers::pi, 1e-2);
}

TEST(ScriptedMachineUnderKlartext, ASignalOnAPathStopsTheProgramThere) {
  Klartext world;
  world.machine.events[1 + 10] = {MoveEnd::ProbeSignal, 0.25};
  const RunResult result =
      world.run("TOOL CALL 1 Z\nL X+20 Y+0 Z+50 R0 FMAX\nCC X+0 Y+0\nC X-20 Y+0 DR+ F1000\nL Z+100 FMAX\n");
  ASSERT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(result.diagnostics.front().code, "Touch probe deflected");
  ASSERT_EQ(world.machine.lines.size(), 12u) << "nothing moves after the piece of the signal";
  const auto& lines = world.machine.lines;
  for (int axis = 0; axis < 2; ++axis) {
    const double before = lines[10].target[axis], after = lines[11].target[axis];
    EXPECT_NEAR(world.machine.position()[axis], before + 0.25 * (after - before), 1e-12);
  }
}

TEST(ScriptedMachineUnderKlartext, ALimitOnAPathIsKnownBeforeAnythingMoves) {
  Klartext world;
  const RunResult result = world.run("TOOL CALL 2 Z\nL X+450 Y+0 Z+50 R0 FMAX\nCC X+500 Y+0\nC X+450 Y+0 DR- F1000\n");
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(result.diagnostics.front().code, "Limit switch");
  EXPECT_THAT(result.diagnostics.front().message, HasSubstr("software limit of X"));
  EXPECT_EQ(world.machine.position()[0], 450);
}

TEST(ScriptedMachineUnderKlartext, AToolThatTheMagazineLacksIsNamed) {
  Klartext world;
  const RunResult result = world.run("TOOL CALL 5 Z S500\nL X+10 FMAX\n");
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(result.diagnostics.front().code, "Tool not in the magazine");
  EXPECT_THAT(result.diagnostics.front().message, HasSubstr("no pocket holds tool 5"));
  EXPECT_TRUE(world.machine.lines.empty());
}

TEST(ScriptedMachineUnderKlartext, AToolByHandWaitsForTheOperator) {
  Klartext world;
  world.machine.byHand = {5};
  ASSERT_EQ(world.run("TOOL CALL 5 Z S500\n").end, RunEnd::Finished);
  EXPECT_THAT(told(world.control, EventKind::Stop),
              ElementsAre("Put in tool 5 DRILL: the magazine has no pocket for it"));
  EXPECT_THAT(world.machine.orders, ElementsAre("tool 5"));

  Klartext nobodyThere;
  nobodyThere.machine.byHand = {5};
  nobodyThere.control.panel.onStop = control::OnStop::Abort;
  EXPECT_EQ(nobodyThere.run("TOOL CALL 5 Z S500\nL X+10 FMAX\n").end, RunEnd::Cancelled);
  EXPECT_TRUE(nobodyThere.machine.orders.empty());
}

TEST(ScriptedMachineUnderKlartext, AChangerThatCannotWorkStopsTheProgram) {
  Klartext world;
  world.machine.changerRefuses = "the door is open";
  const RunResult result = world.run("TOOL CALL 2 Z\n");
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(result.diagnostics.front().code, "Machine not ready");
  EXPECT_THAT(result.diagnostics.front().message, HasSubstr("the door is open"));
}

TEST(ScriptedMachineUnderKlartext, FunctionsOfTheBuilderAreTheMachines) {
  Klartext has, lacks;
  has.machine.functions.insert(50);
  ASSERT_EQ(has.run("TOOL CALL 2 Z\nM50\nM51\nM51\nM120 LA10\n").end, RunEnd::Finished);
  EXPECT_THAT(has.machine.orders, ElementsAre("tool 2", "M50"));
  EXPECT_THAT(told(has.control, EventKind::Skipped), ElementsAre(HasSubstr("M51"), HasSubstr("M120")));
  ASSERT_EQ(lacks.run("M50\n").end, RunEnd::Finished);
  EXPECT_THAT(told(lacks.control, EventKind::Skipped), ElementsAre(HasSubstr("M50")));
}

/// The stop comes from another thread while line `line` of the machine is half done.
template <class World>
RunResult stopDuring(World& world, std::size_t line, const std::string& program) {
  std::stop_source source;
  std::promise<void> underWay;
  world.machine.endless = line;
  world.machine.lasting = [&] { underWay.set_value(); };
  std::jthread operatorsHand([&, begun = underWay.get_future()] {
    begun.wait();
    source.request_stop();
  });
  return world.run(program, source.get_token());
}

TEST(ScriptedMachineUnderKlartext, AStopInTheMiddleOfAMoveEndsTheProgramThere) {
  Klartext world;
  const RunResult result =
      stopDuring(world, 1, "TOOL CALL 2 Z S500\nL X+100 Y+0 Z+50 R0 FMAX M3\nL X+200 F500\nL X+300\nL Z+100\n");
  EXPECT_EQ(result.end, RunEnd::Cancelled);
  EXPECT_THAT(why(result), HasSubstr("the run was interrupted at this block"));
  EXPECT_EQ(result.diagnostics.front().place.line, 4u);
  EXPECT_EQ(world.machine.position()[0], 150) << "half way";
  EXPECT_EQ(world.machine.lines.size(), 2u);
  EXPECT_THAT(world.machine.orders, ElementsAre("tool 2", "clockwise 500", "spindle off"));
}

TEST(ScriptedMachineUnderKlartext, AStopInTheMiddleOfATouchWritesNothing) {
  Klartext world;
  scriptBore(world.machine, 0.3, -0.2);
  // Down and across with the cutter, then with the probe to the first place: its touch is stopped.
  Klartext whole;
  scriptBore(whole.machine, 0.3, -0.2);
  std::size_t touch = 0;
  ASSERT_EQ(whole.run(measureHole).end, RunEnd::Finished);
  while (whole.machine.lines[touch].feed.perMinute != 300)
    ++touch;
  const RunResult result = stopDuring(world, touch, measureHole);
  EXPECT_EQ(result.end, RunEnd::Cancelled);
  EXPECT_EQ(world.machine.lines.size(), touch + 1);
  ASSERT_EQ(world.control.journal.cycles.size(), 1u);
  EXPECT_TRUE(world.control.journal.cycles[0].results.empty());
}

const std::string measureEdge =
    "T=\"MILL\" M6\n"
    "S1500 M3\n"
    "G0 X10 Y0 Z50 M8\n"
    "S800\n"
    "M9\n"
    "M5\n"
    "T=\"PROBE\" D1 M6\n"
    "G0 X-40 Y0 Z20\n"
    "Z-10\n"
    "CYCLE978(100,10001,,1,-30,8,5,1,1,1,\"\",,0)\n"
    "R1=$P_UIFR[1,X,TR]\n"
    "G0 Z50\n";

TEST(ScriptedMachineUnderSinumerik, MeasuresAnEdgeAndTurnsTheSpindle) {
  Sinumerik world;
  // The edge at X-29.5 instead of X-30: the ball's centre is 2 mm before it.
  world.machine.signals = {ScriptedMachine::Signal{0, -31.5}};
  const RunResult result = world.run(measureEdge);
  ASSERT_EQ(result.end, RunEnd::Finished) << why(result);
  EXPECT_NEAR(world.r(1), 0.5, 1e-9);
  EXPECT_THAT(world.machine.orders,
              ElementsAre("tool 2", "clockwise 1500", "M8", "clockwise 800", "M9", "spindle off", "tool 1"));
}

/// Measuring input 1 is that of the workpiece probe, 2 that of the tool touch probe.
TEST(ScriptedMachineUnderSinumerik, AMeasuringBlockNamesItsSensor) {
  Sinumerik world;
  world.machine.signals = {ScriptedMachine::Signal{0, 5}, ScriptedMachine::Signal{0, 6}};
  const RunResult result = world.run(
      "T=\"PROBE\" D1 M6\nG0 X0\nMEAS=1 G1 X20 F300\nR1=$AA_MM[X] R2=$A_PROBE[1] R3=$A_PROBE[2]\nG0 X0\n"
      "T=\"MILL\" D1 M6\nG0 X0\nMEAS=2 G1 X20 F300\nR4=$AA_MM[X] R5=$A_PROBE[1] R6=$A_PROBE[2]\nG0 X0\n");
  ASSERT_EQ(result.end, RunEnd::Finished) << why(result);
  EXPECT_THAT(world.machine.measured, ElementsAre(machine::Sensor::TouchProbe, machine::Sensor::ToolTouchProbe));
  const std::array<double, 6> expected = {5, 1, 0, 6, 0, 1};
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(world.r(i + 1), expected[static_cast<std::size_t>(i)], 1e-9) << "R" << i + 1;
}

TEST(ScriptedMachineUnderSinumerik, ASignalOnAPathStopsTheProgramThere) {
  Sinumerik world;
  world.machine.events[2 + 10] = {MoveEnd::ProbeSignal, 0.25};
  const RunResult result = world.run("T=\"PROBE\" D1 M6\nG0 X20 Y0\nG0 Z50\nG3 X-20 Y0 I-20 J0 F1000\nG0 Z100\n");
  ASSERT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(result.diagnostics.front().code, "61302");
  EXPECT_EQ(world.machine.lines.size(), 13u);
  EXPECT_EQ(world.machine.paths, 1u);
}

TEST(ScriptedMachineUnderSinumerik, WhatTheMachineAnswersIsTheControlsAlarm) {
  Sinumerik missing, door, limit;
  EXPECT_EQ(missing.run("T=\"DRILL\" M6\n").diagnostics.front().code, "22066");
  door.machine.changerRefuses = "the door is open";
  EXPECT_EQ(door.run("T=\"MILL\" M6\n").diagnostics.front().code, "700000");
  EXPECT_EQ(limit.run("T=\"MILL\" D1 M6\nG0 X450 Z50\nG2 X450 Y0 I50 J0 F1000\n").diagnostics.front().code, "10720");
  EXPECT_EQ(limit.machine.position()[0], 450);
}

TEST(ScriptedMachineUnderSinumerik, AStopInTheMiddleOfAPathEndsTheProgramThere) {
  Sinumerik world;
  const RunResult result =
      stopDuring(world, 5, "R5=7\nT=\"MILL\" D1 M6\nS500 M4\nG0 X20 Y0 Z50\nG3 X-20 Y0 I-20 J0 F1000\nR5=8\nG0 Z100\n");
  EXPECT_EQ(result.end, RunEnd::Cancelled);
  EXPECT_EQ(world.machine.lines.size(), 6u);
  EXPECT_TRUE(world.machine.lines.back().ofPath);
  EXPECT_EQ(world.r(5), 7) << "what the program has stored stays";
  EXPECT_EQ(world.machine.orders.back(), "spindle off");
}

TEST(ScriptedMachineUnderSinumerik, FunctionsThatTheControlDoesNotKnowAreTheMachines) {
  Sinumerik world;
  world.machine.functions.insert(77);
  ASSERT_EQ(world.run("M77\nM78\nM78\nM40\n").end, RunEnd::Finished);
  EXPECT_THAT(world.machine.orders, ElementsAre("M77"));
  EXPECT_THAT(told(world.control, EventKind::Skipped), ElementsAre(HasSubstr("M78")));
}

/// G96 S in m/min: the speed follows X up to LIMS.
TEST(ScriptedMachineUnderSinumerik, TheSpindleFollowsConstantCuttingSpeed) {
  Sinumerik world;
  const RunResult result =
      world.run("T=\"MILL\" D1 M6\nG0 X50 Z50\nG96 S100 M3 LIMS=2000\nG1 X25 F0.2\nG1 X0\nSPOS=0\nS50\n");
  ASSERT_EQ(result.end, RunEnd::Finished) << why(result);
  const auto& orders = world.machine.orders;
  ASSERT_GE(orders.size(), 3u);
  const std::string clockwise = "clockwise ";
  const std::string& atX25 = orders[orders.size() - 2];
  ASSERT_TRUE(atX25.starts_with(clockwise)) << atX25;
  EXPECT_NEAR(std::stod(atX25.substr(clockwise.size())), 100 * 1000 / (2 * std::numbers::pi * 25), 1e-3);
  EXPECT_EQ(orders.back(), "clockwise 2000") << "at the centre LIMS counts; an oriented spindle waits for M3";
}

}  // namespace
}  // namespace probewright::session
