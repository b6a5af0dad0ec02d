#pragma once

#include <utility>

#include "adapter/remote_machine.hpp"

namespace probewright::app {

/// A machine whose moves somebody draws: it does what `machine` does, and an adapter that only draws follows it.
/// Whether something goes wrong is a matter of `machine`.
class DrawnMachine final : public machine::Machine, public machine::OwnControl {
public:
  /// Both outlive it.
  DrawnMachine(machine::Machine& machine, adapter::RemoteMachine& drawing) : machine_(machine), drawing_(drawing) {}

  const machine::MachineDescription& description() const override { return machine_.description(); }
  void stopOn(std::stop_token stop) override {
    drawing_.stopOn(stop);
    machine_.stopOn(std::move(stop));
  }
  machine::AxisPositions position() const override { return machine_.position(); }
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override {
    machine::MoveResult result = machine_.move(target, feed);
    draw(feed);
    return result;
  }
  machine::PathResult moveAlong(std::span<const machine::PathPiece> path) override {
    const machine::PathResult result = machine_.moveAlong(path);
    drawing_.moveAlong(path.first(result.reached));
    if (result.reached < path.size()) draw(path[result.reached].feed);
    return result;
  }
  machine::MeasureResult measure(const machine::MeasureOrder& order) override {
    machine::MeasureResult result = machine_.measure(order);
    draw(order.feed);
    return result;
  }
  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override {
    machine::MoveResult result = machine_.retract(target, feed);
    draw(feed);
    return result;
  }
  bool deflected(machine::Sensor sensor) const override { return machine_.deflected(sensor); }
  std::string probeSerial() const override { return machine_.probeSerial(); }
  machine::MoveResult turnSpindle(machine::Rotation rotation, double speed) override {
    return machine_.turnSpindle(rotation, speed);
  }
  machine::MoveResult orientSpindle(double degrees) override { return machine_.orientSpindle(degrees); }
  machine::SpindleState spindle() const override { return machine_.spindle(); }
  bool hasFunction(int number) const override { return machine_.hasFunction(number); }
  machine::FunctionResult function(int number) override { return machine_.function(number); }
  machine::ToolChangeResult changeTool(const machine::ToolOrder& order) override { return machine_.changeTool(order); }
  machine::WaitEnd dwell(double seconds) override { return machine_.dwell(seconds); }
  double seconds() const override { return machine_.seconds(); }

  const machine::OwnTables* tables() const override { return drawing_.tables(); }
  std::optional<std::string> keep(const machine::OwnTables& tables) override { return drawing_.keep(tables); }
  void accompany(std::function<machine::OrderPlace()> place) override { drawing_.accompany(std::move(place)); }

private:
  void draw(machine::Feed feed) { drawing_.move(machine_.position(), feed); }

  machine::Machine& machine_;
  adapter::RemoteMachine& drawing_;
};

}  // namespace probewright::app
