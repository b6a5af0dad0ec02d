#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "control/sinumerik/control.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "execution/interpreter.hpp"
#include "execution/sinumerik/host.hpp"
#include "language/sinumerik/program.hpp"
#include "machine/machine_file.hpp"
#include "support/willing_machine.hpp"

namespace probewright::language::sinumerik {

using namespace execution;
using namespace execution::sinumerik;

/// A machine that goes wherever it is told, notes it, and whose probe signals at planes.
class NotingMachine : public testing_support::WillingMachine {
public:
  explicit NotingMachine(const std::string& name) : WillingMachine(*machine::readMachine(name)) {}

  struct Move {
    machine::AxisPositions to;
    machine::Feed feed;
  };
  std::vector<Move> moves;
  std::vector<std::size_t> movesBefore;  ///< each M function that was carried out
  /// The probe signals where axis `wallAxis` reaches this reading.
  std::size_t wallAxis = 0;
  std::optional<double> wall;

  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override {
    at_ = target;
    moves.push_back({target, feed});
    return {};
  }
  machine::FunctionResult function(int number) override {
    movesBefore.push_back(moves.size());
    return WillingMachine::function(number);
  }
  machine::MeasureResult measure(const machine::MeasureOrder& order) override {
    const double from = at_[wallAxis], to = order.target[wallAxis];
    if (!wall || (from - *wall) * (to - *wall) >= 0) {
      move(order.target, order.feed);
      return {};
    }
    const double fraction = (*wall - from) / (to - from);
    machine::AxisPositions hit = at_;
    for (std::size_t i = 0; i < machine::maximumAxes; ++i)
      hit[i] += fraction * (order.target[i] - at_[i]);
    move(hit, order.feed);
    return {machine::MeasureEnd::Touched, hit, {}};
  }
};

class Texts : public language::ProgramLibrary {
public:
  std::map<std::string, std::shared_ptr<SinumerikProgram>> programs;
  Result<std::shared_ptr<language::Program>> open(std::string_view name, const language::Program*) override {
    const auto found = programs.find(std::string(name));
    if (found == programs.end()) return fail("there is no program " + std::string(name));
    return found->second;
  }
  bool exists(std::string_view name, const language::Program*) override { return programs.contains(std::string(name)); }
  void add(const std::string& name, const std::string& text) {
    programs[name] = SinumerikProgram::fromText(name + ".SPF", text);
  }
};

/// A control with tools 1 (cutter "MILL", length 100, radius 5) and 2 (probe "PROBE", length 150, radius 3), and
/// programs that run on it.
struct World {
  explicit World(const std::string& machineName = "mill3")
      : machine(machineName), control(machine, data()), host(control) {}

  static control::sinumerik::DataStore data() {
    control::sinumerik::DataStore store;
    control::sinumerik::setMeasuringDefaults(store);
    store.load({"$TC_TP2", {1}}, std::string("MILL"));
    store.load({"$TC_DP1", {1, 1}}, 120.0);
    store.load({"$TC_DP3", {1, 1}}, 100.0);
    store.load({"$TC_DP6", {1, 1}}, 5.0);
    store.load({"$TC_DP1", {1, 2}}, 120.0);
    store.load({"$TC_DP3", {1, 2}}, 90.0);
    store.load({"$TC_TP2", {2}}, std::string("PROBE"));
    store.load({"$TC_DP1", {2, 1}}, 710.0);
    store.load({"$TC_DP3", {2, 1}}, 150.0);
    store.load({"$TC_DP6", {2, 1}}, 3.0);
    return store;
  }

  execution::RunResult tryRun(const std::string& text) {
    execution::InterpreterOptions options;
    options.stepLimit = 100000;
    options.programDepth = SinumerikHost::programDepth;
    return execution::Interpreter(texts, host, options).run(SinumerikProgram::fromText("MAIN.MPF", text));
  }
  /// Runs to the end; every alarm is a failure.
  void run(const std::string& text) {
    const execution::RunResult result = tryRun(text);
    for (const Diagnostic& diagnostic : result.diagnostics)
      ADD_FAILURE() << format(diagnostic);
  }
  /// The number of the alarm that the program ends with.
  std::string alarm(const std::string& text) {
    const execution::RunResult result = tryRun(text);
    EXPECT_EQ(result.end, execution::RunEnd::Alarm) << text;
    return result.diagnostics.empty() ? "" : result.diagnostics.front().code;
  }
  double r(int number) { return control.data.number("R", {number}, -1e99); }
  /// R1 after "R1=expression".
  double value(const std::string& expression) {
    run("R1=" + expression + "\n");
    return r(1);
  }

  NotingMachine machine;
  control::sinumerik::Control control;
  SinumerikHost host;
  Texts texts;
};

}  // namespace probewright::language::sinumerik
