#include "control/believed_kinematics.hpp"
#include "geometry/decompositions.hpp"

namespace probewright::control {

namespace {

const machine::ChainElement* elementOf(const machine::MachineDescription& machine, std::size_t axis) {
  for (const auto* chain : {&machine.tableChain, &machine.spindleChain}) {
    for (const machine::ChainElement& element : *chain) {
      if (element.axis == axis) return &element;
    }
  }
  return nullptr;
}

/// The shortest turn from one direction to another, as a rotation vector in degrees.
Vector3 turnBetween(const Vector3& from, const Vector3& to) {
  const Eigen::AngleAxisd turn(shortestTurn(from, to));
  return degreesFromRadians(turn.angle()) * turn.axis();
}

}  // namespace

std::vector<machine::RotaryCorrection> believedCorrections(const machine::MachineDescription& built,
                                                           const BelievedKinematics& kinematics) {
  std::vector<machine::RotaryCorrection> corrections;
  for (std::size_t axis = 0; axis < built.axes.size(); ++axis) {
    const machine::ChainElement* element = elementOf(built, axis);
    if (built.axes[axis].kind != machine::AxisKind::Rotary || element == nullptr) continue;
    machine::RotaryCorrection correction{.axis = axis};
    if (const auto found = kinematics.find(built.axes[axis].name); found != kinematics.end()) {
      const BelievedRotaryAxis& belief = found->second;
      correction.position = belief.position;
      if (belief.point) correction.position += *belief.point - element->point;
      correction.orientation = belief.orientation;
      if (belief.direction) {
        const Vector3 turned = machine::rotationVector(belief.orientation) * *belief.direction;
        correction.orientation = turnBetween(element->direction, turned);
      }
    }
    corrections.push_back(correction);
  }
  return corrections;
}

machine::MachineDescription believedMachine(const machine::MachineDescription& built,
                                            const BelievedKinematics& kinematics) {
  return machine::corrected(built, believedCorrections(built, kinematics));
}

}  // namespace probewright::control
