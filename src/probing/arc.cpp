#include "probing/arc.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::probing {

std::vector<Vector3> pointsOnArc(const Vector3& start, const Vector3& centre, double angle) {
  const Vector2 arm = (start - centre).head<2>();
  const double radius = arm.norm();
  if (radius < 1e-9) return {};
  const double piece = 2 * std::acos(std::clamp(1 - 0.01 / radius, -1.0, 1.0));
  const double turn = radiansFromDegrees(angle);
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / piece)));
  std::vector<Vector3> points;
  for (int i = 1; i <= pieces; ++i) {
    const Vector2 point = centre.head<2>() + Eigen::Rotation2Dd(turn * i / pieces) * arm;
    points.emplace_back(point.x(), point.y(), start.z());
  }
  return points;
}

}  // namespace probewright::probing
