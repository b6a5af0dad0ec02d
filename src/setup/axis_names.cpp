#include "setup/axis_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace probewright::setup {

using machine::AxisKind;

std::optional<std::size_t> axisNamed(TomlReader& reader, std::string_view key, const std::string& name,
                                     const machine::MachineDescription& machine, std::optional<AxisKind> kind) {
  if (machine.axes.empty()) return std::nullopt;  // the machine itself is already reported
  const auto index = machine.axisIndex(name);
  if (index && (!kind || machine.axes[*index].kind == *kind)) return index;
  std::vector<std::string> names;
  for (const machine::Axis& axis : machine.axes) {
    if (!kind || axis.kind == *kind) names.push_back(axis.name);
  }
  const char* what = !kind ? "axis" : *kind == AxisKind::Linear ? "linear axis" : "rotary axis";
  reader.report(key, fmt::format("the machine has no {} called {}", what, name),
                names.empty() ? fmt::format("It has no {}", what) : fmt::format("It has {}", fmt::join(names, ", ")));
  return std::nullopt;
}

}  // namespace probewright::setup
