#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/file.hpp"
#include "base/toml_table.hpp"
#include "machine/machine_file.hpp"
#include "simulation/setup.hpp"
#include "simulation/setup_solids.hpp"
#include "simulation/setup_tool_probe.hpp"
#include "simulation/setup_tools.hpp"

namespace probewright::simulation {

using machine::AxisKind;

namespace {

constexpr NumberRange anyNumber = NumberRange::within(1e6);
constexpr NumberRange positive = anyLength;
constexpr double effectivelyEndless = 1e6;
constexpr std::size_t mostCoefficients = 10;

class SetupReader {
public:
  SetupReader(const toml::table& root, const std::string& file, Diagnostics& diagnostics)
      : root_(root, "", file, diagnostics), folder_(std::filesystem::path(file).parent_path()) {
    setup_.file = file;
    setup_.inputs.emplace_back(file);
  }

  Setup read() {
    readMachine();
    readControl();
    setup_.truth.seed = static_cast<std::uint64_t>(root_.integer("seed", 0, INT64_MAX).value_or(1));
    readSolids();
    readGauges();
    readTools(root_, setup_);
    readFrames();
    readErrors();
    readParameters();
    readAnswers();
    root_.finish();
    return std::move(setup_);
  }

private:
  std::filesystem::path resolve(const std::string& path) const {
    return std::filesystem::path(path).is_absolute() ? std::filesystem::path(path) : folder_ / path;
  }

  const machine::MachineDescription& machine() const { return setup_.truth.machine; }

  /// The axis that the value of `key` names; of the given kind if one is asked for.
  std::optional<std::size_t> axisNamed(TomlReader& reader, std::string_view key, const std::string& name,
                                       std::optional<AxisKind> kind = std::nullopt) {
    if (machine().axes.empty()) return std::nullopt;  // the machine itself is already reported
    const auto index = machine().axisIndex(name);
    if (index && (!kind || machine().axes[*index].kind == *kind)) return index;
    std::vector<std::string> names;
    for (const machine::Axis& axis : machine().axes) {
      if (!kind || axis.kind == *kind) names.push_back(axis.name);
    }
    const char* what = !kind ? "axis" : *kind == AxisKind::Linear ? "linear axis" : "rotary axis";
    reader.report(key, fmt::format("the machine has no {} called {}", what, name),
                  names.empty() ? fmt::format("It has no {}", what) : fmt::format("It has {}", fmt::join(names, ", ")));
    return std::nullopt;
  }

  void readMachine() {
    std::string name = "mill3";
    if (auto reader = root_.table("machine")) {
      const bool hasName = reader->has("name"), hasFile = reader->has("file");
      const auto ready = reader->text("name");
      const auto file = reader->text("file");
      if (hasName && hasFile) reader->report("file", "[machine] has both a name and a file", "Remove one of them");
      if (ready) name = *ready;
      if (file) name = resolve(*file).string();
      loadMachine(name, *reader, hasFile ? "file" : "name");
      if (auto start = reader->table("start")) readStart(*start);
      reader->finish();
      return;
    }
    loadMachine(name, root_, "machine");
  }

  void loadMachine(const std::string& name, TomlReader& reader, std::string_view key) {
    Diagnostics mistakes;
    const auto description = machine::readMachine(name, mistakes);
    if (description) {
      setup_.inputs.emplace_back(name);
      setup_.truth.machine = *description;
      setup_.truth.start = description->toolChange;
      setup_.truth.errors.axes.resize(description->axes.size());
      setup_.table = machine::readTableBody(name).value_or(std::nullopt);
      return;
    }
    for (Diagnostic& mistake : mistakes) {
      // A machine that cannot be found is a mistake of this file, one that cannot be read of its own.
      if (mistake.place.file.empty()) {
        mistake.place = reader.placeOf(key);
        std::error_code error;
        if (key == "name" && std::filesystem::is_regular_file(resolve(name), error))
          mistake.advice = fmt::format("Write file = \"{}\" if you mean this file", name);
      }
      reader.diagnostics().push_back(std::move(mistake));
    }
  }

