#include "geometry/primitives.hpp"

#include <cmath>

namespace probewright {

Pose rotation(const Vector3& axis, double degrees) {
  return Pose(Eigen::AngleAxisd(radiansFromDegrees(degrees), axis));
}

Pose translation(const Vector3& offset) {
  Pose pose = Pose::Identity();
  pose.translation() = offset;
  return pose;
}

double normalizedDegrees(double degrees) {
  const double folded = std::remainder(degrees, 360.0);
  return folded <= -180.0 ? folded + 360.0 : folded;
}

}  // namespace probewright
