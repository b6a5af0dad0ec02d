#include "setup/world_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "machine/machine_file.hpp"
#include "setup/axis_names.hpp"
#include "setup/machine_body_keys.hpp"
#include "setup/shape_keys.hpp"
#include "setup/tool_probe_keys.hpp"

namespace probewright::setup {

using machine::AxisKind;
using simulation::AxisErrors;
using simulation::Deviation;
using simulation::MachineErrors;
using simulation::RotaryAxisError;
using simulation::SolidFeature;
using simulation::SolidRecipe;
using simulation::SolidRole;
using simulation::Squareness;
using simulation::ThermalDrift;
using simulation::WorldSolid;

namespace {

constexpr NumberRange anyNumber = NumberRange::within(1e6);
constexpr NumberRange positive = anyLength;
constexpr double effectivelyEndless = 1e6;
constexpr std::size_t mostCoefficients = 10;

}  // namespace

void WorldReader::readMachine(const std::filesystem::path& instead, const MachineRead* known) {
  known_ = known;
  std::string name = "mill3";
  if (auto reader = root_.table("machine")) {
    const bool hasName = reader->has("name"), hasFile = reader->has("file");
    const auto ready = reader->text("name");
    const auto file = reader->text("file");
    if (hasName && hasFile) reader->report("file", "[machine] has both a name and a file", "Remove one of them");
    if (ready) name = *ready;
    if (file) name = resolve(*file).string();
    if (instead.empty())
      loadMachine(name, *reader, hasFile ? "file" : "name", Named::ByThisFile);
    else
      loadMachine(instead.string(), *reader, "file", Named::ByCaller);
    if (auto start = reader->table("start")) readStart(*start);
    if (instead.empty() && !machine().axes.empty())
      readBodies(*reader, machine(), folder_, world_.bodies, inputs_);
    else
      reader->tables("body");  // of a machine that is not there
    if (auto grids = reader->table("hirth")) readHirthGrids(*grids);
    world_.clearance = reader->number("clearance", {0, 1000}).value_or(0);
    reader->finish();
    return;
  }
  if (instead.empty())
    loadMachine(name, root_, "machine", Named::ByThisFile);
  else
    loadMachine(instead.string(), root_, "machine", Named::ByCaller);
}

void WorldReader::loadMachine(const std::string& name, TomlReader& reader, std::string_view key, Named named) {
  if (known_ != nullptr) return takeMachine(known_->description, known_->table);
  Diagnostics mistakes;
  const auto description = machine::readMachine(name, mistakes);
  if (description) {
    // What had to be assumed of it.
    reader.diagnostics().insert(reader.diagnostics().end(), mistakes.begin(), mistakes.end());
    inputs_.emplace_back(name);
    takeMachine(*description, machine::readTableBody(name).value_or(std::nullopt));
    readBodiesOf(name, *description, reader.diagnostics(), world_.bodies, inputs_);
    return;
  }
  for (Diagnostic& mistake : mistakes) {
    // A machine that cannot be found is a mistake of this file, one that cannot be read of its own.
    if (mistake.place.file.empty() && named == Named::ByThisFile) {
      mistake.place = reader.placeOf(key);
      std::error_code error;
      if (key == "name" && std::filesystem::is_regular_file(resolve(name), error))
        mistake.advice = fmt::format("Write file = \"{}\" if you mean this file", name);
    }
    reader.diagnostics().push_back(std::move(mistake));
  }
}

void WorldReader::takeMachine(const machine::MachineDescription& description,
                              const std::optional<machine::TableBody>& table) {
  world_.truth.machine = description;
  world_.truth.start = description.toolChange;
  world_.truth.errors.axes.resize(description.axes.size());
  world_.table = table;
}

void WorldReader::readStart(TomlReader& reader) {
  for (const std::string& key : reader.keys()) {
    const auto axis = axisNamed(reader, key, key, machine());
    NumberRange range;
    if (axis && !machine().axes[*axis].modulo) range = {machine().axes[*axis].minimum, machine().axes[*axis].maximum};
    const auto value = reader.number(key, range);
    if (axis && value) world_.truth.start[*axis] = *value;
  }
}

void WorldReader::readHirthGrids(TomlReader& reader) {
  for (const std::string& key : reader.keys()) {
    const auto axis = axisNamed(reader, key, key, machine(), AxisKind::Rotary);
    const auto grid = reader.number(key, {0.001, 180});
    if (axis && grid) world_.truth.hirthGrid[*axis] = *grid;
  }
}

void WorldReader::readSeed() {
  world_.truth.seed = static_cast<std::uint64_t>(root_.integer("seed", 0, INT64_MAX).value_or(1));
}

void WorldReader::readSolid(TomlReader& reader, SolidRole role, std::string defaultName, const char* featureTable) {
  WorldSolid solid;
  solid.role = role;
  solid.name = reader.text("name").value_or(std::move(defaultName));
  solid.source.place = reader.placeOf("file");
  if (reader.has("file") == reader.has("feature")) {
    reader.report("file", fmt::format("{} needs either a file or features", reader.name()),
                  fmt::format("Write file = \"housing.step\" or describe the shape under {}", featureTable));
  }
  solid.source.recipe = readRecipe(reader);
  if (auto file = readShapeFile(reader, folder_)) {
    solid.source.file = *std::move(file);
    inputs_.push_back(solid.source.file);
  }
  solid.tableFromSolid = readPose(reader);
  reader.finish();
  world_.solids.push_back(std::move(solid));
}

void WorldReader::readSolids() {
  if (auto part = root_.table("part")) readSolid(*part, SolidRole::Part, "part", "[[part.feature]]");
  int count = 0;
  for (TomlReader& fixture : root_.tables("fixture")) {
    readSolid(fixture, SolidRole::Fixture, fmt::format("fixture {}", ++count), "[[fixture.feature]]");
  }
  readGauges();
}

void WorldReader::placeGauge(SolidRecipe recipe, TomlReader& reader, std::string name, SolidRole role) {
  WorldSolid solid{std::move(name), role, {}, readPose(reader)};
  for (SolidFeature& feature : recipe.features)
    feature.place = reader.placeOf("");
  solid.source.recipe = std::move(recipe);
  world_.solids.push_back(std::move(solid));
  reader.finish();
}

void WorldReader::readGauges() {
  if (auto reader = root_.table("ring")) {
    const double bore = reader->requiredNumber("diameter", positive).value_or(50);
    const double outer = reader->number("outer_diameter", positive).value_or(bore + 40);
    const double height = reader->number("height", positive).value_or(20);
    if (outer <= bore) reader->report("outer_diameter", "the ring must be larger than its bore");
    placeGauge(simulation::ringGauge(bore, outer, height), *reader, "ring", SolidRole::Ring);
  }
  if (auto reader = root_.table("sphere")) {
    const double diameter = reader->requiredNumber("diameter", positive).value_or(25);
    const double stem = reader->number("stem_diameter", positive).value_or(diameter / 3);
    const double length = reader->number("stem_length", positive).value_or(2 * diameter);
    if (stem >= diameter) reader->report("stem_diameter", "the stem must be thinner than the sphere");
    if (length <= diameter / 2) reader->report("stem_length", "the stem ends within the sphere");
    placeGauge(simulation::referenceSphere(diameter, stem, length), *reader, "sphere", SolidRole::Sphere);
  }
  if (auto reader = root_.table("gauge_block")) {
    reader->require("size");
    const Vector3 size = readVector(*reader, "size", anyLength).value_or(Vector3(10, 10, 10));
    placeGauge(simulation::gaugeBlock(size.x(), size.y(), size.z()), *reader, "gauge block", SolidRole::GaugeBlock);
  }
  readToolProbes();
}

void WorldReader::readToolProbes() {
  if (root_.isTable("tool_probe")) {
    if (auto reader = root_.table("tool_probe")) addToolProbe(*reader);
    return;
  }
  for (TomlReader& reader : root_.tables("tool_probe"))
    addToolProbe(reader);
}

void WorldReader::addToolProbe(TomlReader& reader) {
  SetupToolProbe read = readToolProbe(reader);
  for (const simulation::TrueToolProbe& other : world_.truth.toolProbes) {
    if (other.name == read.probe.name)
      reader.report("name", fmt::format("there are two tool touch probes called \"{}\"", other.name));
  }
  placeGauge(std::move(read.recipe), reader, read.probe.name, SolidRole::ToolProbe);
  world_.truth.toolProbes.push_back(std::move(read.probe));
}

Vector3 WorldReader::travelDirection(std::size_t axis) const {
  for (const machine::ChainElement& element : machine().spindleChain) {
    if (element.axis == axis) return element.direction;
  }
  for (const machine::ChainElement& element : machine().tableChain) {
    if (element.axis == axis) return -element.direction;
  }
  return Vector3::UnitX();
}

void WorldReader::readAxisErrors(TomlReader& reader, std::size_t axis) {
  AxisErrors errors;
  errors.scale = reader.number("scale_mm_per_m", {-10, 10}).value_or(0) / 1000;
  errors.offset = reader.number("offset", anyNumber).value_or(0);
  errors.backlash = reader.number("backlash", {0, 10}).value_or(0);
  for (TomlReader& entry : reader.tables("deviation")) {
    Deviation deviation;
    deviation.direction = travelDirection(axis);
    if (auto direction = readVector(entry, "direction")) {
      if (direction->norm() < 1e-9) {
        entry.report("direction", "a direction cannot be [0, 0, 0]");
      } else {
        deviation.direction = direction->normalized();
      }
    }
    deviation.polynomial = entry.numbers("polynomial", 0, NumberRange::within(10)).value_or(std::vector<double>{});
    if (deviation.polynomial.size() > mostCoefficients)
      entry.report("polynomial", fmt::format("\"polynomial\" has at most {} coefficients", mostCoefficients));
    deviation.amplitude = entry.number("amplitude", {-10, 10}).value_or(0);
    deviation.wavelength = entry.number("wavelength", {0.1, effectivelyEndless}).value_or(100);
    deviation.phase = entry.number("phase", anyNumber).value_or(0);
    entry.finish();
    errors.deviations.push_back(std::move(deviation));
  }
  reader.finish();
  if (axis < world_.truth.errors.axes.size()) world_.truth.errors.axes[axis] = std::move(errors);
}

void WorldReader::readErrors() {
  auto reader = root_.table("errors");
  if (!reader) return;
  MachineErrors& errors = world_.truth.errors;
  if (auto axes = reader->table("axis")) {
    for (const std::string& key : axes->keys()) {
      auto entry = axes->table(key);
      const auto axis = axisNamed(*axes, key, key, machine());
      if (entry && axis) readAxisErrors(*entry, *axis);
    }
  }
  for (TomlReader& entry : reader->tables("squareness")) {
    Squareness squareness;
    const auto axis = entry.requiredText("axis"), towards = entry.requiredText("towards");
    squareness.degrees = entry.requiredNumber("degrees", {-10, 10}).value_or(0);
    const auto first = axis ? axisNamed(entry, "axis", *axis, machine(), AxisKind::Linear) : std::nullopt;
    const auto second = towards ? axisNamed(entry, "towards", *towards, machine(), AxisKind::Linear) : std::nullopt;
    if (first && second) {
      if (*first == *second) entry.report("towards", "an axis cannot lean towards itself");
      squareness.axis = *first;
      squareness.towards = *second;
      errors.squareness.push_back(squareness);
    }
    entry.finish();
  }
  if (auto rotary = reader->table("rotary")) {
    for (const std::string& key : rotary->keys()) {
      auto entry = rotary->table(key);
      const auto axis = axisNamed(*rotary, key, key, machine(), AxisKind::Rotary);
      if (!entry) continue;
      RotaryAxisError error;
      error.axis = axis.value_or(0);
      error.position = readVector(*entry, "position").value_or(Vector3::Zero());
      error.orientation = readVector(*entry, "orientation", NumberRange::within(10)).value_or(Vector3::Zero());
      entry->finish();
      if (axis) errors.rotaryAxes.push_back(error);
    }
  }
  if (auto tilt = readVector(*reader, "spindle_tilt", NumberRange::within(10))) errors.spindleTilt = *tilt;
  for (TomlReader& entry : reader->tables("thermal")) {
    ThermalDrift drift;
    entry.require("amount");
    drift.amount = readVector(entry, "amount").value_or(Vector3::Zero());
    drift.timeConstant = entry.number("time_constant", {1, 1e9}).value_or(3600);
    entry.finish();
    errors.thermal.push_back(drift);
  }
  reader->finish();
}

}  // namespace probewright::setup