  void readStart(TomlReader& reader) {
    for (const std::string& key : reader.keys()) {
      const auto axis = axisNamed(reader, key, key);
      NumberRange range;
      if (axis && !machine().axes[*axis].modulo) range = {machine().axes[*axis].minimum, machine().axes[*axis].maximum};
      const auto value = reader.number(key, range);
      if (axis && value) setup_.truth.start[*axis] = *value;
    }
  }

  void readControl() {
    auto reader = root_.table("control");
    if (!reader) return;
    std::vector<std::string> names;
    for (const control::ControlKind kind : control::allControlKinds)
      names.emplace_back(control::name(kind));
    names.emplace_back("828D");  // measures as the 840D sl does
    if (auto type = reader->choice("type", names)) {
      const bool listed = *type < control::allControlKinds.size();
      setup_.control = listed ? control::allControlKinds[*type] : control::ControlKind::Sinumerik840Dsl;
    }
    if (auto tables = reader->text("tables")) {
      setup_.tables = resolve(*tables);
      std::error_code ignored;
      if (!std::filesystem::is_directory(setup_.tables, ignored)) {
        reader->report("tables", fmt::format("there is no folder \"{}\"", setup_.tables.string()),
                       "Name the folder that holds the control's table files, relative to this file");
      }
    }
    reader->finish();
  }

  void readSolid(TomlReader& reader, SolidRole role, std::string defaultName, const char* featureTable) {
    SetupSolid solid;
    solid.role = role;
    solid.name = reader.text("name").value_or(std::move(defaultName));
    solid.source.place = reader.placeOf("file");
    if (reader.has("file") == reader.has("feature")) {
      reader.report("file", fmt::format("{} needs either a file or features", reader.name()),
                    fmt::format("Write file = \"housing.step\" or describe the shape under {}", featureTable));
    }
    solid.source.recipe = readRecipe(reader);
    if (auto file = reader.text("file")) {
      solid.source.file = resolve(*file);
      setup_.inputs.push_back(solid.source.file);
      std::string ending = solid.source.file.extension().string();
      std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
      static const std::vector<std::string> known = {".step", ".stp", ".iges", ".igs", ".stl"};
      if (std::find(known.begin(), known.end(), ending) == known.end()) {
        reader.report("file", fmt::format("\"{}\" is not a part file that can be read", *file),
                      "Files end in .step, .stp, .iges, .igs or .stl");
      }
    }
    solid.tableFromSolid = readPose(reader);
    reader.finish();
    setup_.solids.push_back(std::move(solid));
  }

  void readSolids() {
    if (auto part = root_.table("part")) readSolid(*part, SolidRole::Part, "part", "[[part.feature]]");
    int count = 0;
    for (TomlReader& fixture : root_.tables("fixture")) {
      readSolid(fixture, SolidRole::Fixture, fmt::format("fixture {}", ++count), "[[fixture.feature]]");
    }
  }

  void placeGauge(SolidRecipe recipe, TomlReader& reader, std::string name, SolidRole role) {
    SetupSolid solid{std::move(name), role, {}, readPose(reader)};
    for (SolidFeature& feature : recipe.features)
      feature.place = reader.placeOf("");
    solid.source.recipe = std::move(recipe);
    setup_.solids.push_back(std::move(solid));
    reader.finish();
  }

