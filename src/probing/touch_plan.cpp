#include "probing/touch_plan.hpp"

#include <cmath>

namespace probewright::probing {

PlaneWay directionAt(double angle) {
  const double radians = radiansFromDegrees(angle);
  return {std::cos(radians), std::sin(radians), 0};
}

PlaneWay axisDirection(int axis, double sign) {
  PlaneWay direction;
  direction[axis] = sign < 0 ? -1 : 1;
  return direction;
}

std::vector<PlannedTouch> planCircle(const PartPoint& centre, double diameter, double startAngle, double step,
                                     int count, Side side) {
  std::vector<PlannedTouch> plan;
  for (int i = 0; i < count; ++i) {
    const PlaneWay radial = directionAt(startAngle + i * step);
    plan.push_back({centre + radial * diameter / 2, radial * outwards(side)});
  }
  return plan;
}

std::vector<PlannedTouch> planRectangle(const PartPoint& centre, double length1, double length2, Side side) {
  std::vector<PlannedTouch> plan;
  for (const double sign : {1.0, -1.0}) {
    for (int axis = 0; axis < 2; ++axis) {
      const PlaneWay outward = axisDirection(axis, sign);
      plan.push_back({centre + outward * (axis == 0 ? length1 : length2) / 2, outward * outwards(side)});
    }
  }
  return plan;
}

std::vector<PlannedTouch> planWidth(const PartPoint& centre, double width, double angle, Side side) {
  const PlaneWay outward = directionAt(angle);
  return {{centre + outward * width / 2, outward * outwards(side)},
          {centre - outward * width / 2, -outward * outwards(side)}};
}

}  // namespace probewright::probing
