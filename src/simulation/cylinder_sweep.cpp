#include <algorithm>
#include <cmath>

#include "simulation/sweep.hpp"

namespace probewright::simulation {
namespace {

/// The triangle as the cylinder sees it: x and y across its axis, z along it, from the middle of its lower end at the
/// start of the way.
class TriangleOverCylinder {
public:
  TriangleOverCylinder(const Way& way, const Vector3& axis, const Triangle& t) : height_(axis.norm()) {
    const Vector3 up = axis / height_;
    const Vector3 x = up.unitOrthogonal();
    frame_ << x.transpose(), up.cross(x).transpose(), up.transpose();
    for (std::size_t i = 0; i < 3; ++i)
      corners_[i] = frame_ * (t[i] - way.start);
    direction_ = frame_ * way.direction;
  }

  /// The stretch of the way, within [0, limit], on which the triangle is at the height of the cylinder.
  std::pair<double, double> stretch(double limit) const {
    const double low = std::min({corners_[0].z(), corners_[1].z(), corners_[2].z()});
    const double high = std::max({corners_[0].z(), corners_[1].z(), corners_[2].z()});
    const double bottom = kTouchTolerance, top = height_ - kTouchTolerance;
    const double speed = direction_.z();
    if (std::abs(speed) < 1e-14) return high > bottom && low < top ? std::pair(0.0, limit) : std::pair(1.0, 0.0);
    // bottom + s * speed < high and top + s * speed > low
    const double a = (high - bottom) / speed;
    const double b = (low - top) / speed;
    return {std::max(0.0, std::min(a, b)), std::min(limit, std::max(a, b))};
  }

  /// What of the triangle lies nearest to the axis, of all that is at the cylinder's height.
  struct Nearest {
    double distance = 1e300;
    Vector3 point = Vector3::Zero();  ///< on the triangle, in its frame
  };

  Nearest nearestAt(double s) const {
    const Vector3 middle = s * direction_;
    std::array<Vector3, 5> polygon;
    const std::size_t count = clipped(middle.z() + kTouchTolerance, middle.z() + height_ - kTouchTolerance, polygon);
    Nearest nearest;
    bool left = false, right = false;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3& a = polygon[i];
      const Vector3& b = polygon[(i + 1) % count];
      const Vector2 edge = (b - a).head<2>();
      const Vector2 arm = (middle - a).head<2>();
      const double squared = edge.squaredNorm();
      const double share = squared > 0 ? std::clamp(arm.dot(edge) / squared, 0.0, 1.0) : 0.0;
      const double distance = (arm - share * edge).norm();
      if (distance < nearest.distance) nearest = {distance, a + share * (b - a)};
      const double turn = edge.x() * arm.y() - edge.y() * arm.x();
      left = left || turn > 0;
      right = right || turn < 0;
    }
    if (count < 3 || left == right) return nearest;
    // The axis pierces the triangle.
    const Vector3 normal = (corners_[1] - corners_[0]).cross(corners_[2] - corners_[0]);
    if (normal.z() == 0) return nearest;
    const Vector2 arm = (middle - corners_[0]).head<2>();
    nearest.point = middle;
    nearest.point.z() = corners_[0].z() - normal.head<2>().dot(arm) / normal.z();
    nearest.distance = 0;
    return nearest;
  }

  Vector3 inSpace(const Way& way, const Vector3& point) const { return way.start + frame_.transpose() * point; }

private:
  /// The triangle between two heights.
  std::size_t clipped(double low, double high, std::array<Vector3, 5>& polygon) const {
    std::array<Vector3, 5> from{corners_[0], corners_[1], corners_[2]};
    std::size_t count = 3;
    for (const double side : {1.0, -1.0}) {
      const double limit = side > 0 ? low : -high;
      std::size_t kept = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Vector3& a = from[i];
        const Vector3& b = from[(i + 1) % count];
        const double da = side * a.z() - limit, db = side * b.z() - limit;
        if (da >= 0) polygon[kept++] = a;
        if ((da < 0) != (db < 0) && kept < polygon.size()) polygon[kept++] = a + da / (da - db) * (b - a);
      }
      count = kept;
      from = polygon;
    }
    return count;
  }

  double height_;
  Matrix3 frame_;
  std::array<Vector3, 3> corners_;
  Vector3 direction_;
};

}  // namespace

bool sweepCylinder(const Way& way, double radius, const Vector3& axis, const Triangle& t, Meeting& best) {
  const TriangleOverCylinder view(way, axis, t);
  const double limit = std::min(way.length, best.when);
  const auto [begin, end] = view.stretch(limit);
  if (!(begin <= end) || limit < 0) return false;
  const double reach = radius - kTouchTolerance;
  const auto keep = [&](double when, const Vector3& point) {
    if (when >= best.when) return false;
    best = {when, view.inSpace(way, point), Vector3::Zero()};
    return true;
  };
  // While the triangle is at the cylinder's height, its distance from the axis is a convex function of the way: a
  // secant through two places before the contact comes down before it, too, and nearer each time.
  constexpr double kStep = 1e-6, kPrecision = 1e-7;
  double at = begin;
  for (int i = 0; i < 60; ++i) {
    const auto here = view.nearestAt(at);
    const double gap = here.distance - reach;
    if (gap <= (i == 0 ? 0 : kPrecision)) return keep(at == 0 && gap < 0 ? -kPrecision : at, here.point);
    const auto next = view.nearestAt(std::min(at + kStep, end));
    const double slope = (next.distance - here.distance) / kStep;
    if (!(slope < -1e-9)) return false;
    at += std::max(gap / -slope, kStep);
    if (at > end) return view.nearestAt(end).distance <= reach && keep(end, view.nearestAt(end).point);
  }
  return keep(at, view.nearestAt(at).point);
}

}  // namespace probewright::simulation
