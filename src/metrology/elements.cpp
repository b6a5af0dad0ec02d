#include "metrology/elements.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::metrology {

namespace {

constexpr double parallelSine = 1e-9;
constexpr double flatness = 1e-9;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Result<Circle2> circleThrough(const Vector2& a, const Vector2& b, const Vector2& c) {
  const Vector2 ab = b - a;
  const Vector2 ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  const double area = cross(ab, ac);
  if (!(std::abs(area) > flatness * longest)) {
    return fail("the three points lie on one straight line or coincide", "measure points that are farther apart");
  }
  const double abSquared = ab.squaredNorm();
  const double acSquared = ac.squaredNorm();
  const Vector2 fromA(ac.y() * abSquared - ab.y() * acSquared, ab.x() * acSquared - ac.x() * abSquared);
  const Vector2 offset = fromA / (2 * area);
  return Circle2{a + offset, offset.norm()};
}

Result<Vector2> intersection(const Line2& a, const Line2& b) {
  const Vector2 alongA = a.direction.normalized();
  const Vector2 alongB = b.direction.normalized();
  const double sine = cross(alongA, alongB);
  if (!(std::abs(sine) > parallelSine)) {
    return fail("the two lines are parallel and do not intersect", "probe edges that are not parallel");
  }
  return Vector2(a.point + alongA * (cross(b.point - a.point, alongB) / sine));
}

}  // namespace probewright::metrology