  void readGauges() {
    if (auto reader = root_.table("ring")) {
      const double bore = reader->requiredNumber("diameter", positive).value_or(50);
      const double outer = reader->number("outer_diameter", positive).value_or(bore + 40);
      const double height = reader->number("height", positive).value_or(20);
      if (outer <= bore) reader->report("outer_diameter", "the ring must be larger than its bore");
      placeGauge(ringGauge(bore, outer, height), *reader, "ring", SolidRole::Ring);
    }
    if (auto reader = root_.table("sphere")) {
      const double diameter = reader->requiredNumber("diameter", positive).value_or(25);
      const double stem = reader->number("stem_diameter", positive).value_or(diameter / 3);
      const double length = reader->number("stem_length", positive).value_or(2 * diameter);
      if (stem >= diameter) reader->report("stem_diameter", "the stem must be thinner than the sphere");
      if (length <= diameter / 2) reader->report("stem_length", "the stem ends within the sphere");
      placeGauge(referenceSphere(diameter, stem, length), *reader, "sphere", SolidRole::Sphere);
    }
    if (auto reader = root_.table("gauge_block")) {
      reader->require("size");
      const Vector3 size = readVector(*reader, "size", anyLength).value_or(Vector3(10, 10, 10));
      placeGauge(gaugeBlock(size.x(), size.y(), size.z()), *reader, "gauge block", SolidRole::GaugeBlock);
    }
    readToolProbes();
  }

  /// One table, or several.
  void readToolProbes() {
    if (root_.isTable("tool_probe")) {
      if (auto reader = root_.table("tool_probe")) addToolProbe(*reader);
      return;
    }
    for (TomlReader& reader : root_.tables("tool_probe"))
      addToolProbe(reader);
  }

  void addToolProbe(TomlReader& reader) {
    SetupToolProbe read = readToolProbe(reader);
    for (const TrueToolProbe& other : setup_.truth.toolProbes) {
      if (other.name == read.probe.name)
        reader.report("name", fmt::format("there are two tool touch probes called \"{}\"", other.name));
    }
    placeGauge(std::move(read.recipe), reader, read.probe.name, SolidRole::ToolProbe);
    setup_.truth.toolProbes.push_back(std::move(read.probe));
  }

  /// "G54" to "G57" as 1 to 4, "G505" to "G599" as 5 to 99.
  static std::optional<int> zeroOffsetIndex(std::string_view name) {
    if (name.size() < 2 || (name[0] != 'G' && name[0] != 'g')) return std::nullopt;
    int number = 0;
    for (const char c : name.substr(1)) {
      if (c < '0' || c > '9' || number > 999) return std::nullopt;
      number = 10 * number + (c - '0');
    }
    if (number >= 54 && number <= 57) return number - 53;
    if (number >= 505 && number <= 599) return number - 500;
    return std::nullopt;
  }

  void readFrame(TomlReader& reader, BelievedFrame frame, std::vector<BelievedFrame>& frames, const char* idKey) {
    frame.origin = readVector(reader, "origin").value_or(Vector3::Zero());
    frame.rotation = readVector(reader, "rotation", anyAngle).value_or(Vector3::Zero());
    if (auto rotary = reader.table("rotary")) {
      for (const std::string& key : rotary->keys()) {
        axisNamed(*rotary, key, key, AxisKind::Rotary);
        frame.rotary[key] = rotary->number(key, {-360, 360}).value_or(0);
      }
    }
    frame.active = reader.boolean("active").value_or(false);
    for (const BelievedFrame& other : frames) {
      if (other.index == frame.index) reader.report(idKey, fmt::format("this {} appears here twice", idKey));
      if (other.active && frame.active) reader.report("active", "only one can be active");
    }
    reader.finish();
    frames.push_back(std::move(frame));
  }

