#pragma once

#include <optional>
#include <vector>

#include "control/channel.hpp"
#include "machine/machine.hpp"
#include "machine/tool_spindle.hpp"

namespace probewright::session {

/// What a program has ordered while the axes stood.
struct StandingOrders {
  std::optional<machine::ToolOrder> tool;
  std::optional<double> angle;                    ///< the spindle was oriented, and has not turned since
  std::optional<machine::SpindleState> rotation;  ///< the spindle was turned on or off, and not oriented since
  std::optional<double> toolAngle;                ///< the same of the spindle of driven tools
  std::optional<machine::SpindleState> toolRotation;
  std::vector<int> functions;  ///< M functions, each once, in the order in which they came last
};

/// A machine whose axes stand while a program runs: program test and block search. Positions are counted as if they
/// were reached, travels are watched, nothing touches anything and no time passes. Once it is released it is the
/// machine.
class StandingMachine : public machine::Machine, public machine::ToolSpindle {
public:
  /// Begins released.
  explicit StandingMachine(machine::Machine& machine)
      : machine_(machine), toolSpindle_(dynamic_cast<machine::ToolSpindle*>(&machine)) {}

  /// From now on the axes stand.
  void hold();
  /// From now on the machine itself moves. The caller brings it to position() as it was before, with what orders()
  /// says.
  void release() { released_ = true; }
  const StandingOrders& orders() const { return orders_; }

  const machine::MachineDescription& description() const override { return machine_.description(); }
  void stopOn(std::stop_token stop) override;
  machine::AxisPositions position() const override { return released_ ? machine_.position() : at_; }
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override;
  machine::PathResult moveAlong(std::span<const machine::PathPiece> path) override;
  machine::MeasureResult measure(const machine::MeasureOrder& order) override;
  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override;
  bool deflected(machine::Sensor sensor) const override { return released_ && machine_.deflected(sensor); }
  std::string probeSerial() const override { return released_ ? machine_.probeSerial() : std::string(); }
  machine::MoveResult turnSpindle(machine::Rotation rotation, double speed) override;
  machine::MoveResult orientSpindle(double degrees) override;
  machine::SpindleState spindle() const override { return released_ ? machine_.spindle() : spindle_; }
  bool drivesTools() const override { return toolSpindle_ != nullptr && toolSpindle_->drivesTools(); }
  machine::MoveResult turnTool(machine::Rotation rotation, double speed) override;
  machine::MoveResult orientTool(double degrees) override;
  machine::SpindleState toolSpindle() const override { return released_ ? toolSpindle_->toolSpindle() : driven_; }
  bool hasFunction(int number) const override { return machine_.hasFunction(number); }
  machine::FunctionResult function(int number) override;
  machine::ToolChangeResult changeTool(const machine::ToolOrder& order) override;
  machine::WaitEnd dwell(double seconds) override;
  double seconds() const override { return machine_.seconds(); }

private:
  std::optional<machine::MoveResult> refusal(machine::Feed feed) const;
  machine::MoveResult countTo(const machine::AxisPositions& target, machine::Feed feed);

  std::optional<machine::MoveResult> refusedTurn(machine::Rotation rotation, double speed) const;
  std::optional<machine::MoveResult> refusedAngle(double degrees) const;

  machine::Machine& machine_;
  machine::ToolSpindle* toolSpindle_;
  std::stop_token stop_;
  bool released_ = true;
  machine::AxisPositions at_;
  machine::SpindleState spindle_, driven_;
  StandingOrders orders_;
};

/// From now on the machine itself moves: it catches up with what was ordered while the axes stood, tool, spindle and M
/// functions, and goes to where they were counted to be. `last`: the axis along the tool, which goes up before the
/// others and down after them; without it all go straight, together.
void catchUp(StandingMachine& machine, control::Channel& channel, std::optional<std::size_t> last = std::nullopt);

}  // namespace probewright::session
