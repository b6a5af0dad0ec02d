#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "execution/klartext/coordinate_changes.hpp"
#include "execution/klartext/excerpt.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/lexer.hpp"

namespace probewright::execution::klartext {

using control::Alarm;
using control::heidenhain::Transformations;

namespace {

int linearAxis(const Word& word) {
  return word.address >= 'X' && word.address <= 'Z' ? static_cast<int>(word.address) - 'X' : -1;
}

char axisName(int axis) { return "XYZ"[axis]; }

double checkedScale(double factor) {
  if (!(factor > 0)) throw Alarm("Scaling factor wrong", "A scaling factor must be greater than 0");
  return factor;
}

std::string upperName(std::string_view path) { return upperCase(fileNameOf(path)); }

}  // namespace

void CoordinateChanges::carryOut(const Transform& transform, Evaluation& evaluation) {
  const WordRange words = transform.words;
  Transformations& current = control_.coordinates.current();
  const TransformKind kind = kindOf(evaluation.block(), transform);
  switch (kind) {
    case TransformKind::DatumShift:
    case TransformKind::TransDatumAxis:
      shiftDatum(words, evaluation);
      break;
    case TransformKind::TransDatumTable:
      if (transform.option.length > 0) selectDatumTable(std::string(evaluation.at(transform.option)));
      shiftDatum(words, evaluation);
      break;
    case TransformKind::TransDatumReset:
      current.shift = Vector3::Zero();
      current.axisShift = {};
      break;
    case TransformKind::Mirror:
    case TransformKind::TransMirror:
    case TransformKind::TransMirrorReset:
      mirror(words, evaluation);
      break;
    case TransformKind::Rotation:
    case TransformKind::TransRotation:
    case TransformKind::TransRotationReset: {
      const Word* angle = find(words, "ROT", evaluation);
      const double value = angle == nullptr ? 0 : evaluation.number(angle->value);
      const bool adds = angle != nullptr && angle->mode == WordMode::Incremental;
      current.rotation = adds ? current.rotation + value : value;
      break;
    }
    case TransformKind::Scaling:
    case TransformKind::TransScale:
    case TransformKind::TransScaleReset: {
      const Word* factor = find(words, "SCL", evaluation);
      current.scale = Vector3::Constant(checkedScale(factor == nullptr ? 1 : evaluation.number(factor->value)));
      current.scaleCentre = Vector3::Zero();
      break;
    }
    case TransformKind::AxisScaling:
      scaleAxes(words, evaluation);
      break;
    case TransformKind::Tilting:
      tilting_.tiltByCycle19(words, evaluation);
      return;
    case TransformKind::PresetByCycle:
      for (const Word& word : evaluation.words(words)) {
        if (word.address == 339)
          activatePreset(static_cast<int>(std::lround(evaluation.number(word.value))), Earlier::End);
      }
      return;
    case TransformKind::PlaneSpatial:
    case TransformKind::PlaneProjected:
    case TransformKind::PlaneEuler:
    case TransformKind::PlaneVector:
    case TransformKind::PlanePoints:
    case TransformKind::PlaneRelative:
    case TransformKind::PlaneAxial:
    case TransformKind::PlaneReset:
      tilting_.plane(kind, words, evaluation);
      return;
  }
  control_.applyCoordinates();
}

void CoordinateChanges::mirror(WordRange words, Evaluation& evaluation) {
  Transformations& current = control_.coordinates.current();
  current.mirror = {};
  current.mirroredAxes = 0;
  for (const Word& word : evaluation.words(words)) {
    const int axis = linearAxis(word);
    if (axis >= 0) {
      current.mirror[static_cast<std::size_t>(axis)] = true;
      if (axis == control_.coordinates.plane.tool && run_.firstTime("mirrored tool axis")) {
        run_.warn(fmt::format("The tool axis {} is mirrored here, which the control does not permit", axisName(axis)));
      }
    } else {
      current.mirroredAxes |= 1U << run_.axisOf(static_cast<char>(word.address));
    }
  }
}

/// Cycle 26: a factor for each axis, about a centre.
void CoordinateChanges::scaleAxes(WordRange words, Evaluation& evaluation) {
  Transformations& current = control_.coordinates.current();
  current.scale = Vector3::Ones();
  current.scaleCentre = Vector3::Zero();
  for (const Word& word : evaluation.words(words)) {
    const int axis = linearAxis(word);
    const std::string address = addressName(word.address);
    if (axis >= 0) {
      current.scale[axis] = checkedScale(evaluation.number(word.value));
    } else if (address.size() == 3 && address[2] >= 'X' && address[2] <= 'Z') {
      current.scaleCentre[address[2] - 'X'] = run_.length(word.value, evaluation);
    } else {
      throw Alarm("Axis not permitted", fmt::format("Cycle 26 scales X, Y and Z, not {}", address),
                  "take this axis out of the cycle");
    }
  }
}

void CoordinateChanges::shiftDatum(WordRange words, Evaluation& evaluation) {
  Transformations& current = control_.coordinates.current();
  for (const Word& word : evaluation.words(words)) {
    const int linear = linearAxis(word);
    const bool incremental = word.mode == WordMode::Incremental;
    if (word.address == '#') {
      shiftDatumByTable(evaluation.number(word.value));
    } else if (linear >= 0) {
      const double value = run_.length(word.value, evaluation);
      current.shift[linear] = incremental ? current.shift[linear] + value : value;
    } else {
      const char letter = static_cast<char>(word.address);
      const bool rotary = letter >= 'A' && letter <= 'C';
      const double value = rotary ? evaluation.number(word.value) : run_.length(word.value, evaluation);
      shiftAxis(letter, value, word.mode);
    }
  }
}

/// Shifts the zero of an axis beside X, Y and Z. An axis that the machine does not have can only be shifted by 0.
void CoordinateChanges::shiftAxis(char letter, double value, WordMode mode) {
  if (value == 0 && !control_.channel.description().axisIndex(std::string_view(&letter, 1))) return;
  double& shift = control_.coordinates.current().axisShift[run_.axisOf(letter)];
  shift = mode == WordMode::Incremental ? shift + value : value;
}

void CoordinateChanges::shiftDatumByTable(double row) {
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
    shiftAxis("ABC"[i], datum -> rotary[i], WordMode::Absolute);
    shiftAxis("UVW"[i], datum -> parallel[i], WordMode::Absolute);
  }
}

