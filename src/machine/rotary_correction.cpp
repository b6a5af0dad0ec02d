#include "machine/rotary_correction.hpp"

#include <algorithm>
#include <vector>

namespace probewright::machine {

namespace {

void correctIn(std::vector<ChainElement>& chain, const RotaryCorrection& correction) {
  for (std::size_t i = 0; i < chain.size(); ++i) {
    ChainElement& element = chain[i];
    if (element.axis != correction.axis) continue;
    element.point += correction.position;
    element.direction = (rotationVector(correction.orientation) * element.direction).normalized();
    if (correction.zero == 0) return;
    const Pose turned =
        translation(element.point) * rotation(element.direction, correction.zero) * translation(-element.point);
    for (std::size_t carried = i + 1; carried < chain.size(); ++carried) {
      chain[carried].point = turned * chain[carried].point;
      chain[carried].direction = turned.linear() * chain[carried].direction;
    }
  }
}

}  // namespace

Pose rotationVector(const Vector3& degrees) {
  const double angle = degrees.norm();
  return angle > 0 ? rotation(degrees / angle, angle) : Pose::Identity();
}

void correct(MachineDescription& machine, const RotaryCorrection& correction) {
  correctIn(machine.tableChain, correction);
  correctIn(machine.spindleChain, correction);
}

MachineDescription corrected(const MachineDescription& built, std::span<const RotaryCorrection> corrections) {
  MachineDescription machine = built;
  for (auto* chain : {&machine.tableChain, &machine.spindleChain}) {
    for (std::size_t i = 0; i < chain->size(); ++i) {
      const auto found = std::ranges::find_if(
          corrections, [&](const RotaryCorrection& each) { return each.axis == (*chain)[i].axis; });
      if (found != corrections.end()) correctIn(*chain, *found);
    }
  }
  return machine;
}

}  // namespace probewright::machine
