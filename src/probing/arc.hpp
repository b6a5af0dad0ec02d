#pragma once

#include <vector>

#include "geometry/primitives.hpp"

namespace probewright::probing {

/// The way from `start` on a circular arc about the parallel to the third axis through `centre`, by `angle` degrees
/// (counterclockwise is positive), at the height of `start`: the ends of straight pieces that leave the arc by at most
/// 0.01 mm. Empty if `start` lies on that axis. mm.
std::vector<Vector3> pointsOnArc(const Vector3& start, const Vector3& centre, double angle);

}  // namespace probewright::probing
