#pragma once

#include <optional>
#include <vector>

#include "geometry/primitives.hpp"

/// Lines, circles and arcs in the working plane (main and minor axis, mm): what contours of both vendors are made of.
namespace probewright::execution::motion {

/// A line without ends, or a whole circle.
struct PlaneCurve {
  bool circle = false;
  Vector2 point = Vector2::Zero();       ///< on the line, or the centre
  Vector2 direction = Vector2::UnitX();  ///< of the line, unit length
  double radius = 0;

  static PlaneCurve line(const Vector2& point, const Vector2& direction) {
    return {.circle = false, .point = point, .direction = direction};
  }
  static PlaneCurve circleAbout(const Vector2& centre, double radius) {
    return {.circle = true, .point = centre, .radius = radius};
  }
};

double cross(const Vector2& a, const Vector2& b);
/// Square to `direction`, on its left.
Vector2 left(const Vector2& direction);
/// `v` turned by `angle`, radians, counter-clockwise.
Vector2 turned(const Vector2& v, double angle);

/// Where two curves cross, two points at most; one point twice where they touch. Parallel lines and circles about one
/// centre have none. `slack`: curves that miss each other by less touch; in mm^2, of the square of half their common
/// chord.
std::vector<Vector2> intersections(const PlaneCurve& a, const PlaneCurve& b, double slack = 0);

/// The one of `points` that is nearest to `place`, the first of equals; nothing if there is none.
std::optional<Vector2> nearest(const std::vector<Vector2>& points, const Vector2& place);

/// Into how many straight pieces of equal length an arc is cut, so that none is further from it than `tolerance` (mm):
/// the sagitta of a chord over the angle a is r (1 - cos(a/2)). `sweep`: radians. 1 to 100,000.
int piecesOfArc(double radius, double sweep, double tolerance);

}  // namespace probewright::execution::motion
