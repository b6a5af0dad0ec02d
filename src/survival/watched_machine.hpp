#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/virtual_machine.hpp"

/// What a control has ordered in a run, and the same run again with other answers.
namespace probewright::survival {

enum class StepKind : std::uint8_t { Move, Measure, Retract, Turn, ToolChange };

/// An order of the control that moves something.
struct Step {
  StepKind kind = StepKind::Move;
  machine::AxisPositions from, to;  ///< `to`: as ordered; of turns and tool changes where the axes stand afterwards
  machine::AxisPositions end;       ///< where the axes stand afterwards
  machine::AxisPositions latched;   ///< of measuring moves with a touch
  machine::Feed feed;
  machine::TouchWith part = machine::TouchWith::Ball;
  machine::Sensor sensor = machine::Sensor::TouchProbe;
  bool touched = false;
  int tool = -1;  ///< its place in Truth::tools; -1: none
  double spindleDegrees = 0;
  double seconds = 0;  ///< when it began
};

/// What a measuring move answers, mm along its way from where it begins.
struct PlannedTouch {
  double signal = 0;
  double overtravel = 0;  ///< from there to where the axes stand
};

/// Hands every order on to a virtual machine and writes it down. With a plan nothing on the table counts: the machine
/// has to be one without solids, and measuring moves answer what the plan says, one after the other.
class WatchedMachine final : public machine::Machine, public machine::ToolSpindle, public machine::CameraOwner {
public:
  explicit WatchedMachine(simulation::VirtualMachine& machine, const std::vector<PlannedTouch>* plan = nullptr)
      : machine_(machine), plan_(plan) {}

  const std::vector<Step>& steps() const { return steps_; }

  const machine::MachineDescription& description() const override { return machine_.description(); }
  void stopOn(std::stop_token stop) override { machine_.stopOn(std::move(stop)); }
  machine::AxisPositions position() const override { return machine_.position(); }
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override;
  machine::PathResult moveAlong(std::span<const machine::PathPiece> path) override;
  machine::MeasureResult measure(const machine::MeasureOrder& order) override;
  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override;
  bool deflected(machine::Sensor sensor) const override { return machine_.deflected(sensor); }
  std::string probeSerial() const override { return machine_.probeSerial(); }
  machine::MoveResult turnSpindle(machine::Rotation rotation, double speed) override;
  machine::MoveResult orientSpindle(double degrees) override;
  machine::SpindleState spindle() const override { return machine_.spindle(); }
  bool drivesTools() const override { return machine_.drivesTools(); }
  machine::MoveResult turnTool(machine::Rotation rotation, double speed) override {
    return machine_.turnTool(rotation, speed);
  }
  machine::MoveResult orientTool(double degrees) override { return machine_.orientTool(degrees); }
  machine::SpindleState toolSpindle() const override { return machine_.toolSpindle(); }
  bool hasFunction(int number) const override { return machine_.hasFunction(number); }
  machine::FunctionResult function(int number) override { return machine_.function(number); }
  machine::ToolChangeResult changeTool(const machine::ToolOrder& order) override;
  machine::WaitEnd dwell(double seconds) override { return machine_.dwell(seconds); }
  double seconds() const override { return machine_.seconds(); }
  machine::Camera* camera() override { return machine_.camera(); }

private:
  Step begin(StepKind kind) const;
  void end(Step step);

  simulation::VirtualMachine& machine_;
  const std::vector<PlannedTouch>* plan_;
  std::size_t touches_ = 0;
  std::vector<Step> steps_;
};

/// The way of the linear axes, mm.
double wayOf(const machine::MachineDescription& machine, const machine::AxisPositions& from,
             const machine::AxisPositions& to);

}  // namespace probewright::survival
