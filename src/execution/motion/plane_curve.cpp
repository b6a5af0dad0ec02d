#include "execution/motion/plane_curve.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::execution::motion {

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector2 left(const Vector2& direction) { return {-direction.y(), direction.x()}; }

Vector2 turned(const Vector2& v, double angle) {
  return {v.x() * std::cos(angle) - v.y() * std::sin(angle), v.x() * std::sin(angle) + v.y() * std::cos(angle)};
}

std::vector<Vector2> intersections(const PlaneCurve& a, const PlaneCurve& b, double slack) {
  constexpr double parallel = 1e-9;  // sine of the angle between two lines
  constexpr double together = 1e-9;  // mm between two centres
  if (!a.circle && !b.circle) {
    const double determinant = cross(a.direction, b.direction);
    if (std::abs(determinant) < parallel) return {};
    return {a.point + a.direction * (cross(b.point - a.point, b.direction) / determinant)};
  }
  // Both points lie on a common chord: of the line itself, or of the two circles.
  Vector2 middle, along;
  double half = 0;  // of the chord, squared
  if (a.circle != b.circle) {
    const PlaneCurve& line = a.circle ? b : a;
    const PlaneCurve& circle = a.circle ? a : b;
    middle = line.point + line.direction.dot(circle.point - line.point) * line.direction;
    along = line.direction;
    half = circle.radius * circle.radius - (middle - circle.point).squaredNorm();
  } else {
    const Vector2 between = b.point - a.point;
    const double distance = between.norm();
    if (distance < together) return {};
    // The chord is square to the line of centres, at the foot from a's: r^2 - f^2 = R^2 - (d - f)^2.
    const double foot = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
    middle = a.point + between * (foot / distance);
    along = left(between / distance);
    half = a.radius * a.radius - foot * foot;
  }
  if (half < -slack) return {};
  const Vector2 reach = std::sqrt(std::max(half, 0.0)) * along;
  return {middle + reach, middle - reach};
}

std::optional<Vector2> nearest(const std::vector<Vector2>& points, const Vector2& place) {
  if (points.empty()) return std::nullopt;
  return *std::ranges::min_element(points, {}, [&](const Vector2& point) { return (point - place).squaredNorm(); });
}

int piecesOfArc(double radius, double sweep, double tolerance) {
  constexpr int most = 100000;
  constexpr double smallest = 1e-6;  // radians
  const double sagitta = std::min(tolerance, radius / 2);
  const double step = radius > 0 ? 2 * std::acos(1 - sagitta / radius) : std::abs(sweep);
  return static_cast<int>(std::clamp(std::ceil(std::abs(sweep) / std::max(step, smallest)), 1.0, double{most}));
}

}  // namespace probewright::execution::motion