  void readFrames() {
    const auto refuse = [&](TomlReader& reader, const char* key, const char* what, const char* instead) {
      reader.report(key, fmt::format("the {} has no {}", control::name(*setup_.control), what),
                    fmt::format("Write {}, or leave [control] type out if the setup serves both", instead));
    };
    const bool heidenhain = setup_.control && control::isHeidenhain(*setup_.control);
    bool told = false;
    for (TomlReader& reader : root_.tables("preset")) {
      BelievedFrame frame;
      if (setup_.control && !heidenhain && !std::exchange(told, true))
        refuse(reader, "row", "preset table", "[[zero_offset]]");
      reader.require("row");
      frame.index = static_cast<int>(reader.integer("row", 0, 9999).value_or(1));
      readFrame(reader, frame, setup_.presets, "row");
    }
    for (TomlReader& reader : root_.tables("zero_offset")) {
      BelievedFrame frame;
      if (heidenhain && !std::exchange(told, true)) refuse(reader, "name", "settable zero offsets", "[[preset]]");
      if (auto name = reader.requiredText("name")) {
        frame.name = *name;
        const auto index = zeroOffsetIndex(*name);
        if (!index) {
          reader.report("name", fmt::format("\"{}\" is not a settable zero offset", *name),
                        "They are called G54 to G57 and G505 to G599");
        }
        frame.index = index.value_or(1);
      }
      readFrame(reader, frame, setup_.zeroOffsets, "name");
    }
  }

  Vector3 travelDirection(std::size_t axis) const {
    for (const machine::ChainElement& element : machine().spindleChain) {
      if (element.axis == axis) return element.direction;
    }
    for (const machine::ChainElement& element : machine().tableChain) {
      if (element.axis == axis) return -element.direction;
    }
    return Vector3::UnitX();
  }

  void readAxisErrors(TomlReader& reader, std::size_t axis) {
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
    if (axis < setup_.truth.errors.axes.size()) setup_.truth.errors.axes[axis] = std::move(errors);
  }

  void readErrors() {
    auto reader = root_.table("errors");
    if (!reader) return;
    MachineErrors& errors = setup_.truth.errors;
    if (auto axes = reader->table("axis")) {
      for (const std::string& key : axes->keys()) {
        auto entry = axes->table(key);
        const auto axis = axisNamed(*axes, key, key);
        if (entry && axis) readAxisErrors(*entry, *axis);
      }
    }
    for (TomlReader& entry : reader->tables("squareness")) {
      Squareness squareness;
      const auto axis = entry.requiredText("axis"), towards = entry.requiredText("towards");
      squareness.degrees = entry.requiredNumber("degrees", {-10, 10}).value_or(0);
      const auto first = axis ? axisNamed(entry, "axis", *axis, AxisKind::Linear) : std::nullopt;
      const auto second = towards ? axisNamed(entry, "towards", *towards, AxisKind::Linear) : std::nullopt;
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
        const auto axis = axisNamed(*rotary, key, key, AxisKind::Rotary);
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

  void readParameters() {
    auto reader = root_.table("parameters");
    if (!reader) return;
    const auto read = [this](TomlReader& from, const std::string& key, const std::string& name) {
      if (auto parameter = from.plainValue(key)) {
        setup_.parameters.emplace(name, SetupParameter{std::move(*parameter), from.placeOf(key)});
      }
    };
    for (const std::string& key : reader->keys()) {
      if (!reader->isTable(key)) {
        read(*reader, key, key);
        continue;
      }
      // MP6180.0 = 100 without quotes is a table MP6180 with the key 0.
      auto parts = reader->table(key);
      for (const std::string& part : parts->keys())
        read(*parts, part, key + "." + part);
    }
  }

  void readAnswers() {
    auto reader = root_.table("answers");
    if (!reader) return;
    for (const std::string& key : reader->keys()) {
      if (auto answer = reader->text(key)) setup_.answers.emplace(key, std::move(*answer));
    }
  }

  TomlReader root_;
  std::filesystem::path folder_;
  Setup setup_;
};

}  // namespace

std::optional<Setup> parseSetup(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const auto root = parseToml(text, file, diagnostics);
  if (!root) return std::nullopt;
  Setup setup = SetupReader(*root, file, diagnostics).read();
  if (diagnostics.size() > before) return std::nullopt;
  return setup;
}

std::optional<Setup> readSetup(const std::filesystem::path& path, Diagnostics& diagnostics) {
  auto text = readFile(path, largestText);
  if (!text) {
    diagnostics.push_back(std::move(text.error()));
    return std::nullopt;
  }
  return parseSetup(*text, path.string(), diagnostics);
}

}  // namespace probewright::simulation
