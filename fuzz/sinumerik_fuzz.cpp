// Any bytes as a SINUMERIK program: checked, written back, and run on a control with a machine that goes anywhere. What
// is wrong with them comes back as messages and alarms; what can be written back must read the same.

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "control/sinumerik/control.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "execution/interpreter.hpp"
#include "execution/sinumerik/host.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/program.hpp"
#include "language/sinumerik/writer.hpp"
#include "machine/machine_file.hpp"
#include "support/willing_machine.hpp"

namespace {

using namespace probewright;

class TouchingMachine : public testing_support::WillingMachine {
public:
  using WillingMachine::WillingMachine;
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override {
    if (++moves_ > 20000) return {machine::MoveEnd::Cancelled, {}};
    return WillingMachine::move(target, feed);
  }
  machine::MeasureResult measure(const machine::MeasureOrder& order) override {
    move(order.target, order.feed);
    return {moves_ % 2 == 0 ? machine::MeasureEnd::Touched : machine::MeasureEnd::NoContact, position(), {}};
  }

private:
  int moves_ = 0;
};

/// Every second name is the program itself.
class OnlyMain : public language::ProgramLibrary {
public:
  explicit OnlyMain(std::shared_ptr<language::Program> main) : main_(std::move(main)) {}
  Result<std::shared_ptr<language::Program>> open(std::string_view, const language::Program*) override { return main_; }
  bool exists(std::string_view name, const language::Program*) override { return name.size() % 2 == 0; }

private:
  std::shared_ptr<language::Program> main_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const machine::MachineDescription description = *machine::readMachine("mill5-table-table");
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto program = language::sinumerik::SinumerikProgram::fromText("fuzz.mpf", text);
  OnlyMain library(program);
  language::sinumerik::check(*program, {&library, {}});

  language::Block block, second;
  Diagnostics mistakes;
  for (language::BlockPosition at = program->begin(); program->parse(at, block, mistakes); at = block.next) {
    const bool readable = mistakes.empty();
    mistakes.clear();
    if (!readable) continue;
    const auto once = language::sinumerik::writeBlock(block);
    if (!once || once->empty()) continue;
    // As in a program: a line that ends with 0x1A would otherwise end with the mark of the file's end.
    const auto again = language::sinumerik::SinumerikProgram::fromText("again.mpf", *once + "\n");
    again->parse(again->begin(), second, mistakes);
    const auto twice = language::sinumerik::writeBlock(second);
    if (!mistakes.empty() || !twice || *once != *twice) {
      std::cerr << "written: " << *once << "\nread and written again: " << twice.value_or("") << '\n';
      std::abort();
    }
  }

  TouchingMachine machine(description);
  control::sinumerik::DataStore store;
  control::sinumerik::setMeasuringDefaults(store);
  store.load({"$TC_DP1", {1, 1}}, 710.0);
  store.load({"$TC_DP3", {1, 1}}, 100.0);
  store.load({"$TC_DP6", {1, 1}}, 3.0);
  control::sinumerik::Control control(machine, store);
  execution::sinumerik::SinumerikHost host(control);
  execution::InterpreterOptions options;
  options.stepLimit = 500;
  execution::Interpreter(library, host, options).run(program);
  return 0;
}
