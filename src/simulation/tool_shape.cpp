#include "simulation/tool_shape.hpp"

#include <algorithm>

namespace probewright::simulation {

ToolShape shapeOf(const TrueTool* tool, double spindleDegrees) {
  ToolShape shape;
  if (!tool) return shape;
  const Vector3& up = tool->shankDirection;
  const Vector3 tip = -tool->length * up;
  if (tool->kind == ToolKind::Cutter) {
    const double straight = std::max(tool->length - tool->radius, 0.0);
    shape.tip = tip;
    shape.capsules.push_back({tip + up * std::min(tool->radius, tool->length), up * straight, tool->radius, "tool"});
    return shape;
  }
  const TrueProbe& probe = tool->probe;
  const Matrix3 turned = rotation(Vector3::UnitZ(), spindleDegrees).linear();
  const Vector3 centre = turned * (tip + up * probe.ballRadius + Vector3(probe.tipOffset.x(), probe.tipOffset.y(), 0));
  const Vector3 turnedUp = turned * up;
  shape.ball = Ball{centre, probe.ballRadius};
  shape.tip = centre;
  // The shaft starts clear of the ball, so that a touching ball does not make the shaft touch too.
  const double shaft = probe.stylusLength - probe.ballRadius - probe.stylusRadius;
  if (probe.stylusRadius > 0 && shaft > 0) {
    shape.capsules.push_back(
        {centre + turnedUp * (probe.ballRadius + probe.stylusRadius), turnedUp * shaft, probe.stylusRadius, "stylus"});
  }
  if (probe.bodyRadius > 0) {
    const double straight = std::max(probe.bodyLength - 2 * probe.bodyRadius, 0.0);
    shape.capsules.push_back(
        {centre + turnedUp * (probe.stylusLength + probe.bodyRadius), turnedUp * straight, probe.bodyRadius, "body"});
  }
  return shape;
}

}  // namespace probewright::simulation
