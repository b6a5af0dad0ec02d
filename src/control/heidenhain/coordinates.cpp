#include "control/heidenhain/coordinates.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::control::heidenhain {

bool Transformations::active() const {
  return !shift.isZero(0) || mirror[0] || mirror[1] || mirror[2] || rotation != 0 || !scale.isOnes(0) ||
         axisShift != machine::AxisPositions{} || mirroredAxes != 0;
}

Eigen::Affine3d Transformations::matrix(const WorkingPlane& plane) const {
  Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
  matrix.translate(shift);
  matrix = matrix * Eigen::Affine3d(directions(plane));
  matrix.translate(scaleCentre);
  matrix.scale(scale);
  matrix.translate(-scaleCentre);
  return matrix;
}

Matrix3 Transformations::directions(const WorkingPlane& plane) const {
  Vector3 signs = Vector3::Ones();
  for (int i = 0; i < 3; ++i) {
    if (mirror[static_cast<std::size_t>(i)]) signs[i] = -1;
  }
  Vector3 toolAxis = Vector3::Zero();
  toolAxis[plane.tool] = 1;
  return signs.asDiagonal() * Eigen::AngleAxisd(radiansFromDegrees(rotation), toolAxis).toRotationMatrix();
}

Matrix3 rotationFromSpaceAngles(const Vector3& degrees) {
  return (Eigen::AngleAxisd(radiansFromDegrees(degrees.z()), Vector3::UnitZ()) *
          Eigen::AngleAxisd(radiansFromDegrees(degrees.y()), Vector3::UnitY()) *
          Eigen::AngleAxisd(radiansFromDegrees(degrees.x()), Vector3::UnitX()))
      .toRotationMatrix();
}

Vector3 spaceAnglesFromRotation(const Matrix3& rotation) {
  const double sinB = std::clamp(-rotation(2, 0), -1.0, 1.0);
  const double cosB = std::hypot(rotation(0, 0), rotation(1, 0));
  double a = 0;
  double c = 0;
  if (cosB > 1e-12) {
    a = std::atan2(rotation(2, 1), rotation(2, 2));
    c = std::atan2(rotation(1, 0), rotation(0, 0));
  } else {
    c = std::atan2(-rotation(0, 1), rotation(1, 1));
  }
  return {degreesFromRadians(a), degreesFromRadians(std::atan2(sinB, cosB)), degreesFromRadians(c)};
}

machine::AxisPositions Coordinates::axisOffset() const {
  machine::AxisPositions offset = preset.rotaryOffset;
  for (std::size_t i = 0; i < machine::maximumAxes; ++i)
    offset[i] += turnsTaken[i] + workpiece.axisShift[i] + (tilt ? workingPlane.axisShift[i] : 0);
  return offset;
}

double Coordinates::axisSign(std::size_t axis) const {
  const unsigned mirrored = workpiece.mirroredAxes ^ (tilt ? workingPlane.mirroredAxes : 0U);
  return (mirrored >> axis & 1U) != 0 ? -1 : 1;
}

Pose Coordinates::machineFromPreset() const {
  Pose pose = Pose::Identity();
  pose.translation() = preset.origin;
  pose.linear() = rotationFromSpaceAngles(preset.spaceAngles);
  return pose;
}

Eigen::Affine3d Coordinates::machineFromProgram() const {
  Eigen::Affine3d matrix(machineFromPreset().matrix());
  matrix = matrix * workpiece.matrix(plane);
  if (tilt) {
    matrix = matrix * Eigen::Affine3d(*tilt) * workingPlane.matrix(plane);
  }
  return matrix;
}

}  // namespace probewright::control::heidenhain
