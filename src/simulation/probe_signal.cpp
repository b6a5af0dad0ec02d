#include "simulation/probe_signal.hpp"

#include <cmath>

#include "simulation/tool_shape.hpp"

namespace probewright::simulation {

double pretravelOf(const TrueTool& tool, double spindleDegrees, const Vector3& normal) {
  const TrueProbe& probe = tool.probe;
  const Vector3 n = rotation(Vector3::UnitZ(), -spindleDegrees).linear() * (toolFrame(tool).transpose() * normal);
  const double axial = std::pow(n.z(), 2);
  const double lobed =
      probe.lobing == 0
          ? 0
          : probe.lobing * std::cos(3 * (std::atan2(n.y(), n.x()) - radiansFromDegrees(probe.lobingPhase)));
  return (1 - axial) * (probe.pretravel + lobed) + axial * probe.axialPretravel;
}

Push pushOf(const Vector3& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return static_cast<Push>(2 * axis + (direction[axis] < 0 ? 1 : 0));
}

}  // namespace probewright::simulation
