#include "simulation/tool_shape.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::simulation {

namespace {

/// A cylinder from `base` along `up` (unit).
void addCylinder(ToolShape& shape, const Vector3& base, const Vector3& up, double length, double radius,
                 const char* part) {
  if (length > 0) shape.shafts.push_back({base, up * length, radius, part, Ends::Flat});
}

/// The cylinder about all edges, the shank and the holder.
void addCutter(ToolShape& shape, const TrueTool& tool, double spindleDegrees) {
  const TrueCutter& cutter = tool.cutter;
  const Vector3& up = shape.shank;
  double radius = tool.radius, longer = 0;
  for (const TrueTooth& tooth : cutter.teeth) {
    radius = std::max(radius, tool.radius + tooth.radial);
    longer = std::max(longer, tooth.axial);
  }
  if (!(radius > 0)) return;
  const Vector3 aside = toolFrame(tool) * rotation(Vector3::UnitZ(), spindleDegrees).linear() *
                        Vector3(offsetOf(cutter).x(), offsetOf(cutter).y(), 0);
  const double body = tool.length - cutter.holderLength;
  const double edges = cutter.cutLength > 0 ? std::min(cutter.cutLength, body) : body;
  addCylinder(shape, shape.tip + aside - longer * up, up, edges + longer, radius, cutterName);
  const double shank = cutter.shankRadius > 0 ? cutter.shankRadius : tool.radius;
  addCylinder(shape, shape.tip + aside + edges * up, up, body - edges, shank, "shank");
  if (cutter.holderRadius > 0)
    addCylinder(shape, shape.tip + body * up, up, cutter.holderLength, cutter.holderRadius, "holder");
}

}  // namespace

Matrix3 toolFrame(const TrueTool& tool) {
  const Vector3& up = tool.shankDirection;
  Matrix3 frame;
  if (up.isApprox(Vector3::UnitX())) {
    frame << Vector3::UnitY(), Vector3::UnitZ(), Vector3::UnitX();
  } else if (up.isApprox(Vector3::UnitY())) {
    frame << Vector3::UnitZ(), Vector3::UnitX(), Vector3::UnitY();
  } else {
    frame = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), up).toRotationMatrix();
  }
  return frame;
}

ToolShape shapeOf(const TrueTool* tool, double spindleDegrees) {
  ToolShape shape;
  if (!tool) return shape;
  const Vector3& up = tool->shankDirection;
  const Vector3 tip = tool->mount - tool->length * up;
  shape.shank = up;
  if (tool->kind == ToolKind::Cutter) {
    shape.tip = tip;
    addCutter(shape, *tool, spindleDegrees);
    return shape;
  }
  const TrueProbe& probe = tool->probe;
  const Vector3 offset = toolFrame(*tool) * rotation(Vector3::UnitZ(), spindleDegrees).linear() *
                         Vector3(probe.tipOffset.x(), probe.tipOffset.y(), 0);
  const Vector3 centre = tip + up * probe.ballRadius + offset;
  shape.tip = centre;
  // The shaft starts clear of the ball, so that a touching ball does not make the shaft touch too.
  const double clear = probe.ballRadius + probe.stylusRadius;
  // A ball far off the spindle axis sits at the end of an arm: the stylus is an L.
  const Vector3 onAxis = tip + up * probe.ballRadius;
  const Vector3 arm = onAxis - centre;
  if (probe.starArm > 0) {
    for (int i = 0; i < 4; ++i) {
      const Vector3 along =
          toolFrame(*tool) * rotation(Vector3::UnitZ(), spindleDegrees + 90 * i).linear() * Vector3::UnitX();
      shape.balls.push_back({centre + along * probe.starArm, probe.ballRadius});
      if (probe.stylusRadius > 0 && probe.starArm > clear)
        shape.shafts.push_back({centre, along * (probe.starArm - clear), probe.stylusRadius, shaftName});
    }
    if (probe.stylusRadius > 0)
      shape.shafts.push_back({centre, up * probe.stylusLength, probe.stylusRadius, shaftName});
    if (probe.bodyRadius > 0)
      addCylinder(shape, centre + up * probe.stylusLength, up, probe.bodyLength, probe.bodyRadius, "body");
    return shape;
  }
  shape.balls.push_back({centre, probe.ballRadius});
  const bool bent = arm.norm() > 2 * clear;
  const Vector3 foot = bent ? onAxis : centre;
  if (probe.stylusRadius > 0 && bent) {
    const Vector3 along = arm.normalized();
    shape.shafts.push_back({centre + along * clear, arm - along * clear, probe.stylusRadius, shaftName});
    shape.shafts.push_back({foot, up * probe.stylusLength, probe.stylusRadius, shaftName});
  } else if (probe.stylusRadius > 0 && probe.stylusLength > clear) {
    shape.shafts.push_back({centre + up * clear, up * (probe.stylusLength - clear), probe.stylusRadius, shaftName});
  }
  if (probe.bodyRadius > 0) {
    addCylinder(shape, foot + up * probe.stylusLength, up, probe.bodyLength, probe.bodyRadius, "body");
  }
  return shape;
}

}  // namespace probewright::simulation
