#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "machine/machine.hpp"

namespace probewright::testing_support {

/// A machine that does whatever it is told, wherever that is, and never touches anything. For tests of what a control
/// orders: they override what they look at.
class WillingMachine : public machine::Machine {
public:
  explicit WillingMachine(machine::MachineDescription description) : description_(std::move(description)) {}

  std::vector<machine::ToolOrder> tools;
  std::vector<machine::SpindleState> spindleOrders;  ///< each time that the spindle was turned on or off
  std::vector<int> functions;                        ///< that were carried out
  std::vector<int> has = {7, 8, 9};                  ///< M functions

  const machine::MachineDescription& description() const override { return description_; }
  void stopOn(std::stop_token) override {}
  machine::AxisPositions position() const override { return at_; }
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed) override {
    at_ = target;
    return {};
  }
  machine::PathResult moveAlong(std::span<const machine::PathPiece> path) override {
    for (std::size_t i = 0; i < path.size(); ++i) {
      machine::MoveResult piece = move(path[i].target, path[i].feed);
      if (piece.end != machine::MoveEnd::Reached) return {piece.end, i, std::move(piece.detail)};
    }
    return {machine::MoveEnd::Reached, path.size(), {}};
  }
  machine::MeasureResult measure(const machine::MeasureOrder& order) override {
    move(order.target, order.feed);
    return {};
  }
  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override {
    return move(target, feed);
  }
  bool deflected(machine::Sensor) const override { return false; }
  machine::MoveResult turnSpindle(machine::Rotation rotation, double speed) override {
    spindle_.rotation = rotation;
    spindle_.speed = rotation == machine::Rotation::None ? 0 : speed;
    spindleOrders.push_back(spindle_);
    return {};
  }
  machine::MoveResult orientSpindle(double degrees) override {
    spindle_ = {machine::Rotation::None, 0, degrees};
    return {};
  }
  machine::SpindleState spindle() const override { return spindle_; }
  bool hasFunction(int number) const override {
    for (const int known : has)
      if (known == number) return true;
    return false;
  }
  machine::FunctionResult function(int number) override {
    if (!hasFunction(number)) return {machine::FunctionEnd::Unknown, {}};
    functions.push_back(number);
    return {};
  }
  machine::ToolChangeResult changeTool(const machine::ToolOrder& order) override {
    tools.push_back(order);
    if (!description_.mainSpindle) spindle_.rotation = machine::Rotation::None;
    return {};
  }
  machine::WaitEnd dwell(double seconds) override {
    seconds_ += seconds;
    return machine::WaitEnd::Over;
  }
  double seconds() const override { return seconds_; }

protected:
  machine::AxisPositions at_;

private:
  machine::MachineDescription description_;
  machine::SpindleState spindle_;
  double seconds_ = 0;
};

}  // namespace probewright::testing_support
