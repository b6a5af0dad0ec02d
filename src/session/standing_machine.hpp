#pragma once

#include <optional>

#include "machine/machine.hpp"

namespace probewright::session {

/// A machine whose axes stand while a program runs: program test and block search. Positions are counted as if they
/// were reached, travels are watched, nothing touches anything and no time passes. Once it is released it is the
/// machine.
class StandingMachine : public machine::Machine {
public:
  /// Begins released.
  explicit StandingMachine(machine::Machine& machine) : machine_(machine) {}

  /// From now on the axes stand.
  void hold();
  /// From now on the machine itself moves. The caller brings it to position() as it was before, with the tool and the
  /// spindle angle that were ordered last.
  void release() { released_ = true; }
  const std::optional<machine::ToolOrder>& orderedTool() const { return tool_; }
  const std::optional<double>& orderedAngle() const { return orderedAngle_; }

  const machine::MachineDescription& description() const override { return machine_.description(); }
  machine::AxisPositions position() const override { return released_ ? machine_.position() : at_; }
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override;
  machine::MeasureResult measure(const machine::AxisPositions& target, machine::Feed feed) override;
  machine::MeasureResult measureWithShaft(const machine::AxisPositions& target, machine::Feed feed) override {
    return released_ ? machine_.measureWithShaft(target, feed) : measure(target, feed);
  }
  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override;
  bool probeDeflected() const override { return released_ && machine_.probeDeflected(); }
  machine::MoveResult orientSpindle(double degrees) override;
  double spindleAngle() const override { return released_ ? machine_.spindleAngle() : angle_; }
  machine::MoveResult changeTool(const machine::ToolOrder& order) override;
  void dwell(double seconds) override;
  double seconds() const override { return machine_.seconds(); }

private:
  machine::MoveResult countTo(const machine::AxisPositions& target);

  machine::Machine& machine_;
  bool released_ = true;
  machine::AxisPositions at_;
  double angle_ = 0;
  std::optional<double> orderedAngle_;
  std::optional<machine::ToolOrder> tool_;
};

}  // namespace probewright::session
