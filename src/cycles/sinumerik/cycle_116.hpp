#pragma once

#include <span>

#include "geometry/primitives.hpp"

namespace probewright::cycles::sinumerik {

/// What CYCLE116 computes.
struct CircleThroughPoints {
  Vector2 centre = Vector2::Zero();
  double radius = 0;
  int error = 0;  ///< 0, 61316: no circle passes through the points, 61317: the points are not three or four
};

/// The circle through three points; through four the one with the least sum of squared distances.
CircleThroughPoints circleThroughPoints(std::span<const Vector2> points);

}  // namespace probewright::cycles::sinumerik