void CoordinateChanges::selectDatumTable(const std::string& name) {
  for (const auto& [key, table] : control_.tables.datums) {
    if (key == name || upperName(key) == upperName(name)) {
      control_.activeDatumTable = key;
      return;
    }
  }
  const Result<std::string> bytes = run_.readHostFile(name);
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
void CoordinateChanges::activatePreset(int row, Earlier transformations) {
  if (transformations == Earlier::End) {
    control_.coordinates.workpiece = {};
    control_.coordinates.workingPlane = {};
  }
  control_.activatePreset(row);
  control_.panel.message(control::EventKind::Message, fmt::format("Preset {} activated", row),
                         control_.channel.seconds());
}

/// A row of the preset table by its number or by its text in the column DOC.
int CoordinateChanges::presetRowOf(const Word& word, Evaluation& evaluation) const {
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
void CoordinateChanges::correctPreset(control::heidenhain::ActivePreset& preset,
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
      preset.origin[linear] += run_.length(word.value, evaluation);
      continue;
    }
    const std::size_t axis = run_.axisOf(static_cast<char>(word.address));
    const bool rotary = control_.channel.description().axes[axis].kind == machine::AxisKind::Rotary;
    change.rotaryOffset[axis] =
        preset.rotaryOffset[axis] + (rotary ? evaluation.number(word.value) : run_.length(word.value, evaluation));
  }
}

void CoordinateChanges::presetCommand(const Command& command, Evaluation& evaluation) {
  const CommandKind kind = kindOf(evaluation.block(), command);
  const auto row = [&](std::string_view address) {
    const Word* word = find(command.words, address, evaluation);
    return word == nullptr ? 0 : presetRowOf(*word, evaluation);
  };
  const auto transformations = find(command.words, "KEEP", evaluation) != nullptr ? Earlier::Stay : Earlier::End;
  if (kind == CommandKind::PresetSelect) {
    activatePreset(row("#"), transformations);
    return;
  }
  const int source = kind == CommandKind::PresetCopy ? row("#") : control_.coordinates.preset.row;
  const int target = kind == CommandKind::PresetCopy ? row("TO") : source;
  auto preset = control_.presetRow(source);
  if (!preset) throw Alarm("Preset not defined", fmt::format("The preset table has no row {}", source));
  control::heidenhain::Control::PresetChange change;
  const auto& axes = control_.channel.description().axes;
  if (kind == CommandKind::PresetCorrection) correctPreset(*preset, change, command.words, evaluation);
  for (std::size_t i = 0; i < 3; ++i) {
    change.origin[i] = preset->origin[static_cast<Eigen::Index>(i)];
    if (control_.isTNC640() || i == 2) change.spaceAngles[i] = preset->spaceAngles[static_cast<Eigen::Index>(i)];
  }
  for (std::size_t i = 0; kind == CommandKind::PresetCopy && i < axes.size(); ++i) {
    if (axes[i].kind == machine::AxisKind::Rotary) change.rotaryOffset[i] = preset->rotaryOffset[i];
  }
  control_.writePreset(target, change);
  if (find(command.words, "SEL", evaluation) != nullptr) activatePreset(target, transformations);
}

void CoordinateChanges::setPresetInAxis(const Command& command, Evaluation& evaluation) {
  const std::span<const Word> words = evaluation.words(command.words);
  const char letter = static_cast<char>(words[0].address);
  if (letter < 'X' || letter > 'Z') {
    throw Alarm("Axis not permitted", fmt::format("FN 25 sets presets of X, Y and Z, not of {}", letter));
  }
  const double shift = run_.length(words[0].value, evaluation) - run_.length(words[1].value, evaluation);
  Vector3 along = Vector3::Zero();
  along[letter - 'X'] = shift;
  auto preset = control_.coordinates.preset;
  preset.origin += control_.coordinates.machineFromPreset().linear() * along;
  control::heidenhain::Control::PresetChange change;
  for (std::size_t i = 0; i < 3; ++i)
    change.origin[i] = preset.origin[static_cast<Eigen::Index>(i)];
  control_.writePreset(preset.row, change);
}

}  // namespace probewright::execution::klartext
