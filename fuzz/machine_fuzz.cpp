#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "machine/description.hpp"
#include "machine/machine_file.hpp"

using namespace probewright;

// Any bytes as a machine file: a machine or at least one mistake with a place. The chains of a machine are rigid
// wherever its axes stand.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto require = [](bool holds) {
    if (!holds) std::abort();
  };
  Diagnostics diagnostics;
  const auto machine = machine::parseMachine({reinterpret_cast<const char*>(data), size}, "machine.toml", diagnostics);
  require(machine.has_value() == diagnostics.empty());
  for (const Diagnostic& diagnostic : diagnostics)
    require(diagnostic.place.file == "machine.toml" && !diagnostic.message.empty());
  if (!machine) return 0;
  require(!machine->axes.empty() && machine->axes.size() <= machine::maximumAxes);
  machine::AxisPositions low, high;
  for (std::size_t i = 0; i < machine->axes.size(); ++i) {
    low[i] = machine->axes[i].minimum;
    high[i] = machine->axes[i].maximum;
  }
  for (const machine::AxisPositions& position : {machine->toolChange, low, high}) {
    for (const Pose& pose : {baseFromTable(*machine, position), baseFromSpindle(*machine, position)}) {
      const Matrix3 turn = pose.linear();
      require(!pose.matrix().allFinite() || (turn * turn.transpose() - Matrix3::Identity()).norm() < 1e-6);
    }
  }
  return 0;
}
