#include "execution/motion/tilted_plane.hpp"

#include <cmath>

namespace probewright::execution::motion {

Matrix3 planeAlong(const Vector3& along, const Vector3& normal) {
  const Vector3 z = normal.normalized();
  const Vector3 x = (along - z * z.dot(along)).normalized();
  Matrix3 axes;
  axes.col(0) = x;
  axes.col(1) = z.cross(x);
  axes.col(2) = z;
  return axes;
}

Matrix3 planeOfProjections(double inZx, double inYz) {
  const double first = radiansFromDegrees(inZx), second = radiansFromDegrees(inYz);
  const Vector3 traceX(std::cos(first), 0, -std::sin(first));
  const Vector3 traceY(0, std::cos(second), std::sin(second));
  return planeAlong(traceX, traceX.cross(traceY));
}

}  // namespace probewright::execution::motion
