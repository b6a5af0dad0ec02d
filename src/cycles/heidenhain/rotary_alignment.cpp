#include "cycles/heidenhain/rotary_alignment.hpp"

#include <fmt/format.h>

#include "control/alarm.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;

std::size_t turnWorkpiece(Context& context, int about, double degrees) {
  const machine::MachineDescription& description = context.channel().description();
  machine::AxisPositions position = context.channel().axes();
  Vector3 wanted = Vector3::Zero();
  wanted[about] = 1;
  for (std::size_t axis = 0; axis < description.axes.size(); ++axis) {
    if (description.axes[axis].kind != machine::AxisKind::Rotary) continue;
    // How the table turns while this axis turns by one degree.
    machine::AxisPositions next = position;
    next[axis] += 1;
    const Matrix3 turn = machine::baseFromTable(description, next).linear() *
                         machine::baseFromTable(description, position).linear().transpose();
    const Eigen::AngleAxisd rotation(turn);
    const double along = rotation.axis().dot(wanted) * degreesFromRadians(rotation.angle());
    if (std::abs(along) < 0.999) continue;
    position[axis] += degrees / along;
    context.channel().moveAxes(position, machine::Feed::at(context.prober().probe().positioningFeed));
    return axis;
  }
  throw Alarm("Rotary axis not available",
              fmt::format("The machine has no rotary table that turns the workpiece about {}", "XYZ"[about]),
              "use a basic rotation instead");
}

void zeroRotaryAxis(Context& context, std::size_t axis, bool rowGiven) {
  Control& control = context.control();
  const double position = context.channel().axes()[axis];
  if (context.option(303) == 0) {
    writeDatumAngle(context, axis, position - control.coordinates.preset.rotaryOffset[axis]);
    return;
  }
  zeroRotaryAxisInPreset(context, axis, rowGiven);
}

void zeroRotaryAxisInPreset(Context& context, std::size_t axis, bool rowGiven) {
  Control& control = context.control();
  Control::PresetChange change;
  change.rotaryOffset[axis] = context.channel().axes()[axis];
  const int row = rowGiven ? context.option(305) : control.coordinates.preset.row;
  if (rowGiven && row == 0) {
    copyActivePresetTo0(context, change);
    return;
  }
  writePresetRow(context, row, change);
}

}  // namespace probewright::cycles::heidenhain
