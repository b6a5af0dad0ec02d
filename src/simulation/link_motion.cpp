#include "simulation/link_motion.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::simulation {

using machine::AxisKind;
using machine::AxisPositions;
using machine::ChainElement;

namespace {

/// Moves of a chain out to the end, with what their axes read.
Pose poseOf(const ChainElement& element, const std::vector<machine::Axis>& axes, const AxisPositions& q) {
  if (!element.axis) return translation(element.point);
  const double position = q[*element.axis];
  if (axes[*element.axis].kind == AxisKind::Linear) return translation(element.direction * position);
  return translation(element.point) * rotation(element.direction, position) * translation(-element.point);
}

}  // namespace

double longestWay(const std::vector<ChainElement>& chain, const std::vector<machine::Axis>& axes, const Motion& motion,
                  Vector3 centre, double radius) {
  const auto turns = [&](const ChainElement& element) {
    return element.axis && axes[*element.axis].kind != AxisKind::Linear &&
           motion.to[*element.axis] != motion.from[*element.axis];
  };
  // Where the parts of the chain stand is asked only if one of them turns what it carries.
  const bool anyTurn = std::ranges::any_of(chain, turns);
  double way = 0;
  for (auto element = chain.rbegin(); element != chain.rend(); ++element) {
    if (element->axis) {
      const double travel = std::abs(motion.to[*element->axis] - motion.from[*element->axis]);
      if (axes[*element->axis].kind == AxisKind::Linear) {
        way += travel;
      } else if (travel > 0) {
        const Vector3 arm = centre - element->point;
        const double distance = (arm - arm.dot(element->direction) * element->direction).norm();
        way += radiansFromDegrees(travel) * (distance + radius + way);
      }
    }
    if (anyTurn) centre = poseOf(*element, axes, motion.slidesAtStart) * centre;
  }
  return way;
}

}  // namespace probewright::simulation
