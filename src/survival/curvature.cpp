#include "survival/curvature.hpp"

#include <algorithm>

namespace probewright::survival {

double acrossArc(const std::vector<Vector3>& touches, const std::vector<Vector3>& ways) {
  constexpr double parallel = 1e-3, large = 1e9;
  std::vector<Vector3> directions;
  for (const Vector3& way : ways)
    if (std::ranges::none_of(directions, [&](const Vector3& known) { return known.cross(way).norm() < parallel; }))
      directions.push_back(way);
  // Four touches at right angles come from two directions and their opposites: that is far from a short arc.
  if (directions.size() < 3) return large;
  double longest = 0;
  Vector3 begin = touches.front(), along = Vector3::UnitX();
  for (const Vector3& a : touches) {
    for (const Vector3& b : touches) {
      if ((b - a).norm() <= longest) continue;
      longest = (b - a).norm();
      begin = a;
      along = (b - a) / longest;
    }
  }
  double across = 0;
  for (const Vector3& touch : touches)
    across = std::max(across, (touch - begin).cross(along).norm());
  return across;
}

}  // namespace probewright::survival
