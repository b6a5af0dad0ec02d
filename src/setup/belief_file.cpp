#include "setup/belief_file.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "setup/axis_names.hpp"
#include "setup/shape_keys.hpp"

namespace probewright::setup {

using control::BelievedFrame;

namespace {

/// "G54" to "G57" as 1 to 4, "G505" to "G599" as 5 to 99.
std::optional<int> zeroOffsetIndex(std::string_view name) {
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

}  // namespace

void BeliefReader::readControl(const MayBeMissing& mayBeMissing) {
  auto reader = root_.table("control");
  if (!reader) return;
  const std::vector<std::string> names = families_.controlNames();
  if (auto type = reader->choice("type", names)) beliefs_.control = families_.controlNamed(names[*type]);
  readTables(*reader, mayBeMissing);
  readKinematics(*reader);
  reader->finish();
}

void BeliefReader::readTables(TomlReader& control, const MayBeMissing& mayBeMissing) {
  namespace fs = std::filesystem;
  const auto tables = control.text("tables");
  if (!tables) return;
  const fs::path path(*tables);
  beliefs_.tables = path.is_absolute() ? path : folder_ / path;
  std::error_code ignored;
  if (fs::is_directory(beliefs_.tables, ignored)) return;
  const bool isAbsent = !fs::exists(fs::symlink_status(beliefs_.tables, ignored));
  if (isAbsent && mayBeMissing && mayBeMissing(beliefs_.tables)) {
    control.diagnostics().push_back(
        {Severity::Note,
         control.placeOf("tables"),
         fmt::format("there is no folder \"{}\" yet: the control begins without tables", beliefs_.tables.string()),
         {},
         {},
         {}});
    beliefs_.tables.clear();
    return;
  }
  control.report("tables", fmt::format("there is no folder \"{}\"", beliefs_.tables.string()),
                 "Name the folder that holds the control's table files, relative to this file. Only a folder that the "
                 "run itself is to make, that of --out, may be missing");
}

/// [control.kinematics.C]: where the control believes the axis of rotation of C.
void BeliefReader::readKinematics(TomlReader& control) {
  auto kinematics = control.table("kinematics");
  if (!kinematics) return;
  for (const std::string& key : kinematics->keys()) {
    auto reader = kinematics->table(key);
    const auto axis = axisNamed(*kinematics, key, key, machine_, machine::AxisKind::Rotary);
    if (!reader) continue;
    control::BelievedRotaryAxis belief;
    belief.point = readVector(*reader, "point");
    if (const auto direction = readVector(*reader, "direction")) {
      if (direction->norm() < 1e-9) {
        reader->report("direction", "a direction cannot be [0, 0, 0]");
      } else {
        belief.direction = direction->normalized();
      }
    }
    belief.position = readVector(*reader, "position").value_or(Vector3::Zero());
    belief.orientation = readVector(*reader, "orientation", NumberRange::within(10)).value_or(Vector3::Zero());
    belief.hirthGrid = reader->number("hirth_grid", {0.001, 180}).value_or(0);
    reader->finish();
    if (axis) beliefs_.kinematics.insert_or_assign(key, belief);
  }
}

void BeliefReader::readFrame(TomlReader& reader, BelievedFrame frame, std::vector<BelievedFrame>& frames,
                             const char* idKey) {
  frame.origin = readVector(reader, "origin").value_or(Vector3::Zero());
  frame.rotation = readVector(reader, "rotation", anyAngle).value_or(Vector3::Zero());
  if (auto rotary = reader.table("rotary")) {
    for (const std::string& key : rotary->keys()) {
      axisNamed(*rotary, key, key, machine_, machine::AxisKind::Rotary);
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

void BeliefReader::readFrames() {
  const auto refuse = [&](TomlReader& reader, const char* key, const char* what, const char* instead) {
    reader.report(key, fmt::format("the {} has no {}", families_.model(*beliefs_.control).name, what),
                  fmt::format("Write {}, or leave [control] type out if the setup serves both", instead));
  };
  const session::ControlFamily* family = beliefs_.control ? &families_.of(*beliefs_.control) : nullptr;
  bool told = false;
  for (TomlReader& reader : root_.tables("preset")) {
    BelievedFrame frame;
    if (family != nullptr && !family->hasPresets && !std::exchange(told, true))
      refuse(reader, "row", "preset table", "[[zero_offset]]");
    reader.require("row");
    frame.index = static_cast<int>(reader.integer("row", 0, 9999).value_or(1));
    readFrame(reader, frame, beliefs_.presets, "row");
  }
  for (TomlReader& reader : root_.tables("zero_offset")) {
    BelievedFrame frame;
    if (family != nullptr && !family->hasZeroOffsets && !std::exchange(told, true))
      refuse(reader, "name", "settable zero offsets", "[[preset]]");
    if (auto name = reader.requiredText("name")) {
      frame.name = *name;
      const auto index = zeroOffsetIndex(*name);
      if (!index) {
        reader.report("name", fmt::format("\"{}\" is not a settable zero offset", *name),
                      "They are called G54 to G57 and G505 to G599");
      }
      frame.index = index.value_or(1);
    }
    readFrame(reader, frame, beliefs_.zeroOffsets, "name");
  }
}

void BeliefReader::readParameters() {
  auto reader = root_.table("parameters");
  if (!reader) return;
  const auto read = [this](TomlReader& from, const std::string& key, const std::string& name) {
    if (auto parameter = from.plainValue(key)) {
      beliefs_.parameters.emplace(name, control::BelievedParameter{std::move(*parameter), from.placeOf(key)});
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

void BeliefReader::readAnswers() {
  auto reader = root_.table("answers");
  if (!reader) return;
  for (const std::string& key : reader->keys()) {
    if (auto answer = reader->text(key)) beliefs_.answers.emplace(key, std::move(*answer));
  }
}

}  // namespace probewright::setup
