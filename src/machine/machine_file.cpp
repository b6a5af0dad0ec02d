#include "machine/machine_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "base/file.hpp"
#include "base/text.hpp"
#include "base/toml_table.hpp"
#include "machine/linuxcnc_machine.hpp"
#include "machine/machine_text.hpp"
#include "machine/ready_made.hpp"
#include "machine/table_body.hpp"

namespace probewright::machine {

namespace {

/// mm or degrees; no machine is larger.
constexpr NumberRange anyPlace = NumberRange::within(1e6);

Axis readAxis(TomlReader& reader, const std::vector<Axis>& before) {
  Axis axis;
  if (auto name = reader.requiredText("name")) {
    axis.name = *name;
    if (name->empty() || !std::ranges::all_of(*name, [](char c) { return isLetter(c) || isDigit(c); })) {
      reader.report("name", fmt::format("\"{}\" is not a valid name of an axis", *name),
                    "Axes have names such as X, B or C1");
    } else if (std::any_of(before.begin(), before.end(), [&](const Axis& other) { return other.name == *name; })) {
      reader.report("name", fmt::format("there are two axes called {}", *name), "Give each axis a name of its own");
    }
  }
  reader.require("kind");
  if (auto kind = reader.choice("kind", {"linear", "rotary"}))
    axis.kind = *kind == 0 ? AxisKind::Linear : AxisKind::Rotary;
  axis.modulo = reader.boolean("modulo").value_or(false);
  if (axis.modulo && axis.kind == AxisKind::Linear) {
    reader.report("modulo", fmt::format("linear axis {} cannot be a modulo axis", axis.name));
  }
  if (!axis.modulo) {
    reader.require("minimum");
    reader.require("maximum");
  }
  axis.minimum = reader.number("minimum", anyPlace).value_or(axis.modulo ? 0 : axis.minimum);
  axis.maximum = reader.number("maximum", anyPlace).value_or(axis.modulo ? 360 : axis.maximum);
  if (!(axis.minimum < axis.maximum)) {
    reader.report("minimum", fmt::format("the travel of axis {} ends before it begins", axis.name),
                  "minimum must be less than maximum");
  }
  axis.rapid = reader.number("rapid", {1, 1e6}).value_or(axis.rapid);
  axis.acceleration = reader.number("acceleration", {1, 1e6}).value_or(axis.acceleration);
  reader.finish();
  return axis;
}

std::vector<ChainElement> readChain(TomlReader& file, const char* key, const MachineDescription& machine,
                                    std::vector<bool>& used) {
  std::vector<ChainElement> chain;
  for (TomlReader& reader : file.tables(key)) {
    ChainElement element;
    if (auto name = reader.requiredText("axis")) {
      element.axis = machine.axisIndex(*name);
      if (!element.axis) {
        reader.report("axis", fmt::format("there is no axis called {}", *name), "Declare it under [[axis]] first");
      } else if (used[*element.axis]) {
        reader.report("axis", fmt::format("axis {} appears twice in the chains", *name));
      } else {
        used[*element.axis] = true;
      }
    }
    reader.require("direction");
    if (auto direction = reader.numbers("direction", 3, anyPlace)) {
      const Vector3 vector((*direction)[0], (*direction)[1], (*direction)[2]);
      if (vector.norm() < 1e-9) {
        reader.report("direction", "a direction cannot be [0, 0, 0]");
      } else {
        element.direction = vector.normalized();
      }
    }
    if (auto point = reader.numbers("point", 3, anyPlace)) {
      element.point = {(*point)[0], (*point)[1], (*point)[2]};
      if (element.axis && machine.axes[*element.axis].kind == AxisKind::Linear) {
        reader.report("point",
                      fmt::format("linear axis {} has a direction but no point", machine.axes[*element.axis].name),
                      "Remove this key");
      }
    }
    reader.finish();
    chain.push_back(element);
  }
  return chain;
}

std::optional<TableBody> readTable(TomlReader& file) {
  auto reader = file.table("table");
  if (!reader) return std::nullopt;
  TableBody body;
  body.name = reader->text("name").value_or(body.name);
  reader->require("centre");
  if (auto centre = reader->numbers("centre", 3, anyPlace)) body.centre = {(*centre)[0], (*centre)[1], (*centre)[2]};
  if (auto normal = reader->numbers("normal", 3, anyPlace)) {
    const Vector3 vector((*normal)[0], (*normal)[1], (*normal)[2]);
    if (vector.norm() < 1e-9) {
      reader->report("normal", "a direction cannot be [0, 0, 0]");
    } else {
      body.normal = vector.normalized();
    }
  }
  constexpr NumberRange lengths{.minimum = 0, .maximum = 100'000, .exclusiveMinimum = true};
  const auto size = reader->numbers("size", 2);
  const auto diameter = reader->number("diameter", lengths);
  if (reader->has("size") == reader->has("diameter")) {
    reader->report("", "a table has a size or a diameter",
                   "Give length and width of a rectangle, or the diameter of a disc");
  }
  if (size) {
    body.size = {(*size)[0], (*size)[1]};
    if (!(body.size.minCoeff() > 0 && body.size.maxCoeff() <= lengths.maximum)) {
      reader->report("size", "lengths must be above 0 and at most 100000");
    }
  }
  body.diameter = diameter.value_or(0);
  body.thickness = reader->number("thickness", lengths).value_or(body.thickness);
  reader->finish();
  return body;
}

/// A machine file as far as it could be read; its mistakes are in `diagnostics`.
struct MachineFile {
  MachineDescription description;
  std::optional<TableBody> table;
};

std::optional<MachineFile> parseFile(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const auto root = parseToml(text, file, diagnostics);
  if (!root) return std::nullopt;
  TomlReader reader(*root, "", file, diagnostics);
  MachineDescription machine;
  machine.name = reader.requiredText("name").value_or("");
  machine.spindleOrients = reader.boolean("spindle_orients").value_or(true);
  machine.toolChangeSeconds = reader.number("tool_change_seconds", {0, 1e6}).value_or(machine.toolChangeSeconds);
  reader.require("axis");
  for (TomlReader& axis : reader.tables("axis")) {
    if (machine.axes.size() == maximumAxes) {
      axis.report("", fmt::format("a machine has at most {} axes here", maximumAxes));
      break;
    }
    machine.axes.push_back(readAxis(axis, machine.axes));
  }
  std::vector<bool> used(machine.axes.size(), false);
  if (auto spindle = reader.text("main_spindle")) {
    machine.mainSpindle = machine.axisIndex(*spindle);
    if (!machine.mainSpindle || machine.axes[*machine.mainSpindle].kind != AxisKind::Rotary) {
      reader.report("main_spindle", fmt::format("there is no rotary axis called {}", *spindle),
                    "Name the axis of the spindle that turns the workpiece, or remove this key");
    }
  }
  machine.tableChain = readChain(reader, "table_chain", machine, used);
  machine.spindleChain = readChain(reader, "spindle_chain", machine, used);
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    if (used[i]) continue;
    reader.report(
        "axis", fmt::format("axis {} moves nothing", machine.axes[i].name),
        "Name it in [[table_chain]] if it carries the workpiece, in [[spindle_chain]] if it carries the tool");
  }
  if (auto change = reader.table("tool_change")) {
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
      const Axis& axis = machine.axes[i];
      const NumberRange range = axis.modulo ? anyPlace : NumberRange{axis.minimum, axis.maximum};
      machine.toolChange[i] = change->number(axis.name, range).value_or(0);
    }
    change->finish();
  }
  std::optional<TableBody> table = readTable(reader);
  reader.tables("body");  // their shapes are read by whoever builds the machine
  reader.finish();
  if (diagnostics.size() > before) return std::nullopt;
  return MachineFile{std::move(machine), std::move(table)};
}

std::optional<MachineFile> readFileOf(const std::string& nameOrPath, Diagnostics& diagnostics) {
  const auto ready = std::find_if(readyMade().begin(), readyMade().end(),
                                  [&](const ReadyMade& machine) { return machine.name == nameOrPath; });
  if (ready != readyMade().end()) return parseFile(ready->toml, nameOrPath, diagnostics);
  std::error_code ignored;
  if (!std::filesystem::exists(nameOrPath, ignored)) {
    const auto near = nearestName(nameOrPath, readyMadeMachines());
    diagnostics.push_back(
        fail(fmt::format("there is neither a ready-made machine nor a file called \"{}\"", nameOrPath),
             near ? fmt::format("Did you mean \"{}\"?", *near)
                  : fmt::format("Ready-made machines: {}", fmt::join(readyMadeMachines(), ", ")))
            .value());
    return std::nullopt;
  }
  if (std::filesystem::path(nameOrPath).extension() == ".ini") {
    auto machine = readLinuxCncMachine(nameOrPath, diagnostics);
    if (!machine) return std::nullopt;
    return MachineFile{std::move(machine->description), std::nullopt};
  }
  const Result<std::string> text = readFile(nameOrPath, largestText);
  if (text) return parseFile(*text, nameOrPath, diagnostics);
  diagnostics.push_back(text.error());
  return std::nullopt;
}

}  // namespace

