#pragma once

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"

/// Shapes of the plane through exactly as many points as they need, and where they cross. Lengths in mm. Directions
/// given to a function need not be unit vectors but must not be zero.
///
/// A relation that does not exist (parallel lines, collinear points) is a Diagnostic. "Parallel" means within 1e-9 rad,
/// "collinear" within 1e-9 of the extent of the points: tighter than anything a probe can tell apart, wide enough that
/// rounding never passes for an intersection.
namespace probewright::metrology {

/// A straight line in a plane. Its left side is the positive one.
struct Line2 {
  Vector2 point = Vector2::Zero();
  Vector2 direction = Vector2::UnitX();
};

/// A circle in a plane.
struct Circle2 {
  Vector2 centre = Vector2::Zero();
  double radius = 0;
};

/// The circle through three points. Fails if they are collinear or two of them coincide.
Result<Circle2> circleThrough(const Vector2& a, const Vector2& b, const Vector2& c);

/// Where two lines of a plane cross. Fails if they are parallel.
Result<Vector2> intersection(const Line2& a, const Line2& b);

}  // namespace probewright::metrology
