#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/host.hpp"
#include "language/klartext/lexer.hpp"

/// Coordinate transformations: cycles 7, 8, 10, 11, 19, 26, 247, TRANS, PRESET.
namespace probewright::language::klartext {

using control::Alarm;
using control::heidenhain::Transformations;

namespace {

int linearAxis(const Word& word) {
  return word.address >= 'X' && word.address <= 'Z' ? static_cast<int>(word.address) - 'X' : -1;
}

char axisName(int axis) { return "XYZ"[axis]; }

std::string upperName(std::string_view path) {
  std::string name = fileNameOf(path);
  std::ranges::transform(name, name.begin(), [](char c) { return upper(c); });
  return name;
}

}  // namespace

void KlartextHost::transform(const Transform& transform, Evaluation& evaluation) {
  const std::string_view name = evaluation.at(transform.name);
  const WordRange words = transform.words;
  Transformations& current = control_.coordinates.current();
  if (name == "CYCL DEF 7" || name == "TRANS DATUM AXIS") {
    shiftDatum(words, evaluation);
  } else if (name == "TRANS DATUM TABLE") {
    if (transform.option.length > 0) selectDatumTable(std::string(evaluation.at(transform.option)));
    shiftDatum(words, evaluation);
  } else if (name == "TRANS DATUM RESET") {
    current.shift = Vector3::Zero();
    current.axisShift = {};
  } else if (name == "CYCL DEF 8" || name == "TRANS MIRROR AXIS" || name == "TRANS MIRROR RESET") {
    current.mirror = {};
    current.mirroredAxes = 0;
    for (const Word& word : evaluation.words(words)) {
      const int axis = linearAxis(word);
      if (axis >= 0) {
        current.mirror[static_cast<std::size_t>(axis)] = true;
        if (axis == control_.coordinates.plane.tool && leftOut_.insert("mirrored tool axis").second) {
          warn(fmt::format("The tool axis {} is mirrored here, which the control does not permit", axisName(axis)));
        }
      } else {
        current.mirroredAxes |= 1U << axisOf(static_cast<char>(word.address));
      }
    }
  } else if (name == "CYCL DEF 10" || name == "TRANS ROTATION" || name == "TRANS ROTATION RESET") {
    const Word* angle = find(words, "ROT", evaluation);
    if (angle == nullptr) {
      current.rotation = 0;
    } else {
      const double value = evaluation.number(angle->value);
      current.rotation = angle->mode == WordMode::Incremental ? current.rotation + value : value;
    }
  } else if (name == "CYCL DEF 11" || name == "TRANS SCALE" || name == "TRANS SCALE RESET") {
    const Word* factor = find(words, "SCL", evaluation);
    const double value = factor == nullptr ? 1 : evaluation.number(factor->value);
    if (!(value > 0)) throw Alarm("Scaling factor wrong", "A scaling factor must be greater than 0");
    current.scale = Vector3::Constant(value);
    current.scaleCentre = Vector3::Zero();
  } else if (name == "CYCL DEF 26") {
    current.scale = Vector3::Ones();
    current.scaleCentre = Vector3::Zero();
    for (const Word& word : evaluation.words(words)) {
      const int axis = linearAxis(word);
      const std::string address = addressName(word.address);
      if (axis >= 0) {
        const double factor = evaluation.number(word.value);
        if (!(factor > 0)) throw Alarm("Scaling factor wrong", "A scaling factor must be greater than 0");
        current.scale[axis] = factor;
      } else if (address.size() == 3 && address[2] >= 'X' && address[2] <= 'Z') {
        current.scaleCentre[address[2] - 'X'] = length(word.value, evaluation);
      } else {
        throw Alarm("Axis not permitted", fmt::format("Cycle 26 scales X, Y and Z, not {}", address),
                    "take this axis out of the cycle");
      }
    }
  } else if (name == "CYCL DEF 19") {
    tiltByCycle19(words, evaluation);
    return;
  } else if (name == "CYCL DEF 247") {
    for (const Word& word : evaluation.words(words)) {
      if (word.address == 339) activatePreset(static_cast<int>(std::lround(evaluation.number(word.value))), false);
    }
    return;
  } else if (name.starts_with("PLANE")) {
    plane(name, words, evaluation);
    return;
  }
  control_.applyCoordinates();
}

void KlartextHost::shiftDatum(WordRange words, Evaluation& evaluation) {
  Transformations& current = control_.coordinates.current();
  for (const Word& word : evaluation.words(words)) {
    const int linear = linearAxis(word);
    const bool incremental = word.mode == WordMode::Incremental;
    if (word.address == '#') {
      shiftDatumByTable(evaluation.number(word.value));
    } else if (linear >= 0) {
      const double value = length(word.value, evaluation);
      current.shift[linear] = incremental ? current.shift[linear] + value : value;
    } else {
      const char letter = static_cast<char>(word.address);
      const bool rotary = letter >= 'A' && letter <= 'C';
      const double value = rotary ? evaluation.number(word.value) : length(word.value, evaluation);
      shiftAxis(letter, value, incremental);
    }
  }
}

/// Shifts the zero of an axis beside X, Y and Z. An axis that the machine does not have can only be shifted by 0.
void KlartextHost::shiftAxis(char letter, double value, bool incremental) {
  if (value == 0 && !control_.channel.description().axisIndex(std::string_view(&letter, 1))) return;
  double& shift = control_.coordinates.current().axisShift[axisOf(letter)];
  shift = incremental ? shift + value : value;
}

void KlartextHost::shiftDatumByTable(double row) {
  const auto table = control_.tables.datums.find(control_.activeDatumTable);
  if (table == control_.tables.datums.end()) {
    throw Alarm("Datum table missing", "No datum table is selected", "program SEL TABLE with a datum table before");
  }
  const auto datum = control::heidenhain::findDatum(table->second, static_cast<int>(std::lround(row)));
  if (!datum) {
    throw Alarm("Datum not defined", fmt::format("Datum table {} has no row {}", table->first, std::lround(row)),
                "add the row or correct the number");
  }
  control_.coordinates.current().shift = datum->shift;
  for (std::size_t i = 0; i < 3; ++i) {
    shiftAxis("ABC"[i], datum -> rotary[i], false);
    shiftAxis("UVW"[i], datum -> parallel[i], false);
  }
}

void KlartextHost::selectDatumTable(const std::string& name) {
  for (const auto& [key, table] : control_.tables.datums) {
    if (key == name || upperName(key) == upperName(name)) {
      control_.activeDatumTable = key;
      return;
    }
  }
  const Result<std::string> bytes = readHostFile(name);
  if (!bytes) {
    throw Alarm("Datum table missing", fmt::format("The datum table {} does not exist", excerptOf(name)),
                "add the table to the setup or correct its name");
  }
  Diagnostics mistakes;
  auto table = control::heidenhain::TypedTable::parse(*bytes, name, control::heidenhain::datumColumns(), mistakes);
  if (!table) throw Alarm("Datum table wrong", table.error().message, table.error().advice);
  control_.tables.datums.emplace(upperName(name), std::move(*table));
  control_.activeDatumTable = upperName(name);
}

/// A preset ends datum shift, mirror image, rotation and scaling, unless they are kept; a tilted plane stays.
void KlartextHost::activatePreset(int row, bool keepTransformations) {
  if (!keepTransformations) {
    control_.coordinates.workpiece = {};
    control_.coordinates.workingPlane = {};
  }
  control_.activatePreset(row);
  control_.panel.message(control::EventKind::Message, fmt::format("Preset {} activated", row),
                         control_.channel.seconds());
}

/// A row of the preset table by its number or by its text in the column DOC.
int KlartextHost::presetRowOf(const Word& word, Evaluation& evaluation) const {
  const Value named = evaluation.value(word.value);
  if (!isText(named)) return static_cast<int>(std::lround(std::get<double>(named)));
  const std::string& text = std::get<std::string>(named);
  const auto& presets = control_.tables.presets;
  for (const std::string& key : presets.table().keys()) {
    const auto number = parseInteger(key);
    if (number && presets.text(key, "DOC") == text) return static_cast<int>(*number);
  }
  throw Alarm("Preset not defined", fmt::format("No row of the preset table has \"{}\" in its column DOC", text),
              "correct the text or name the row by its number");
}

/// PRESET CORR: what is to be added to origin, space angles and offsets of rotary axes.
void KlartextHost::correctPreset(control::heidenhain::ActivePreset& preset,
                                 control::heidenhain::Control::PresetChange& change, WordRange words,
                                 Evaluation& evaluation) {
  constexpr std::array<std::string_view, 3> angles = {"SPA", "SPB", "SPC"};
  for (const Word& word : evaluation.words(words)) {
    const auto angle = std::ranges::find_if(angles, [&](auto name) { return addressOf(name) == word.address; });
    if (angle != angles.end()) {
      preset.spaceAngles[angle - angles.begin()] += evaluation.number(word.value);
      continue;
    }
    if (const int linear = linearAxis(word); linear >= 0) {
      preset.origin[linear] += length(word.value, evaluation);
      continue;
    }
    const std::size_t axis = axisOf(static_cast<char>(word.address));
    const bool rotary = control_.channel.description().axes[axis].kind == machine::AxisKind::Rotary;
    change.rotaryOffset[axis] =
        preset.rotaryOffset[axis] + (rotary ? evaluation.number(word.value) : length(word.value, evaluation));
  }
}

void KlartextHost::presetCommand(std::string_view name, const Command& command, Evaluation& evaluation) {
  settle();
  const auto row = [&](std::string_view address) {
    const Word* word = find(command.words, address, evaluation);
    return word == nullptr ? 0 : presetRowOf(*word, evaluation);
  };
  const bool keep = find(command.words, "KEEP", evaluation) != nullptr;
  if (name == "PRESET SELECT") {
    activatePreset(row("#"), keep);
    return;
  }
  const int source = name == "PRESET COPY" ? row("#") : control_.coordinates.preset.row;
  const int target = name == "PRESET COPY" ? row("TO") : source;
  auto preset = control_.presetRow(source);
  if (!preset) throw Alarm("Preset not defined", fmt::format("The preset table has no row {}", source));
  control::heidenhain::Control::PresetChange change;
  const auto& axes = control_.channel.description().axes;
  if (name == "PRESET CORR") correctPreset(*preset, change, command.words, evaluation);
  for (std::size_t i = 0; i < 3; ++i) {
    change.origin[i] = preset->origin[static_cast<Eigen::Index>(i)];
    if (control_.isTNC640() || i == 2) change.spaceAngles[i] = preset->spaceAngles[static_cast<Eigen::Index>(i)];
  }
  for (std::size_t i = 0; name == "PRESET COPY" && i < axes.size(); ++i) {
    if (axes[i].kind == machine::AxisKind::Rotary) change.rotaryOffset[i] = preset->rotaryOffset[i];
  }
  control_.writePreset(target, change);
  if (find(command.words, "SEL", evaluation) != nullptr) activatePreset(target, keep);
}

}  // namespace probewright::language::klartext