std::optional<MachineDescription> parseMachine(std::string_view text, const std::string& file,
                                               Diagnostics& diagnostics) {
  auto machine = parseFile(text, file, diagnostics);
  if (!machine) return std::nullopt;
  return std::move(machine->description);
}

std::optional<MachineDescription> readMachine(const std::string& nameOrPath, Diagnostics& diagnostics) {
  auto machine = readFileOf(nameOrPath, diagnostics);
  if (!machine) return std::nullopt;
  return std::move(machine->description);
}

Result<MachineDescription> readMachine(const std::string& nameOrPath) {
  Diagnostics diagnostics;
  auto machine = readMachine(nameOrPath, diagnostics);
  if (!machine) return tl::unexpected(diagnostics.front());
  return std::move(*machine);
}

Result<std::optional<TableBody>> readTableBody(const std::string& nameOrPath) {
  Diagnostics diagnostics;
  auto machine = readFileOf(nameOrPath, diagnostics);
  if (!machine) return tl::unexpected(diagnostics.front());
  return std::move(machine->table);
}

std::optional<MachineText> machineText(const std::string& nameOrPath) {
  for (const ReadyMade& machine : readyMade())
    if (machine.name == nameOrPath) return MachineText{std::string(machine.toml), nameOrPath};
  if (std::filesystem::path(nameOrPath).extension() == ".ini") return std::nullopt;
  Result<std::string> text = readFile(nameOrPath, largestText);
  if (!text) return std::nullopt;
  return MachineText{*std::move(text), nameOrPath};
}

std::vector<std::string> readyMadeMachines() {
  std::vector<std::string> names;
  for (const ReadyMade& machine : readyMade())
    names.emplace_back(machine.name);
  return names;
}

}  // namespace probewright::machine
