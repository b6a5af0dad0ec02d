#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/number_text.hpp"
#include "cache_folder.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "interruption.hpp"
#include "machine/links.hpp"
#include "setup/machine_drawing.hpp"
#include "terminal.hpp"

/// Checks a machine file and draws the machine.
namespace probewright::app {

namespace fs = std::filesystem;

namespace {

std::string chainText(const machine::MachineDescription& machine, const machine::Link& end) {
  std::string text = "bed";
  for (std::size_t i = 1; i <= end.elements; ++i)
    text += " -> " + nameOf(machine, {end.chain, i});
  return text;
}

/// "+X", or the numbers of a direction that is none of the axes.
std::string directionText(const Vector3& direction) {
  const char* names[] = {"X", "Y", "Z"};
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (std::abs(direction[i]) > 1 - 1e-9) return fmt::format("{}{}", direction[i] > 0 ? "+" : "-", names[i]);
  }
  return fmt::format("[{}, {}, {}]", formatFixed(direction.x(), 4), formatFixed(direction.y(), 4),
                     formatFixed(direction.z(), 4));
}

/// What goes where when the axis goes to plus.
std::string positiveText(const machine::MachineDescription& machine, std::size_t axis) {
  const bool turns = machine.axes[axis].kind == machine::AxisKind::Rotary;
  const char* verb = turns ? "turns about" : "moves to";
  for (const machine::ChainElement& element : machine.spindleChain)
    if (element.axis == axis) return fmt::format("tool {} {}", verb, directionText(element.direction));
  for (const machine::ChainElement& element : machine.tableChain) {
    if (element.axis == axis)
      return fmt::format("tool {} {}, workpiece {}", verb, directionText(-element.direction),
                         directionText(element.direction));
  }
  return {};
}

std::string axisText(const machine::MachineDescription& machine, std::size_t index) {
  const machine::Axis& axis = machine.axes[index];
  const bool turns = axis.kind == machine::AxisKind::Rotary;
  const std::string travel = axis.modulo ? std::string("without end")
                                         : fmt::format("{} to {} {}", formatShortest(axis.minimum),
                                                       formatShortest(axis.maximum), turns ? "degrees" : "mm");
  const std::string rapid = fmt::format("{} {}", formatShortest(axis.rapid), turns ? "degrees/min" : "mm/min");
  return fmt::format("  {:<3} {:<6}  {:<24}  {:<18}  {}\n", axis.name, turns ? "rotary" : "linear", travel, rapid,
                     positiveText(machine, index));
}

std::string bodiesText(const simulation::Truth& truth) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name, const machine::Link& link) {
    std::string text = fmt::format("{} ({})", name, nameOf(truth.machine, link));
    if (std::ranges::find(names, text) == names.end()) names.push_back(std::move(text));
  };
  for (const simulation::PlacedSolid& solid : truth.solids)
    add(solid.name, setup::linkOf(solid, truth.machine));
  for (const simulation::MachineBody& body : truth.bodies)
    add(body.name, body.link);
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

/// A file that is there is replaced only if it is such a page.
Result<void> write(const fs::path& file, const std::string& page, bool force) {
  std::error_code ignored;
  if (!force && fs::exists(file, ignored)) {
    std::string before;
    if (fs::is_regular_file(file, ignored)) before = readFile(file, largestText).value_or("");
    if (!reports::isMachinePage(before))
      return fail({file.string()}, "there is something of this name that is not the page of a machine",
                  "Name another file with --out, or overwrite it with --force");
  }
  return writeFileAtomically(file, page);
}

}  // namespace

int machine(const MachineArguments& arguments) {
  Diagnostics diagnostics;
  const Interruption interruption;
  simulation::ImportOptions import;
  import.cache = cacheFolder({});
  import.stop = interruption.token();
  const auto world = setup::readMachineWorld(arguments.machine, diagnostics, import);
  if (world) diagnostics.insert(diagnostics.end(), world->remarks.begin(), world->remarks.end());
  print(diagnostics);
  if (!world) return import.stop.stop_requested() ? 3 : 2;
  const machine::MachineDescription& description = world->truth.machine;
  std::string text = fmt::format("{}\n  workpiece  {}\n  tool       {}\n", description.name,
                                 chainText(description, machine::tableLink(description)),
                                 chainText(description, machine::headLink(description)));
  for (std::size_t i = 0; i < description.axes.size(); ++i)
    text += axisText(description, i);
  text += fmt::format("  bodies     {}\n", bodiesText(world->truth));
  std::vector<std::string> remarks;
  for (const Diagnostic& remark : diagnostics)
    remarks.push_back(remark.message + ". " + remark.advice);
  const std::string page = reports::machinePage(
      setup::machineSceneOf(world->truth, setup::Drawn::WhatLiesOnTheTableToo), arguments.machine, remarks);
  if (const auto written = write(arguments.out, page, arguments.force); !written) {
    print({written.error()});
    return 2;
  }
  text += fmt::format("  page       {}\n", arguments.out.string());
  put(printable(text), stdout);
  return 0;
}

}  // namespace probewright::app
