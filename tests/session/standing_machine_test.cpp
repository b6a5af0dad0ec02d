#include "session/standing_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <array>

#include "machine/machine_file.hpp"
#include "support/axis_positions.hpp"
#include "support/scripted_machine.hpp"

/// What program test and block search see of the machine.
namespace probewright::session {
namespace {

using machine::Feed;
using machine::FunctionEnd;
using machine::MoveEnd;
using machine::Rotation;
using machine::ToolChangeEnd;
using testing::ElementsAre;
using testing::IsEmpty;
using testing_support::positions;
using testing_support::ScriptedMachine;

struct Standing : testing::Test {
  Standing() { machine.hold(); }
  ScriptedMachine inner{*machine::readMachine("mill3")};
  StandingMachine machine{inner};
};

TEST_F(Standing, CountsMovesAsReachedWithinTheTravel) {
  EXPECT_EQ(machine.move(positions({10, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  const std::array<machine::PathPiece, 2> path = {
      {{positions({20, 0, 0}), Feed::at(100)}, {positions({20, 5000, 0}), Feed::at(100)}}};
  const auto travelled = machine.moveAlong(path);
  EXPECT_EQ(travelled.end, MoveEnd::AxisLimit);
  EXPECT_EQ(travelled.reached, 1u);
  EXPECT_EQ(machine.position(), positions({20, 0, 0}));
  EXPECT_EQ(machine.move(positions({0, 0, 0}), Feed::at(0)).end, MoveEnd::Refused);
  EXPECT_EQ(machine.measure({positions({30, 0, 0}), Feed::at(100)}).end, machine::MeasureEnd::NoContact);
  EXPECT_EQ(machine.dwell(100), machine::WaitEnd::Over);
  EXPECT_EQ(machine.seconds(), 0);
  EXPECT_THAT(inner.lines, IsEmpty());
}

TEST_F(Standing, KeepsWhatTheMachineHasToCatchUpWith) {
  EXPECT_EQ(machine.turnSpindle(Rotation::Clockwise, 500).end, MoveEnd::Reached);
  EXPECT_EQ(machine.changeTool({2, "MILL"}).end, ToolChangeEnd::Changed);
  EXPECT_EQ(machine.spindle().rotation, Rotation::None) << "the change has stopped it";
  EXPECT_FALSE(machine.orders().rotation);
  machine.orientSpindle(45);
  EXPECT_EQ(machine.orders().angle, 45);
  machine.turnSpindle(Rotation::CounterClockwise, 700);
  EXPECT_FALSE(machine.orders().angle) << "it has turned since";
  inner.functions.insert(50);
  for (const int number : {8, 50, 7, 9, 50, 8})
    EXPECT_EQ(machine.function(number).end, FunctionEnd::CarriedOut);
  EXPECT_EQ(machine.function(51).end, FunctionEnd::Unknown);
  ASSERT_TRUE(machine.orders().tool && machine.orders().rotation);
  EXPECT_EQ(machine.orders().tool->number, 2);
  EXPECT_EQ(machine.orders().rotation->rotation, Rotation::CounterClockwise);
  EXPECT_EQ(machine.orders().rotation->speed, 700);
  EXPECT_THAT(machine.orders().functions, ElementsAre(50, 8)) << "M9 ended M7, and M8 ended that";
  for (const int number : {50, 8, 9})
    machine.function(number);
  EXPECT_THAT(machine.orders().functions, ElementsAre(50, 9)) << "M9 ended M8 and nothing else";
  EXPECT_THAT(inner.orders, IsEmpty());
}

TEST_F(Standing, TakesTheSpeedsThatAMachineTakes) {
  for (const Rotation rotation : {Rotation::Clockwise, Rotation::CounterClockwise}) {
    for (const double speed : {0.0, 0.5, 1e5}) {
      EXPECT_EQ(machine.turnSpindle(rotation, speed).end, MoveEnd::Reached) << speed;
      ASSERT_TRUE(machine.orders().rotation);
      EXPECT_EQ(machine.orders().rotation->speed, speed);
    }
    for (const double speed : {-1.0, -1e-9, std::nan(""), HUGE_VAL})
      EXPECT_EQ(machine.turnSpindle(rotation, speed).end, MoveEnd::Refused) << speed;
  }
  EXPECT_EQ(machine.turnSpindle(Rotation::None, -1).end, MoveEnd::Reached) << "no speed to stop with";
}

TEST_F(Standing, IsTheMachineOnceItIsReleased) {
  machine.release();
  machine.turnSpindle(Rotation::Clockwise, 500);
  machine.function(8);
  machine.changeTool({2, ""});
  EXPECT_THAT(inner.orders, ElementsAre("clockwise 500", "M8", "tool 2"));
  EXPECT_EQ(machine.move(positions({10, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(inner.position(), positions({10, 0, 0}));
}

TEST_F(Standing, IsStoppedLikeTheMachine) {
  std::stop_source source;
  machine.stopOn(source.get_token());
  source.request_stop();
  EXPECT_EQ(machine.move(positions({10, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Cancelled);
  EXPECT_EQ(machine.measure({positions({10, 0, 0}), Feed::at(100)}).end, machine::MeasureEnd::Cancelled);
  EXPECT_EQ(machine.changeTool({2, ""}).end, ToolChangeEnd::Cancelled);
  EXPECT_EQ(machine.dwell(1), machine::WaitEnd::Cancelled);
  EXPECT_EQ(machine.turnSpindle(Rotation::None, 0).end, MoveEnd::Reached);
  machine.release();
  EXPECT_EQ(machine.move(positions({10, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Cancelled);
}

}  // namespace
}  // namespace probewright::session
