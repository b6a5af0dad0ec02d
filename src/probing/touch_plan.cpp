#include "probing/touch_plan.hpp"

#include <cmath>

namespace probewright::probing {

Vector3 directionAt(double angle) {
  const double radians = radiansFromDegrees(angle);
  return {std::cos(radians), std::sin(radians), 0};
}

Vector3 axisDirection(int axis, double sign) {
  Vector3 direction = Vector3::Zero();
  direction[axis] = sign < 0 ? -1 : 1;
  return direction;
}

std::vector<PlannedTouch> planCircle(const Vector3& centre, double diameter, double startAngle, double step, int count,
                                     Side side) {
  std::vector<PlannedTouch> plan;
  for (int i = 0; i < count; ++i) {
    const Vector3 radial = directionAt(startAngle + i * step);
    plan.push_back({centre + radial * diameter / 2, radial * outwards(side)});
  }
  return plan;
}

std::vector<PlannedTouch> planRectangle(const Vector3& centre, double length1, double length2, Side side) {
  std::vector<PlannedTouch> plan;
  for (const double sign : {1.0, -1.0}) {
    for (int axis = 0; axis < 2; ++axis) {
      const Vector3 outward = axisDirection(axis, sign);
      plan.push_back({centre + outward * (axis == 0 ? length1 : length2) / 2, outward * outwards(side)});
    }
  }
  return plan;
}

std::vector<PlannedTouch> planWidth(const Vector3& centre, double width, double angle, Side side) {
  const Vector3 outward = directionAt(angle);
  return {{centre + outward * width / 2, outward * outwards(side)},
          {centre - outward * width / 2, -outward * outwards(side)}};
}

}  // namespace probewright::probing
