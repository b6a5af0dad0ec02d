#include <gtest/gtest.h>

#include "simulation/virtual_machine.hpp"
#include "support/virtual_world.hpp"

/// A rotary axis with a Hirth coupling stands at the positions of its grid only.
namespace probewright::simulation {
namespace {

using machine::AxisPositions;
using machine::Feed;
using machine::MoveEnd;

struct Machine {
  Machine() : machine(truth()) { machine.insertTool({1, ""}); }

  static Truth truth() {
    Truth truth = testing_support::perfectWorld("mill5-table-table");
    truth.hirthGrid[*truth.machine.axisIndex("A")] = 2.5;
    truth.solids.clear();
    return truth;
  }
  machine::MoveResult turn(double a, double x = 0) {
    AxisPositions target = machine.position();
    target[*machine.description().axisIndex("A")] = a;
    target[*machine.description().axisIndex("X")] = x;
    return machine.move(target, Feed::rapidTraverse());
  }

  VirtualMachine machine;
};

TEST(HirthCoupling, LetsTheAxisStandOnItsGridOnly) {
  Machine on;
  for (const double a : {2.5, -40.0, 0.0, 90.0, 87.5 + 1e-7})
    EXPECT_EQ(on.turn(a).end, MoveEnd::Reached) << a;
  const auto refused = on.turn(88);
  EXPECT_EQ(refused.end, MoveEnd::Refused);
  EXPECT_EQ(refused.detail, "axis A has a Hirth coupling: it stands at multiples of 2.5 degrees, not at 88.0000");
  EXPECT_EQ(on.turn(87.5 + 1e-7, 20).end, MoveEnd::Reached) << "an axis that stays where it is does not matter";
  machine::MeasureOrder order{on.machine.position(), Feed::at(100)};
  order.target[*on.machine.description().axisIndex("A")] = 86;
  EXPECT_EQ(on.machine.measure(order).end, machine::MeasureEnd::Refused);
  EXPECT_EQ(on.machine.retract(order.target, Feed::at(100)).end, MoveEnd::Refused);
  const std::vector<machine::PathPiece> path = {{on.machine.position(), Feed::at(100)}, {order.target, Feed::at(100)}};
  EXPECT_EQ(on.machine.moveAlong(path).end, MoveEnd::Refused);
}

TEST(HirthCoupling, IsUnlockedWhereSomethingStoppedTheAxis) {
  Truth truth = Machine::truth();
  // A block that the probe meets while the table turns.
  testing_support::place(truth, Box({-20, -20, -20}, {20, 20, 20}), translation({0, -150, -530}));
  VirtualMachine machine(truth);
  machine.insertTool({1, ""});
  const std::size_t a = *machine.description().axisIndex("A"), z = *machine.description().axisIndex("Z");
  AxisPositions target = machine.position();
  target[z] = -430;
  machine.move(target, Feed::rapidTraverse());
  target[a] = -90;
  MoveEnd first = machine.move(target, Feed::rapidTraverse()).end;
  if (first == MoveEnd::Reached) {
    target[a] = 90;
    first = machine.move(target, Feed::rapidTraverse()).end;
  }
  ASSERT_NE(first, MoveEnd::Reached) << "the probe must be in the way";
  EXPECT_GT(std::abs(std::remainder(machine.position()[a], 2.5)), 1e-3);
  AxisPositions up = machine.position();
  up[z] = 0;
  EXPECT_EQ(machine.retract(up, Feed::rapidTraverse()).end, MoveEnd::Reached) << "away, with the axis where it stands";
  up[a] = 0;
  EXPECT_EQ(machine.move(up, Feed::rapidTraverse()).end, MoveEnd::Reached);
}

}  // namespace
}  // namespace probewright::simulation
