#pragma once

#include <cstdlib>
#include <functional>
#include <memory>
#include <string>

#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "execution/din_iso/host.hpp"
#include "execution/interpreter.hpp"
#include "execution/klartext/host.hpp"
#include "machine/machine_file.hpp"
#include "support/willing_machine.hpp"

/// A HEIDENHAIN control with a five-axis machine that reaches everything and touches at every target.
namespace probewright::fuzzing {

class TouchingMachine : public testing_support::WillingMachine {
public:
  using WillingMachine::WillingMachine;
  machine::MeasureResult measure(const machine::MeasureOrder& order) override {
    move(order.target, order.feed);
    return {machine::MeasureEnd::Touched, order.target, {}};
  }
};

class NoLibrary : public language::ProgramLibrary {
public:
  Result<std::shared_ptr<language::Program>> open(std::string_view, const language::Program*) override {
    return fail("there are no other programs");
  }
  bool exists(std::string_view, const language::Program*) override { return false; }
};

/// Runs up to 300 blocks; files that the program names have the bytes `fileText`.
inline void run(const std::shared_ptr<language::Program>& program, const std::string& fileText) {
  namespace hh = control::heidenhain;
  static const machine::MachineDescription description = machine::readMachine("mill5-table-table").value();
  static const hh::TypedTable tools = [] {
    hh::TypedTable table = hh::defaultToolTable(control::ControlKind::TNC640);
    for (const char* row : {"1", "5"}) {
      if (!table.setNumber(row, "L", 100) || !table.setNumber(row, "R", 2) || !table.setText(row, "TP_NO", "1")) {
        std::abort();
      }
    }
    return table;
  }();
  TouchingMachine machine(description);
  hh::Control control(control::ControlKind::TNC640, machine,
                      {tools,
                       hh::defaultProbeTable(control::ControlKind::TNC640),
                       hh::defaultPresetTable(control::ControlKind::TNC640),
                       {},
                       {},
                       {},
                       {}});
  control.channel.pathTolerance = 1;
  execution::klartext::HostOptions hostOptions;
  hostOptions.readFile = [&](const std::string&) -> Result<std::string> { return fileText; };
  execution::klartext::KlartextHost klartext(control, hostOptions);
  execution::din_iso::DinIsoHost host(klartext);
  NoLibrary library;
  execution::InterpreterOptions options;
  options.stepLimit = 300;
  execution::Interpreter(library, host, options).run(program);
}

}  // namespace probewright::fuzzing
