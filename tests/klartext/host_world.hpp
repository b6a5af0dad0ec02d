#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/heidenhain/control.hpp"
#include "language/interpreter.hpp"
#include "language/klartext/host.hpp"
#include "language/klartext/program.hpp"
#include "machine/machine.hpp"

namespace probewright::language::klartext::testing {

/// A machine that reaches every target and remembers it.
class TraceMachine : public machine::Machine {
public:
  struct Step {
    machine::AxisPositions axes;
    machine::Feed feed;
  };
  explicit TraceMachine(machine::MachineDescription description) : description_(std::move(description)) {}

  const machine::MachineDescription& description() const override { return description_; }
  machine::AxisPositions position() const override { return axes_; }
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override {
    if (limitX && target[0] > *limitX) return {beyondLimit, "X ends here"};
    axes_ = target;
    steps.push_back({target, feed});
    return {};
  }
  machine::MeasureResult measure(const machine::AxisPositions& target, machine::Feed) override {
    axes_ = target;
    return {};
  }
  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override {
    return move(target, feed);
  }
  bool probeDeflected() const override { return false; }
  machine::MoveResult orientSpindle(double degrees) override {
    angle_ = degrees;
    return {};
  }
  double spindleAngle() const override { return angle_; }
  machine::MoveResult changeTool(const machine::ToolOrder& order) override {
    tools.push_back(order);
    return {};
  }
  void dwell(double seconds) override { seconds_ += seconds; }
  double seconds() const override { return seconds_; }

  std::vector<Step> steps;
  std::vector<machine::ToolOrder> tools;
  std::optional<double> limitX;  ///< moves beyond it are refused
  machine::MoveEnd beyondLimit = machine::MoveEnd::AxisLimit;

private:
  machine::MachineDescription description_;
  machine::AxisPositions axes_;
  double angle_ = 0;
  double seconds_ = 0;
};

/// Programs in memory, by name.
class MemoryLibrary : public ProgramLibrary {
public:
  std::map<std::string, std::string> texts;
  Result<std::shared_ptr<Program>> open(std::string_view name, const Program* caller) override;
  bool exists(std::string_view name, const Program*) override { return texts.contains(std::string(name)); }
};

/// A HEIDENHAIN control on a ready-made machine, with tools 1 (length 100, radius 2) and 5 "MILL" (length 50, radius
/// 5).
struct World {
  explicit World(const std::string& machineName = "mill3", control::ControlKind kind = control::ControlKind::TNC640);
  explicit World(machine::MachineDescription description, control::ControlKind kind = control::ControlKind::TNC640);
  /// Runs a program; block numbers and frame may be left out.
  RunResult run(const std::string& text);
  /// Tips reached by the moves so far, in machine coordinates without the tool's length: with preset 0 and no tilt the
  /// program's coordinates.
  std::vector<Vector3> path() const;
  double q(int number) const { return control->q.q(number); }
  /// What the operator has seen of one kind.
  std::vector<std::string> told(control::EventKind kind) const;

  std::unique_ptr<TraceMachine> machine;
  std::unique_ptr<control::heidenhain::Control> control;
  MemoryLibrary library;
  std::map<std::string, std::string> files;  ///< that programs can read
  HostOptions options;
};

}  // namespace probewright::language::klartext::testing
