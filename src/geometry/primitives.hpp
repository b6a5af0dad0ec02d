#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

/// The shapes that features are measured as. Lengths in mm; directions are unit vectors unless said otherwise.
namespace probewright {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// A rigid transform. `aFromB * p` turns coordinates in frame B into coordinates in frame A; name poses that way.
using Pose = Eigen::Isometry3d;

struct Line {
  Vector3 point = Vector3::Zero();
  Vector3 direction = Vector3::UnitX();
};

struct Plane {
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
};

struct Circle {
  Vector3 centre = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
  double radius = 0;
};

struct Sphere {
  Vector3 centre = Vector3::Zero();
  double radius = 0;
};

struct Cylinder {
  Vector3 point = Vector3::Zero();
  Vector3 direction = Vector3::UnitZ();
  double radius = 0;
};

constexpr double radiansFromDegrees(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double degreesFromRadians(double radians) { return radians * 180.0 / std::numbers::pi; }

/// The rotation by `degrees` about `axis` (unit vector), right-handed.
Pose rotation(const Vector3& axis, double degrees);

Pose translation(const Vector3& offset);

/// The same angle in (-180, 180].
double normalizedDegrees(double degrees);

}  // namespace probewright
