#pragma once

#include <span>

#include "cycles/catalogue.hpp"
#include "geometry/primitives.hpp"

namespace probewright::cycles::sinumerik {

/// Its entry for help and lists. The call takes variables, not values: the language carries it out.
extern const CycleDefinition cycle116Definition;

/// What CYCLE116 computes.
struct CircleThroughPoints {
  Vector2 centre = Vector2::Zero();
  double radius = 0;
  int error = 0;  ///< 0, 61316: no circle passes through the points, 61317: the points are not three or four
};

/// The circle through three points; through four the one with the least sum of squared distances.
CircleThroughPoints circleThroughPoints(std::span<const Vector2> points);

}  // namespace probewright::cycles::sinumerik
