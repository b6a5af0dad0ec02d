#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <stop_token>
#include <thread>

#include "adapter/remote_machine.hpp"
#include "support/scripted_machine.hpp"
#include "support/served_machine.hpp"
#include "support/virtual_world.hpp"

/// What machine.hpp promises, of every machine: the virtual one, here and at the other end of a socket, one that
/// answers from a script, and the example of a machine adapter. A world in words of the machine: tool 1 is a touch
/// probe, tool 2 a cutter. The probe signals at Z-300 on its way down. The side of the tool touch probe signals at X24
/// for the cutter that comes at Z-290 along X. There is no tool 7.
namespace probewright {
namespace {

using machine::AxisPositions;
using machine::Feed;
using machine::FunctionEnd;
using machine::MeasureEnd;
using machine::MoveEnd;
using machine::PathPiece;
using machine::Rotation;
using machine::Sensor;
using machine::ToolChangeEnd;
using testing_support::perfectWorld;
using testing_support::place;
using testing_support::positions;
using testing_support::ScriptedMachine;

std::unique_ptr<machine::Machine> virtualMachine() {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.serial = "4711";
  simulation::TrueTool mill;
  mill.number = 2;
  mill.kind = simulation::ToolKind::Cutter;
  mill.length = 100;
  mill.radius = 6;
  truth.tools.push_back(mill);
  place(truth, simulation::HalfSpace({Vector3(0, 0, -400), Vector3::UnitZ()}));
  testing_support::placeToolProbe(truth, simulation::Box({30, -20, -400}, {70, 20, -360}));
  return std::make_unique<simulation::VirtualMachine>(std::move(truth));
}

std::unique_ptr<machine::Machine> scriptedMachine() {
  return std::make_unique<ScriptedMachine>(*machine::readMachine("mill3"));
}

/// At the other end of a socket: the virtual machine, and the example of an adapter in another language.
std::unique_ptr<machine::Machine> remote(Result<adapter::Connection> connection) {
  if (!connection) throw std::runtime_error(format(connection.error()));
  auto machine = adapter::RemoteMachine::greet(std::move(*connection));
  if (!machine) throw std::runtime_error(format(machine.error()));
  return std::move(*machine);
}

std::unique_ptr<machine::Machine> servedMachine() { return remote(testing_support::served(virtualMachine())); }

std::unique_ptr<machine::Machine> exampleAdapter() {
  return remote(adapter::connect("python3 " PROBEWRIGHT_EXAMPLES "/adapters/plane.py"));
}

struct Maker {
  const char* name;
  std::unique_ptr<machine::Machine> (*make)();
};
void PrintTo(const Maker& maker, std::ostream* out) { *out << maker.name; }

class MachineContract : public testing::TestWithParam<Maker> {
protected:
  void SetUp() override { ASSERT_EQ(machine.changeTool({1, ""}).end, ToolChangeEnd::Changed); }

  /// What a machine without a world has to be told: the next measuring move meets a surface there.
  void meets(std::size_t axis, double reading) {
    if (scripted != nullptr) scripted->signals.emplace_back(ScriptedMachine::Signal{axis, reading});
  }
  /// The same of the line after `lines` others.
  void happens(MoveEnd end, double fraction, std::size_t lines = 0) {
    if (scripted != nullptr) scripted->events[scripted->lines.size() + lines] = {end, fraction};
  }
  MoveEnd to(std::initializer_list<double> target, Feed feed = Feed::rapidTraverse()) {
    return machine.move(positions(target), feed).end;
  }
  machine::MeasureResult measureDown() {
    meets(2, -300);
    return machine.measure({positions({0, 0, -310}), Feed::at(300)});
  }
  void isAt(std::initializer_list<double> target) { EXPECT_EQ(machine.position(), positions(target)); }

