#include "cycles/heidenhain/rotary_alignment.hpp"

#include <fmt/format.h>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;

namespace {

/// How the table turns while `axis` turns by one degree, as axis and degrees in machine coordinates.
Vector3 tableTurn(const machine::MachineDescription& description, const machine::AxisPositions& position,
                  std::size_t axis) {
  machine::AxisPositions next = position;
  next[axis] += 1;
  const Matrix3 turn = machine::baseFromTable(description, next).linear() *
                       machine::baseFromTable(description, position).linear().transpose();
  const Eigen::AngleAxisd rotation(turn);
  return rotation.axis() * degreesFromRadians(rotation.angle());
}

[[noreturn]] void refuseAxis(const std::string& reason) {
  throw Alarm("Rotary axis not available", reason, "use a basic rotation instead");
}

}  // namespace

std::size_t requireTable(Context& context, int about) {
  const machine::MachineDescription& description = context.channel().description();
  const machine::AxisPositions position = context.channel().axes();
  for (std::size_t axis = 0; axis < description.axes.size(); ++axis) {
    if (description.axes[axis].kind != machine::AxisKind::Rotary) continue;
    if (std::abs(tableTurn(description, position, axis)[about]) >= 0.999) return axis;
  }
  // An axis that another one has turned aside?
  machine::AxisPositions atZero = position;
  std::string standing;
  for (std::size_t axis = 0; axis < description.axes.size(); ++axis) {
    if (description.axes[axis].kind != machine::AxisKind::Rotary) continue;
    if (atZero[axis] != 0)
      standing += fmt::format("{}{} at {}", standing.empty() ? "" : ", ", description.axes[axis].name,
                              formatFixed(atZero[axis], 3));
    atZero[axis] = 0;
  }
  for (std::size_t axis = 0; axis < description.axes.size(); ++axis) {
    if (description.axes[axis].kind != machine::AxisKind::Rotary) continue;
    if (std::abs(tableTurn(description, atZero, axis)[about]) < 0.999) continue;
    throw Alarm(
        "Rotary axis not available",
        fmt::format(
            "Axis {} does not turn the workpiece about {} at the present position of the rotary axes ({} degrees)",
            description.axes[axis].name, "XYZ"[about], standing),
        "position the other rotary axes at zero before the cycle, or use a basic rotation");
  }
  refuseAxis(fmt::format("The machine has no rotary table that turns the workpiece about {}", "XYZ"[about]));
}

std::size_t turnWorkpiece(Context& context, int about, double degrees) {
  const std::size_t axis = requireTable(context, about);
  machine::AxisPositions position = context.channel().axes();
  position[axis] += degrees / tableTurn(context.channel().description(), position, axis)[about];
  context.channel().moveAxes(position, machine::Feed::at(context.prober().probe().positioningFeed));
  return axis;
}

int firstTableTurn(Context& context) {
  const machine::MachineDescription& description = context.channel().description();
  for (auto element = description.tableChain.rbegin(); element != description.tableChain.rend(); ++element) {
    if (!element->axis || description.axes[*element->axis].kind != machine::AxisKind::Rotary) continue;
    const Vector3 turn = tableTurn(description, context.channel().axes(), *element->axis);
    for (int about = 0; about < 3; ++about) {
      if (std::abs(turn[about]) > 0.999) return about;
    }
    refuseAxis(fmt::format("The first axis of the table, {}, turns about none of X, Y and Z",
                           description.axes[*element->axis].name));
  }
  refuseAxis("The machine has no rotary table");
}

void enterAlignment(Context& context, std::size_t axis, double turned) {
  Control& control = context.control();
  const bool zero = context.option(337) == 1;
  if (zero) {
    zeroRotaryAxisInPreset(context, axis, control.isTNC640() ? PresetRow::OfQ305 : PresetRow::Active);
  } else if (control.isTNC640()) {
    Control::PresetChange change;
    change.rotaryOffset[axis] = control.coordinates.preset.rotaryOffset[axis] + turned;
    writePresetRow(context, control.coordinates.preset.row, change);
  }
  // The workpiece lies straight now. A basic rotation in the row that counts is over, as it was while measuring.
  if (!control.coordinates.preset.spaceAngles.isZero(0)) setBasicRotation(context, 0, 0);
}

void zeroRotaryAxis(Context& context, std::size_t axis, PresetRow row) {
  Control& control = context.control();
  const double position = context.channel().axes()[axis];
  if (context.option(303) == 0) {
    writeDatumAngle(context, axis, position - control.coordinates.preset.rotaryOffset[axis]);
    return;
  }
  zeroRotaryAxisInPreset(context, axis, row);
}

void zeroRotaryAxisInPreset(Context& context, std::size_t axis, PresetRow row) {
  Control& control = context.control();
  Control::PresetChange change;
  change.rotaryOffset[axis] = context.channel().axes()[axis];
  const int number = row == PresetRow::OfQ305 ? context.option(305) : control.coordinates.preset.row;
  if (row == PresetRow::OfQ305 && number == 0) {
    copyActivePresetTo0(context, change);
    return;
  }
  writePresetRow(context, number, change);
}

}  // namespace probewright::cycles::heidenhain
