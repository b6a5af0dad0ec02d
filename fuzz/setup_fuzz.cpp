#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "machine/machine_file.hpp"
#include "setup/setup.hpp"
#include "simulation/virtual_machine.hpp"

using namespace probewright;

// Any bytes as a setup and as a machine file: either a value or at least one mistake with a text; a machine that was
// read can be built, and refuses to leave its travel.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto require = [](bool holds) {
    if (!holds) std::abort();
  };
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup(bytes, "setup.toml", diagnostics);
  require(setup.has_value() == diagnostics.empty());
  for (const Diagnostic& diagnostic : diagnostics)
    require(!format(diagnostic).empty());
  simulation::Truth truth;
  if (setup) truth = setup->world.truth;

  diagnostics.clear();
  const auto machine = machine::parseMachine(bytes, "machine.toml", diagnostics);
  require(machine.has_value() == diagnostics.empty());
  for (const Diagnostic& diagnostic : diagnostics)
    require(!format(diagnostic).empty());
  if (machine) truth.machine = *machine;

  if (!setup && !machine) return 0;
  simulation::VirtualMachine virtualMachine(truth);
  for (const simulation::TrueTool& tool : truth.tools)
    virtualMachine.changeTool({tool.number, {}});
  for (std::size_t i = 0; i < truth.machine.axes.size(); ++i) {
    machine::AxisPositions target = virtualMachine.position();
    target[i] = truth.machine.axes[i].maximum;
    virtualMachine.move(target, machine::Feed::rapidTraverse());
    target[i] += 1;
    const auto result = virtualMachine.move(target, machine::Feed::at(100));
    if (!truth.machine.axes[i].modulo) require(result.end != machine::MoveEnd::Reached);
  }
  return 0;
}
