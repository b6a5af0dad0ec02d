#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/heidenhain/control.hpp"
#include "execution/interpreter.hpp"
#include "execution/klartext/host.hpp"
#include "language/klartext/program.hpp"
#include "support/willing_machine.hpp"

namespace probewright::language::klartext::testing {

using namespace execution;
using namespace execution::klartext;

/// A machine that reaches every target and remembers it.
class TraceMachine : public testing_support::WillingMachine {
public:
  struct Step {
    machine::AxisPositions axes;
    machine::Feed feed;
  };
  using WillingMachine::WillingMachine;

  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override {
    if (limitX && target[0] > *limitX) return {beyondLimit, "X ends here"};
    at_ = target;
    steps.push_back({target, feed});
    return {};
  }
  machine::MeasureResult measure(const machine::MeasureOrder& order) override {
    at_ = order.target;
    return {};
  }

  std::vector<Step> steps;
  std::optional<double> limitX;  ///< moves beyond it are refused
  machine::MoveEnd beyondLimit = machine::MoveEnd::AxisLimit;
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
