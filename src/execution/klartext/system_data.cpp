#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "control/alarm.hpp"
#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "execution/klartext/system_data.hpp"

/// FN 18. Tools and touch probes are in system_tool_data.cpp.
namespace probewright::execution::klartext {

using control::Alarm;

namespace {

constexpr std::string_view axisNames = "XYZABCUVW";
constexpr double active = -1;  ///< the control's word for "on"

/// The last touch of the run, or null.
const control::TouchRecord* lastTouch(const control::Journal& journal) {
  for (auto cycle = journal.cycles.rbegin(); cycle != journal.cycles.rend(); ++cycle) {
    if (!cycle->touches.empty()) return &cycle->touches.back();
  }
  return nullptr;
}

}  // namespace

void SystemData::read(const Command& command, Evaluation& evaluation) {
  const auto wordOr = [&](std::string_view address, double otherwise) {
    return numberOr(command.words, address, otherwise, evaluation);
  };
  const int id = static_cast<int>(std::lround(wordOr("ID", 0)));
  const int number = static_cast<int>(std::lround(wordOr("NR", 0)));
  const double index = wordOr("IDX", 0);
  // On the iTNC 530 IDX 0 of ID 50 is tool 0; without IDX it is the active tool.
  const bool rowZero =
      id == 50 && index == 0 && !control_.isTNC640() && find(command.words, "IDX", evaluation) != nullptr;
  const std::optional<double> value = rowZero ? toolData(number, "0") : systemData(id, number, index);
  if (!value) {
    throw Alarm("System datum not available",
                fmt::format("FN 18 cannot read ID{} NR{} IDX{} on this control{}", id, number, index,
                            missingTool(id, number, index)),
                "read another datum, or set the parameter to a fixed value");
  }
  const VariableRef& target = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
  parameters_.write(target, *value);
}

std::optional<double> SystemData::systemData(int id, int number, double index) const {
  const int whole = static_cast<int>(std::lround(index));
  switch (id) {
    case 10:
      return programData(number, whole);
    case 15:
      return parameterData(number, whole);
    case 20:
      return stateData(number);
    case 25:
      return 1;
    case 35:
      return number == 1 ? std::optional<double>(0) : std::nullopt;
    case 50:
    case 950:
      return toolData(number, id == 950 || index <= 0 ? control_.tool.row : toolRowOf(index));
    case 60:
      return toolCallData(number);
    case 200:
      return toolCompensation(number, index);
    case 350:
      return probeData(number, whole);
    case 320:
      if (number == 3) return control_.channel.seconds() - control_.startSeconds;
      return number == 1 ? std::optional<double>(std::floor(run_.machineSeconds())) : std::nullopt;
    case 360:
      return touchData(number, whole);
    case 500:
    case 501:
    case 502:
    case 503:
    case 504:
    case 505:
    case 507:
    case 508:
    case 530:
      return tableData(id, number, whole);
    case 990:
      return probingState(number, whole);
    case 992:
      switch (number) {
        case 10:
        case 11:
        case 14:
          return 0;
        case 16:  // it runs, it is not the graphics that simulate
          return 1;
        default:
          return std::nullopt;
      }
    default:
      return coordinateData(id, number, whole);
  }
}

/// ID 10: programs, cycles, files.
std::optional<double> SystemData::programData(int number, int index) const {
  const auto unitOf = [&](std::size_t level) -> double {
    const HeidenhainProgram* program = run_.levels[level].program;
    return program != nullptr && program->unit() == Unit::Inch ? 1 : 0;
  };
  switch (number) {
    case 3:
      return cycles_.machiningCycle().value_or(-1);
    case 6:
      return cycles_.lastProbeCycle().value_or(-1);
    case 7:
      return run_.levels.size() > 1 ? 0 : -1;
    case 8:
      if (index == 1) return run_.levels.size() > 1 ? unitOf(run_.levels.size() - 2) : -1;
      return index == 2 ? std::optional<double>(unitOf(run_.levels.size() - 1)) : std::nullopt;
    case 110:
      if (!control::heidenhain::QParameters::exists(index)) return std::nullopt;
      return run_.readHostFile(control_.q.qs(index)) ? 1 : 0;
    case 111:
      return 0;
    default:
      return std::nullopt;
  }
}

/// ID 15: the value of a parameter whose number is computed.
std::optional<double> SystemData::parameterData(int number, int index) const {
  if (number < 11 || number > 13 || index < 0) return std::nullopt;
  constexpr std::array spaces = {VariableSpace::Q, VariableSpace::QL, VariableSpace::QR};
  VariableRef variable;
  variable.space = spaces[static_cast<std::size_t>(number - 11)];
  variable.index[0] = Operand::of(index);
  return std::get<double>(parameters_.read(variable));
}

/// ID 20: the state of the machine.
std::optional<double> SystemData::stateData(int number) const {
  const control::heidenhain::ActiveTool& tool = control_.tool;
  switch (number) {
    case 1:
      return tool.number;
    case 2:
      return tools_.prepared();
    case 3:
      return control_.q.q(109);
    case 4:
      return tool.spindleSpeed;
    case 5:
      return spindle_.state();
    case 8:
      return control_.q.q(111);
    case 9:
      return motion_.feed();
    case 10:
      return 0;
    case 11:
      return tool.index;
    default:
      return std::nullopt;
  }
}

/// ID 360: what the last touch found. 1: surface, 2: axis positions, 3: spindle position in program coordinates, as in
/// Q115 to Q117, 4: ball centre, 10: spindle angle, 11: 0 touched, -1 not reached, -2 deflected at the start.
std::optional<double> SystemData::touchData(int number, int index) const {
  if (number == 10) return control_.channel.spindleAngle();
  const control::TouchRecord* touch = lastTouch(control_.journal);
  if (touch == nullptr) return std::nullopt;
  if (number == 11) return touch->outcome == "touched" ? 0 : touch->outcome == "deflected" ? -2 : -1;
  if (number < 1 || number > 4 || index < 1 || index > 9) return std::nullopt;
  const control::Channel& channel = control_.channel;
  const auto axis = channel.description().axisIndex(axisNames.substr(static_cast<std::size_t>(index - 1), 1));
  if (number == 2) return axis ? std::optional<double>(touch->latched[*axis]) : std::nullopt;
  if (index > 3) {
    return axis ? std::optional<double>(touch->latched[*axis] - channel.rotaryOffset[*axis]) : std::nullopt;
  }
  switch (number) {
    case 1:
      return touch->surface[index - 1];
    case 3:
      return touch->spindle[index - 1];
    case 4:
      return touch->ballCentre[index - 1];
    default:
      return std::nullopt;
  }
}

/// ID 500 to 508, 530: datum and preset tables. 501 to 504 are those of the iTNC 530.
std::optional<double> SystemData::tableData(int id, int number, int index) const {
  const bool isAxis = index >= 1 && index <= 9;
  const auto place = static_cast<std::size_t>(index - 1);
  const bool olderControl = !control_.isTNC640();
  const auto preset = id == 500 || id == 501 || id == 505 || id == 530 ? std::nullopt : control_.presetRow(number);
  const auto axis =
      isAxis ? control_.channel.description().axisIndex(axisNames.substr(place, 1)) : std::optional<std::size_t>();
  const auto& inForce = control_.coordinates.preset;
  switch (id) {
    case 501: {  // where the origin would lie in the machine
      const std::optional<double> entry = tableData(500, number, index);
      if (!olderControl || !entry) return std::nullopt;
      if (index > 3) return *entry + (axis ? inForce.rotaryOffset[*axis] : 0);
      Vector3 shift;
      for (int i = 0; i < 3; ++i)
        shift[i] = tableData(500, number, i + 1).value_or(0);
      return (control_.coordinates.machineFromPreset() * shift)[index - 1];
    }
    case 502:  // as the active coordinate system sees it
      if (!olderControl || !preset || !isAxis) return std::nullopt;
      if (index <= 3) return control_.channel.programFromMachine(MachinePlace(preset->origin))[index - 1];
      return axis ? preset->rotaryOffset[*axis] - inForce.rotaryOffset[*axis] : 0;
    case 503:
      if (!olderControl || !preset || !isAxis) return std::nullopt;
      if (index <= 3) return preset->origin[index - 1];
      return axis ? preset->rotaryOffset[*axis] : 0;
    case 504:
      return olderControl && preset ? std::optional<double>(preset->spaceAngles[control_.coordinates.plane.tool])
                                    : std::nullopt;
    case 500: {
      const auto table = control_.tables.datums.find(control_.activeDatumTable);
      if (table == control_.tables.datums.end() || !isAxis) return std::nullopt;
      const auto datum = control::heidenhain::findDatum(table->second, number);
      if (!datum) return std::nullopt;
      if (index <= 3) return datum->shift[index - 1];
      return index <= 6 ? datum->rotary[place - 3] : datum->parallel[place - 6];
    }
    case 505:
      return control_.activeDatumTable.empty() ? 0 : 1;
    case 507:
      if (!preset || index < 1 || index > 6) return std::nullopt;
      return index <= 3 ? preset->origin[index - 1] : preset->spaceAngles[index - 4];
    case 508:
      return preset && axis ? std::optional<double>(preset->rotaryOffset[*axis]) : std::nullopt;
    default: {
      if (number == 1) return inForce.row;
      const auto& presets = control_.tables.presets;
      const std::string row = std::to_string(index);
      if (number != 2 || !presets.hasRow(row)) return std::nullopt;
      return presets.text(row, "LOCKED").empty() ? 0 : 1;
    }
  }
}

/// ID 990: touch probe and spindle; NR 10 finds a tool by its name.
std::optional<double> SystemData::probingState(int number, int index) const {
  switch (number) {
    case 1:
    case 2:
    case 6:
      return 0;
    case 4:
      return control_.channel.deflected(machine::Sensor::TouchProbe) ||
                     control_.channel.deflected(machine::Sensor::ToolTouchProbe)
                 ? 1
                 : 0;
    case 8:
      return control_.channel.spindleAngle();
    case 10: {
      if (!control::heidenhain::QParameters::exists(index)) return std::nullopt;
      const auto row = control::heidenhain::findToolNamed(control_.tables.tools, control_.q.qs(index));
      return row ? std::stod(*row) : -1;
    }
    default:
      return std::nullopt;
  }
}

/// Coordinate systems, positions and limits. Axes are numbered X Y Z A B C U V W from 1.
std::optional<double> SystemData::coordinateData(int id, int number, int index) const {
  const control::heidenhain::Coordinates& coordinates = control_.coordinates;
  const control::heidenhain::Transformations& current = coordinates.current();
  const machine::MachineDescription& description = control_.channel.description();
  const bool isAxis = index >= 1 && index <= 9;
  const bool isLinear = index >= 1 && index <= 3;
  const auto axis = isAxis ? description.axisIndex(axisNames.substr(static_cast<std::size_t>(index - 1), 1))
                           : std::optional<std::size_t>();
  switch (id) {
    case 210:
      switch (number) {
        case 1:
          return coordinates.preset.spaceAngles.z();
        case 2:
          return current.rotation;
        case 3: {
          double bits = 0;
          for (std::size_t i = 0; i < 3; ++i)
            bits += current.mirror[i] ? static_cast<double>(1U << i) : 0;
          for (std::size_t i = 3; i < axisNames.size(); ++i) {
            const auto mirrored = description.axisIndex(axisNames.substr(i, 1));
            if (mirrored && (current.mirroredAxes >> *mirrored & 1U) != 0) bits += static_cast<double>(1U << i);
          }
          return bits;
        }
        case 4:
          return isLinear ? current.scale[index - 1] : 1;
        case 5:
          if (!isLinear) return std::nullopt;
          if (!coordinates.tilt) return 0;
          return control::heidenhain::spaceAnglesFromRotation(*coordinates.tilt)[index - 1];
        case 6:
        case 7:
          return coordinates.tilt ? active : 0;
        case 10:
          return !coordinates.tilt ? 0 : coordinates.tiltIsAxial ? 1 : 2;
        default:
          return std::nullopt;
      }
    case 211:  // positions are those of the input system
      return 1;
    case 220:
      if (number != 2 || !isAxis) return std::nullopt;
      if (isLinear) return current.shift[index - 1];
      return axis ? current.axisShift[*axis] : 0;
    case 230:
      if (number == 5) return 0;  // the limit switches are on
      if (!axis) return std::nullopt;
      if (number == 2) return description.axes[*axis].minimum;
      if (number == 3) return description.axes[*axis].maximum;
      return std::nullopt;
    case 240:
      if (!axis) return std::nullopt;
      return control_.channel.axes()[*axis] - coordinates.turnsTaken[*axis];
    case 270:
      if (isLinear) return control_.channel.position()[index - 1];
      if (!axis) return std::nullopt;
      return coordinates.axisSign(*axis) * (control_.channel.axes()[*axis] - control_.channel.rotaryOffset[*axis]);
    case 280:
      return number == 1 ? std::optional<double>(control_.channel.holdTip ? active : 0) : std::nullopt;
    case 310:
      if (number == 126) return motion_.modes.shortestPath ? active : 0;
      if (number == 128) return control_.channel.holdTip ? active : 0;
      if (number == 144) return coordinates.tiltedAxesInPosition ? active : 0;
      return number == 116 ? std::optional<double>(0) : std::nullopt;
    default:
      return std::nullopt;
  }
}

}  // namespace probewright::execution::klartext
