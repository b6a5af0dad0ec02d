// Any bytes as a Klartext program: checked, written back, and run on a control with a five-axis machine that reaches
// everything. What was read without a mistake is written so that it reads without a mistake again.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "language/interpreter.hpp"
#include "language/klartext/check.hpp"
#include "language/klartext/host.hpp"
#include "language/klartext/writer.hpp"
#include "machine/machine.hpp"
#include "machine/machine_file.hpp"

namespace {

using namespace probewright;
using namespace probewright::language;
namespace hh = control::heidenhain;

class WillingMachine : public machine::Machine {
public:
  explicit WillingMachine(const machine::MachineDescription& description) : description_(description) {}
  const machine::MachineDescription& description() const override { return description_; }
  machine::AxisPositions position() const override { return axes_; }
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed) override {
    axes_ = target;
    return {};
  }
  machine::MeasureResult measure(const machine::AxisPositions& target, machine::Feed) override {
    axes_ = target;
    return {machine::MeasureEnd::Touched, target, {}};
  }
  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override {
    return move(target, feed);
  }
  bool probeDeflected() const override { return false; }
  machine::MoveResult orientSpindle(double) override { return {}; }
  double spindleAngle() const override { return 0; }
  machine::MoveResult changeTool(const machine::ToolOrder&) override { return {}; }
  void dwell(double) override {}
  double seconds() const override { return 0; }

private:
  const machine::MachineDescription& description_;
  machine::AxisPositions axes_;
};

class NoLibrary : public ProgramLibrary {
public:
  Result<std::shared_ptr<Program>> open(std::string_view, const Program*) override {
    return fail("there are no other programs");
  }
  bool exists(std::string_view, const Program*) override { return false; }
};

void writeBack(klartext::KlartextProgram& program) {
  Block block, again;
  Diagnostics mistakes;
  BlockPosition position = program.begin();
  while (mistakes.clear(), program.parse(position, block, mistakes)) {
    position = block.next;
    if (!mistakes.empty()) continue;
    klartext::KlartextProgram written("written.h", klartext::writeBlock(block) + "\n");
    const bool read = written.parse(written.begin(), again, mistakes);
    const bool same =
        again.instructions.size() == block.instructions.size() && again.words.size() == block.words.size();
    if (!block.instructions.empty() && (!read || !mistakes.empty() || !same)) std::abort();
  }
  klartext::writeProgram(program);
}

void run(const std::string& text) {
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
  WillingMachine machine(description);
  hh::Control control(control::ControlKind::TNC640, machine,
                      {tools,
                       hh::defaultProbeTable(control::ControlKind::TNC640),
                       hh::defaultPresetTable(control::ControlKind::TNC640),
                       {}});
  control.channel.pathTolerance = 1;
  klartext::HostOptions hostOptions;
  hostOptions.readFile = [&](const std::string&) -> Result<std::string> { return text; };
  klartext::KlartextHost host(control, hostOptions);
  NoLibrary library;
  InterpreterOptions options;
  options.stepLimit = 300;
  Interpreter(library, host, options).run(std::make_shared<klartext::KlartextProgram>("fuzz.h", text));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  klartext::KlartextProgram program("fuzz.h", text);
  for (const Diagnostic& mistake : klartext::checkProgram(program, control::ControlKind::iTNC530)) {
    if (mistake.message.empty() || mistake.place.line == 0) std::abort();
  }
  writeBack(program);
  run(text);
  return 0;
}