  std::unique_ptr<machine::Machine> owner = GetParam().make();
  machine::Machine& machine = *owner;
  ScriptedMachine* scripted = dynamic_cast<ScriptedMachine*>(owner.get());
};

TEST_P(MachineContract, DescribesItsAxes) {
  ASSERT_EQ(machine.description().axes.size(), 3u);
  EXPECT_EQ(machine.description().axes[2].name, "Z");
}

TEST_P(MachineContract, AMoveReachesItsTargetAndTakesItsTime) {
  ASSERT_EQ(to({0, 0, -100}), MoveEnd::Reached);
  const double before = machine.seconds();
  EXPECT_EQ(to({100, 0, -100}, Feed::at(600)), MoveEnd::Reached);
  isAt({100, 0, -100});
  EXPECT_GE(machine.seconds() - before, 10 - 1e-9) << "100 mm at 10 mm/s";
  EXPECT_LT(machine.seconds() - before, 11);
}

TEST_P(MachineContract, WithoutAFeedNothingMoves) {
  const AxisPositions start = machine.position();
  const auto moved = machine.move(positions({1, 0, 0}), Feed::at(0));
  EXPECT_EQ(moved.end, MoveEnd::Refused);
  EXPECT_FALSE(moved.detail.empty());
  EXPECT_EQ(machine.retract(positions({1, 0, 0}), Feed::at(-1)).end, MoveEnd::Refused);
  EXPECT_EQ(machine.measure({positions({1, 0, 0}), Feed::at(0)}).end, MeasureEnd::Refused);
  const std::array<PathPiece, 1> path = {{{positions({1, 0, 0}), Feed::at(0)}}};
  EXPECT_EQ(machine.moveAlong(path).end, MoveEnd::Refused);
  EXPECT_EQ(machine.position(), start);
}

TEST_P(MachineContract, BeyondTheTravelNothingMoves) {
  const AxisPositions start = machine.position();
  const auto moved = machine.move(positions({5000, 0, 0}), Feed::rapidTraverse());
  EXPECT_EQ(moved.end, MoveEnd::AxisLimit);
  EXPECT_NE(moved.detail.find('X'), std::string::npos) << moved.detail;
  EXPECT_EQ(machine.retract(positions({0, 5000, 0}), Feed::rapidTraverse()).end, MoveEnd::AxisLimit);
  EXPECT_EQ(machine.measure({positions({0, 0, -5000}), Feed::at(300)}).end, MeasureEnd::AxisLimit);
  EXPECT_EQ(machine.position(), start);
}

TEST_P(MachineContract, ASignalOnAMoveStopsItUntilTheAxesLeave) {
  to({0, 0, -290});
  happens(MoveEnd::ProbeSignal, 0.51);
  EXPECT_EQ(to({0, 0, -310}, Feed::at(300)), MoveEnd::ProbeSignal);
  const AxisPositions stopped = machine.position();
  EXPECT_LE(stopped[2], -300);
  EXPECT_GT(stopped[2], -310);
  EXPECT_TRUE(machine.deflected(Sensor::TouchProbe));
  EXPECT_FALSE(machine.deflected(Sensor::ToolTouchProbe));
  EXPECT_EQ(to({0, 0, -200}), MoveEnd::ProbeSignal) << "only retract() leaves a contact";
  EXPECT_EQ(machine.position(), stopped);
  EXPECT_EQ(machine.retract(positions({0, 0, -290}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_FALSE(machine.deflected(Sensor::TouchProbe));
  isAt({0, 0, -290});
}

TEST_P(MachineContract, ACollisionStopsAMove) {
  ASSERT_EQ(machine.changeTool({2, ""}).end, ToolChangeEnd::Changed);
  to({-100, 0, -290});
  happens(MoveEnd::Collision, 0.5);
  EXPECT_EQ(to({-100, 0, -310}), MoveEnd::Collision);
  EXPECT_NEAR(machine.position()[2], -300, 0.01);
  EXPECT_FALSE(machine.deflected(Sensor::TouchProbe));
  EXPECT_EQ(machine.retract(positions({-100, 0, -200}), Feed::rapidTraverse()).end, MoveEnd::Reached);
}

TEST_P(MachineContract, APathGoesThroughItsPiecesWithTheFeedOfEach) {
  to({0, 0, -100});
  const double before = machine.seconds();
  const std::array<PathPiece, 3> path = {{{positions({10, 0, -100}), Feed::at(600)},
                                          {positions({10, 10, -100}), Feed::at(300)},
                                          {positions({20, 10, -100}), Feed::rapidTraverse()}}};
  const auto travelled = machine.moveAlong(path);
  EXPECT_EQ(travelled.end, MoveEnd::Reached);
  EXPECT_EQ(travelled.reached, 3u);
  isAt({20, 10, -100});
  EXPECT_GE(machine.seconds() - before, 1 + 2) << "10 mm at 10 mm/s, 10 mm at 5 mm/s";
  EXPECT_LT(machine.seconds() - before, 1 + 2 + 0.3);
  EXPECT_EQ(machine.moveAlong({}).end, MoveEnd::Reached);
  isAt({20, 10, -100});
}

TEST_P(MachineContract, APathSaysAtWhichPieceATouchEndedIt) {
  to({-50, 0, -290});
  happens(MoveEnd::ProbeSignal, 0.51, 1);
  const std::array<PathPiece, 3> path = {{{positions({-40, 0, -290}), Feed::at(600)},
                                          {positions({-40, 0, -310}), Feed::at(300)},
                                          {positions({-30, 0, -310}), Feed::at(300)}}};
  const auto travelled = machine.moveAlong(path);
  EXPECT_EQ(travelled.end, MoveEnd::ProbeSignal);
  EXPECT_EQ(travelled.reached, 1u);
  EXPECT_EQ(machine.position()[0], -40);
  EXPECT_LE(machine.position()[2], -300);
  EXPECT_GT(machine.position()[2], -310);
}

TEST_P(MachineContract, APathStopsBeforeThePieceThatLeavesTheTravel) {
  to({-50, 0, -100});
  const std::array<PathPiece, 3> path = {{{positions({-40, 0, -100}), Feed::at(600)},
                                          {positions({-40, 5000, -100}), Feed::at(600)},
                                          {positions({-30, 0, -100}), Feed::at(600)}}};
  const auto travelled = machine.moveAlong(path);
  EXPECT_EQ(travelled.end, MoveEnd::AxisLimit);
  ASSERT_LE(travelled.reached, 1u);
  EXPECT_EQ(machine.position(), travelled.reached == 1 ? path[0].target : positions({-50, 0, -100}));
}

TEST_P(MachineContract, MeasuringLatchesWhereTheProbeSignals) {
  to({0, 0, -290});
  const auto measured = measureDown();
  ASSERT_EQ(measured.end, MeasureEnd::Touched) << measured.detail;
  EXPECT_NEAR(measured.latched[2], -300, 1e-9);
  EXPECT_EQ(measured.latched[0], 0);
  EXPECT_LE(machine.position()[2], measured.latched[2]);
  EXPECT_GT(machine.position()[2], -310) << "the axes stop; the machine does not retract";
  EXPECT_TRUE(machine.deflected(Sensor::TouchProbe));
  const AxisPositions stopped = machine.position();
  EXPECT_EQ(measureDown().end, MeasureEnd::DeflectedAtStart);
  EXPECT_EQ(machine.position(), stopped);
  EXPECT_EQ(machine.retract(positions({0, 0, -250}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_FALSE(machine.deflected(Sensor::TouchProbe));
}

TEST_P(MachineContract, MeasuringWithTheShaftSignalsForTheBallToo) {
  to({0, 0, -290});
  meets(2, -300);
  const auto measured =
      machine.measure({positions({0, 0, -310}), Feed::at(300), Sensor::TouchProbe, machine::TouchWith::Shaft});
  ASSERT_EQ(measured.end, MeasureEnd::Touched) << measured.detail;
  EXPECT_NEAR(measured.latched[2], -300, 1e-9);
}

TEST_P(MachineContract, MeasuringIntoTheAirReachesTheTarget) {
  to({0, 0, -200});
  EXPECT_EQ(machine.measure({positions({0, 0, -250}), Feed::at(300)}).end, MeasureEnd::NoContact);
  isAt({0, 0, -250});
  EXPECT_FALSE(machine.deflected(Sensor::TouchProbe));
}

TEST_P(MachineContract, OnlyTheSensorThatIsAskedSignals) {
  ASSERT_EQ(machine.changeTool({2, ""}).end, ToolChangeEnd::Changed);
  to({0, 0, -290});
  EXPECT_EQ(machine.measure({positions({40, 0, -290}), Feed::at(300), Sensor::TouchProbe}).end, MeasureEnd::NotReady);
  isAt({0, 0, -290});
  meets(0, 24);
  const auto measured = machine.measure({positions({40, 0, -290}), Feed::at(300), Sensor::ToolTouchProbe});
  ASSERT_EQ(measured.end, MeasureEnd::Touched) << measured.detail;
  EXPECT_NEAR(measured.latched[0], 24, 0.01) << "a shaft touches to within 0.01 mm";
  EXPECT_TRUE(machine.deflected(Sensor::ToolTouchProbe));
  EXPECT_FALSE(machine.deflected(Sensor::TouchProbe));
  EXPECT_EQ(machine.changeTool({1, ""}).end, ToolChangeEnd::ProbeSignal) << "the tool still leans on it";
  EXPECT_EQ(machine.retract(positions({0, 0, -290}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_FALSE(machine.deflected(Sensor::ToolTouchProbe));
}

TEST_P(MachineContract, ASensorThatCannotSignalIsNotReady) {
  to({0, 0, -200});
  EXPECT_EQ(machine.measure({positions({0, 0, -250}), Feed::at(300), Sensor::ToolTouchProbe}).end, MeasureEnd::NotReady)
      << "it measures tools, not touch probes";
  ASSERT_EQ(machine.changeTool({0, ""}).end, ToolChangeEnd::Changed);
  const AxisPositions start = machine.position();
  EXPECT_EQ(machine.measure({positions({0, 0, -250}), Feed::at(300)}).end, MeasureEnd::NotReady);
  EXPECT_EQ(machine.measure({positions({0, 0, -250}), Feed::at(300), Sensor::ToolTouchProbe}).end,
            MeasureEnd::NotReady);
  EXPECT_EQ(machine.position(), start);
}

TEST_P(MachineContract, TheProbeTellsItsSerialNumber) {
  EXPECT_EQ(machine.probeSerial(), "4711");
  ASSERT_EQ(machine.changeTool({2, ""}).end, ToolChangeEnd::Changed);
  EXPECT_EQ(machine.probeSerial(), "");
}

TEST_P(MachineContract, TheSpindleTurnsAndStands) {
  EXPECT_EQ(machine.spindle().rotation, Rotation::None);
  EXPECT_EQ(machine.turnSpindle(Rotation::Clockwise, 1200).end, MoveEnd::Reached);
  EXPECT_EQ(machine.spindle().rotation, Rotation::Clockwise);
  EXPECT_EQ(machine.spindle().speed, 1200);
  EXPECT_EQ(machine.turnSpindle(Rotation::CounterClockwise, 800).end, MoveEnd::Reached);
  EXPECT_EQ(machine.spindle().rotation, Rotation::CounterClockwise);
  EXPECT_EQ(machine.spindle().speed, 800);
  EXPECT_EQ(machine.turnSpindle(Rotation::Clockwise, -1).end, MoveEnd::Refused);
  EXPECT_EQ(machine.spindle().rotation, Rotation::CounterClockwise) << "as before";
  EXPECT_EQ(machine.turnSpindle(Rotation::None, 500).end, MoveEnd::Reached);
  EXPECT_EQ(machine.spindle().rotation, Rotation::None);
  EXPECT_EQ(machine.spindle().speed, 0);
}

TEST_P(MachineContract, OrientingStopsTheSpindle) {
  machine.turnSpindle(Rotation::Clockwise, 1200);
  EXPECT_EQ(machine.orientSpindle(30).end, MoveEnd::Reached);
  EXPECT_EQ(machine.spindle().rotation, Rotation::None);
  EXPECT_EQ(machine.spindle().speed, 0);
  EXPECT_EQ(machine.spindle().angle, 30);
  EXPECT_EQ(machine.orientSpindle(std::numeric_limits<double>::quiet_NaN()).end, MoveEnd::Refused);
  EXPECT_EQ(machine.spindle().angle, 30);
}

TEST_P(MachineContract, FunctionsAreCarriedOutOrUnknown) {
  EXPECT_TRUE(machine.hasFunction(8));
  EXPECT_EQ(machine.function(8).end, FunctionEnd::CarriedOut);
  EXPECT_EQ(machine.function(9).end, FunctionEnd::CarriedOut);
  EXPECT_FALSE(machine.hasFunction(77));
  EXPECT_EQ(machine.function(77).end, FunctionEnd::Unknown);
}

TEST_P(MachineContract, TheChangerChangesOrSaysWhyNot) {
  to({10, 0, -290});
  const AxisPositions start = machine.position();
  const double before = machine.seconds();
  EXPECT_EQ(machine.changeTool({1, ""}).end, ToolChangeEnd::Changed) << "it is in the spindle";
  EXPECT_EQ(machine.position(), start);
  EXPECT_EQ(machine.seconds(), before);
  const auto missing = machine.changeTool({7, ""});
  EXPECT_EQ(missing.end, ToolChangeEnd::Missing);
  EXPECT_NE(missing.detail.find('7'), std::string::npos);
  EXPECT_EQ(machine.position(), start);
  to({0, 0, -290});
  ASSERT_EQ(measureDown().end, MeasureEnd::Touched);
  EXPECT_EQ(machine.changeTool({2, ""}).end, ToolChangeEnd::ProbeSignal);
  EXPECT_EQ(machine.probeSerial(), "4711") << "the probe is still in the spindle";
  machine.retract(positions({0, 0, -290}), Feed::rapidTraverse());
  machine.turnSpindle(Rotation::Clockwise, 100);
  EXPECT_EQ(machine.changeTool({2, ""}).end, ToolChangeEnd::Changed);
  EXPECT_EQ(machine.position(), machine.description().toolChange);
  EXPECT_EQ(machine.spindle().rotation, Rotation::None) << "no tool is changed in a turning spindle";
}

TEST_P(MachineContract, WaitingMovesTheClock) {
  const double before = machine.seconds();
  EXPECT_EQ(machine.dwell(2.5), machine::WaitEnd::Over);
  EXPECT_GE(machine.seconds() - before, 2.5 - 1e-9);
  const double after = machine.seconds();
  EXPECT_EQ(machine.dwell(-5), machine::WaitEnd::Over);
  EXPECT_GE(machine.seconds(), after) << "the clock never goes back";
}

TEST_P(MachineContract, AfterAStopNothingMovesUntilThereIsAnotherToken) {
  to({0, 0, -200});
  machine.turnSpindle(Rotation::Clockwise, 100);
  std::stop_source source;
  machine.stopOn(source.get_token());
  EXPECT_EQ(to({1, 0, -200}), MoveEnd::Reached) << "nobody has asked yet";
  source.request_stop();
  const AxisPositions start = machine.position();
  EXPECT_EQ(to({2, 0, -200}), MoveEnd::Cancelled);
  EXPECT_EQ(machine.retract(positions({2, 0, -200}), Feed::at(10)).end, MoveEnd::Cancelled);
  EXPECT_EQ(machine.measure({positions({2, 0, -200}), Feed::at(10)}).end, MeasureEnd::Cancelled);
  const std::array<PathPiece, 1> path = {{{positions({2, 0, -200}), Feed::at(10)}}};
  const auto travelled = machine.moveAlong(path);
  EXPECT_EQ(travelled.end, MoveEnd::Cancelled);
  EXPECT_EQ(travelled.reached, 0u);
  EXPECT_EQ(machine.orientSpindle(90).end, MoveEnd::Cancelled);
  EXPECT_EQ(machine.turnSpindle(Rotation::Clockwise, 200).end, MoveEnd::Cancelled);
  EXPECT_EQ(machine.function(8).end, FunctionEnd::Cancelled);
  EXPECT_EQ(machine.changeTool({2, ""}).end, ToolChangeEnd::Cancelled);
  EXPECT_EQ(machine.dwell(1), machine::WaitEnd::Cancelled);
  EXPECT_EQ(machine.position(), start);
  EXPECT_EQ(machine.spindle().speed, 100);
  EXPECT_EQ(machine.turnSpindle(Rotation::None, 0).end, MoveEnd::Reached) << "the spindle can always be stopped";
  EXPECT_EQ(machine.spindle().rotation, Rotation::None);
  machine.stopOn({});
  EXPECT_EQ(to({2, 0, -200}), MoveEnd::Reached);
}

/// A path that goes on and on; the stop comes from another thread while it does.
TEST_P(MachineContract, AStopFromAnotherThreadEndsThePathThatIsUnderWay) {
  to({0, 0, -200});
  std::stop_source source;
  machine.stopOn(source.get_token());
  std::atomic<bool> underWay = false;
  std::jthread stopper([&] {
    while (!underWay)
      std::this_thread::yield();
    source.request_stop();
  });
  if (scripted != nullptr) scripted->endless = scripted->lines.size() + 1500;
  std::vector<PathPiece> path;
  for (int i = 0; i < 1000; ++i)
    path.push_back({positions({i % 2 == 0 ? 10.0 : 0.0, 0, -200}), Feed::at(6000)});
  machine::PathResult travelled;
  underWay = true;
  do {
    travelled = machine.moveAlong(path);
  } while (travelled.end == MoveEnd::Reached);
  EXPECT_EQ(travelled.end, MoveEnd::Cancelled);
  EXPECT_LT(travelled.reached, path.size());
  const AxisPositions stopped = machine.position();
  EXPECT_GE(stopped[0], 0);
  EXPECT_LE(stopped[0], 10);
  EXPECT_EQ(stopped[2], -200);
  EXPECT_EQ(to({0, 0, -100}), MoveEnd::Cancelled);
  EXPECT_EQ(machine.position(), stopped) << "the axes stand";
}

INSTANTIATE_TEST_SUITE_P(Machines, MachineContract,
                         testing::Values(Maker{"Virtual", virtualMachine}, Maker{"Scripted", scriptedMachine},
                                         Maker{"Served", servedMachine}, Maker{"ExampleAdapter", exampleAdapter}),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace probewright
