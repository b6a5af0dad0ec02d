#include "machine/description.hpp"

#include <cmath>

namespace probewright::machine {

namespace {

Pose chainPose(const std::vector<Axis>& axes, const std::vector<ChainElement>& chain, const AxisPositions& q) {
  Pose pose = Pose::Identity();
  for (const ChainElement& element : chain) {
    if (!element.axis) {  // shifts by its point; only what a control believes has such an offset
      pose = pose * translation(element.point);
      continue;
    }
    const double position = q[*element.axis];
    if (axes[*element.axis].kind == AxisKind::Linear) {
      pose = pose * translation(element.direction * position);
    } else {
      pose = pose * translation(element.point) * rotation(element.direction, position) * translation(-element.point);
    }
  }
  return pose;
}

}  // namespace

double shownPosition(const Axis& axis, double position) {
  return axis.modulo ? position - 360 * std::floor((position + 1e-9) / 360) : position;
}

std::optional<std::size_t> MachineDescription::axisIndex(std::string_view axisName) const {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].name == axisName) return i;
  }
  return std::nullopt;
}

Pose baseFromTable(const MachineDescription& machine, const AxisPositions& q) {
  return chainPose(machine.axes, machine.tableChain, q);
}

Pose baseFromSpindle(const MachineDescription& machine, const AxisPositions& q) {
  return chainPose(machine.axes, machine.spindleChain, q);
}

}  // namespace probewright::machine
