#include <cmath>

#include "camera/rendering.hpp"

namespace probewright::camera {

namespace {

/// Pixels.
double focalLength(const TrueCamera& camera) {
  return camera.width / 2.0 / std::tan(radiansFromDegrees(camera.fieldOfView) / 2);
}

Vector2 distorted(const TrueCamera& camera, const Vector2& straight) {
  const auto& [k1, k2, p1, p2] = camera.distortion;
  const double x = straight.x(), y = straight.y(), r2 = straight.squaredNorm();
  const double radial = 1 + k1 * r2 + k2 * r2 * r2;
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

}  // namespace

Pose spindleFromCamera(const TrueCamera& camera) {
  const Vector3 right = camera.direction.cross(camera.up).normalized();
  Pose pose = translation(camera.position);
  pose.linear().col(0) = right;
  pose.linear().col(1) = camera.direction.cross(right);
  pose.linear().col(2) = camera.direction;
  return pose;
}

Vector3 rayThrough(const TrueCamera& camera, double x, double y) {
  const double focal = focalLength(camera);
  const Vector2 seen((x - camera.width / 2.0) / focal, (y - camera.height / 2.0) / focal);
  Vector2 straight = seen;
  constexpr int mostSteps = 50;
  for (int i = 0; i < mostSteps; ++i) {
    const Vector2 off = distorted(camera, straight) - seen;
    straight -= off;
    if (off.squaredNorm() < 1e-20) break;
  }
  return {straight.x(), straight.y(), 1};
}

Vector2 pixelOf(const TrueCamera& camera, const Vector3& point) {
  const Vector2 seen = distorted(camera, point.head<2>() / point.z()) * focalLength(camera);
  return seen + Vector2(camera.width, camera.height) / 2;
}

}  // namespace probewright::camera
