#include "simulation/analytic_solids.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::simulation {

namespace {

constexpr double touchTolerance = 1e-9;
constexpr double farAway = 1e300;

Vector3 unitOr(const Vector3& vector, const Vector3& fallback) {
  const double length = vector.norm();
  return length > 0 ? Vector3(vector / length) : fallback;
}

/// The direction of p from the Z axis through `centre`; X on the axis itself.
Vector3 radialDirection(const Vector3& p, const Vector2& centre) {
  return unitOr(Vector3(p.x() - centre.x(), p.y() - centre.y(), 0), Vector3::UnitX());
}

/// The nearest point of the rectangle [low, high] (radius, height) in the half plane through the Z axis and `point`.
ClosestPoint closestOfTurnedRectangle(const Vector3& point, const Vector2& low, const Vector2& high) {
  const Vector3 outwards = radialDirection(point, Vector2::Zero());
  const Vector2 p(std::hypot(point.x(), point.y()), point.z());
  const Vector2 nearest = p.cwiseMax(low).cwiseMin(high);
  const auto inSpace = [&](const Vector2& q) { return Vector3(outwards * q.x() + Vector3::UnitZ() * q.y()); };
  if (nearest != p) {
    const double distance = (p - nearest).norm();
    return {distance, inSpace(nearest), inSpace(p - nearest) / distance};
  }
  const double depths[] = {p.x() - low.x(), high.x() - p.x(), p.y() - low.y(), high.y() - p.y()};
  const Vector2 normals[] = {-Vector2::UnitX(), Vector2::UnitX(), -Vector2::UnitY(), Vector2::UnitY()};
  // A bar has no inner wall.
  const int first = low.x() > 0 ? 0 : 1;
  const auto side = std::min_element(depths + first, depths + 4) - depths;
  return {-depths[side], inSpace(p + normals[side] * depths[side]), inSpace(normals[side])};
}

/// How far a body travels until `gap` (its signed distance from the solid) has fallen below -touchTolerance, give or
/// take `precision`; nothing if the way is free. The gap shrinks by at most the distance travelled, so while it is open
/// the body may travel that far at once.
template <class Gap>
std::optional<double> march(double length, Gap gap, double precision) {
  constexpr double longestGlide = 0.01;
  double travelled = 0;
  double free = gap(0.0);
  if (free < -touchTolerance) return 0.0;
  double glide = precision;
  while (travelled < length) {
    glide = free > precision ? precision : std::min(2 * glide, longestGlide);
    double next = std::min(length, travelled + std::max(free, glide));
    free = gap(next);
    if (free < -touchTolerance) {
      while (next - travelled > 0.1 * precision) {
        const double middle = 0.5 * (travelled + next);
        (gap(middle) < -touchTolerance ? next : travelled) = middle;
      }
      return next;
    }
    travelled = next;
  }
  return std::nullopt;
}

}  // namespace

std::optional<BallContact> DistanceSolid::firstContact(const Vector3& from, const Vector3& to, double radius) const {
  const double length = (to - from).norm();
  const Vector3 direction = length > 0 ? Vector3((to - from) / length) : Vector3::Zero();
  const auto gap = [&](double travelled) { return closest(from + direction * travelled).distance - radius; };
  const auto travelled = march(length, gap, 1e-7);
  if (!travelled) return std::nullopt;
  double contact = *travelled;
  // The last 1e-7 mm by Newton: the surface is smooth at that scale, or the step is too small to matter.
  for (int i = 0; i < 3 && contact > 0; ++i) {
    const ClosestPoint near = closest(from + direction * contact);
    const double closing = -near.normal.dot(direction);
    if (closing < 1e-3) break;
    const double step = (near.distance - radius) / closing;
    if (std::abs(step) > 1e-3) break;
    contact = std::clamp(contact + step, 0.0, length);
  }
  const Vector3 centre = from + direction * contact;
  const ClosestPoint near = closest(centre);
  return BallContact{length > 0 ? contact / length : 0.0, centre, near.point, near.normal};
}

std::optional<BallContact> DistanceSolid::firstCapsuleContact(const Vector3& from, const Vector3& to,
                                                              const Vector3& axis, double radius) const {
  constexpr int samples = 16;
  const auto closestOfSegment = [&](const Vector3& p) {
    int best = 0;
    double bestDistance = farAway;
    for (int i = 0; i <= samples; ++i) {
      const double distance = closest(p + axis * (double(i) / samples)).distance;
      if (distance < bestDistance) {
        bestDistance = distance;
        best = i;
      }
    }
    double low = double(std::max(best - 1, 0)) / samples;
    double high = double(std::min(best + 1, samples)) / samples;
    for (int i = 0; i < 30; ++i) {
      const double a = low + (high - low) * 0.382, b = low + (high - low) * 0.618;
      if (closest(p + axis * a).distance < closest(p + axis * b).distance) {
        high = b;
      } else {
        low = a;
      }
    }
    return closest(p + axis * (0.5 * (low + high)));
  };
  const double length = (to - from).norm();
  const Vector3 direction = length > 0 ? Vector3((to - from) / length) : Vector3::Zero();
  const auto gap = [&](double travelled) { return closestOfSegment(from + direction * travelled).distance - radius; };
  const auto travelled = march(length, gap, 1e-4);
  if (!travelled) return std::nullopt;
  const Vector3 p = from + direction * *travelled;
  const ClosestPoint near = closestOfSegment(p);
  return BallContact{length > 0 ? *travelled / length : 0.0, p, near.point, near.normal};
}

std::optional<BallContact> DistanceSolid::firstCylinderContact(const Vector3& from, const Vector3& to,
                                                               const Vector3& axis, double radius) const {
  const double height = axis.norm();
  const Vector3 up = axis / height, x = up.unitOrthogonal(), y = up.cross(x);
  const auto within = [&](const Vector3& base, const Vector3& point) {
    const Vector3 arm = point - base;
    const double along = arm.dot(up);
    const Vector3 aside = arm - along * up;
    const double far = aside.norm();
    return Vector3(base + std::clamp(along, 0.0, height) * up +
                   (far > radius ? Vector3(aside * (radius / far)) : aside));
  };
  // From some places of the cylinder to the nearest of the solid, from there to the nearest of the cylinder, and again.
  const auto closestOfCylinder = [&](const Vector3& base) {
    const double around = std::hypot(height / 2, radius);
    ClosestPoint best = closest(base + axis / 2);
    if (best.distance > around + 1) return ClosestPoint{best.distance - around, best.point, best.normal};
    const auto look = [&](Vector3 place) {
      ClosestPoint near = closest(place);
      for (int i = 0; i < 20 && near.distance > 0; ++i) {
        const Vector3 next = within(base, near.point);
        const bool settled = (next - place).norm() < 1e-6;
        place = next;
        near = closest(place);
        if (settled) break;
      }
      // A point of the solid's surface within the cylinder: as deep as it lies there.
      const Vector3 arm = near.point - base;
      const double along = arm.dot(up);
      const double depth = std::min({along, height - along, radius - (arm - along * up).norm()});
      if (depth > 0) near.distance = std::min(near.distance, -depth);
      if (near.distance < best.distance) best = near;
    };
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
      look(base + share * axis);
    for (const double end : {0.0, 1.0}) {
      for (int i = 0; i < 12; ++i) {
        const double angle = std::numbers::pi * i / 6;
        look(base + end * axis + radius * (std::cos(angle) * x + std::sin(angle) * y));
      }
    }
    return best;
  };
  const double length = (to - from).norm();
  const Vector3 direction = length > 0 ? Vector3((to - from) / length) : Vector3::Zero();
  const auto gap = [&](double travelled) { return closestOfCylinder(from + direction * travelled).distance; };
  const auto travelled = march(length, gap, 1e-4);
  if (!travelled) return std::nullopt;
  const Vector3 p = from + direction * *travelled;
  const ClosestPoint near = closestOfCylinder(p);
  return BallContact{length > 0 ? *travelled / length : 0.0, p, near.point, near.normal};
}

Bounds HalfSpace::bounds() const { return {Vector3::Constant(-farAway), Vector3::Constant(farAway)}; }

ClosestPoint HalfSpace::closest(const Vector3& point) const {
  const double distance = (point - plane_.point).dot(plane_.normal);
  return {distance, point - plane_.normal * distance, plane_.normal};
}

std::optional<BallContact> HalfSpace::firstContact(const Vector3& from, const Vector3& to, double radius) const {
  const double start = closest(from).distance - radius;
  const double end = closest(to).distance - radius;
  double fraction = 0;
  if (start >= -touchTolerance) {
    if (end >= -touchTolerance) return std::nullopt;
    fraction = std::clamp(start / (start - end), 0.0, 1.0);
  }
  const Vector3 centre = from + (to - from) * fraction;
  return BallContact{fraction, centre, closest(centre).point, plane_.normal};
}

ClosestPoint Box::closest(const Vector3& point) const {
  const Vector3 nearest = point.cwiseMax(minimum_).cwiseMin(maximum_);
  if (nearest != point) {
    const double distance = (point - nearest).norm();
    return {distance, nearest, (point - nearest) / distance};
  }
  Eigen::Index low = 0, high = 0;
  const double toLow = (point - minimum_).minCoeff(&low);
  const double toHigh = (maximum_ - point).minCoeff(&high);
  Vector3 normal = Vector3::Zero();
  if (toLow < toHigh) {
    normal[low] = -1;
    return {-toLow, point + normal * toLow, normal};
  }
  normal[high] = 1;
  return {-toHigh, point + normal * toHigh, normal};
}

Bounds SolidSphere::bounds() const {
  return {centre_ - Vector3::Constant(radius_), centre_ + Vector3::Constant(radius_)};
}

ClosestPoint SolidSphere::closest(const Vector3& point) const {
  const Vector3 normal = unitOr(point - centre_, Vector3::UnitZ());
  return {(point - centre_).norm() - radius_, centre_ + normal * radius_, normal};
}

Bounds EndlessBar::bounds() const {
  return {Vector3(centre_.x() - radius_, centre_.y() - radius_, -farAway),
          Vector3(centre_.x() + radius_, centre_.y() + radius_, farAway)};
}

ClosestPoint EndlessBar::closest(const Vector3& point) const {
  const Vector3 normal = radialDirection(point, centre_);
  const double distance = std::hypot(point.x() - centre_.x(), point.y() - centre_.y()) - radius_;
  return {distance, point - normal * distance, normal};
}

Bounds EndlessBore::bounds() const { return {Vector3::Constant(-farAway), Vector3::Constant(farAway)}; }

ClosestPoint EndlessBore::closest(const Vector3& point) const {
  const Vector3 normal = -radialDirection(point, centre_);
  const double distance = radius_ - std::hypot(point.x() - centre_.x(), point.y() - centre_.y());
  return {distance, point - normal * distance, normal};
}

Bounds RoundBar::bounds() const { return {Vector3(-radius_, -radius_, bottom_), Vector3(radius_, radius_, top_)}; }

ClosestPoint RoundBar::closest(const Vector3& point) const {
  return closestOfTurnedRectangle(point, Vector2(0, bottom_), Vector2(radius_, top_));
}

Bounds Ring::bounds() const {
  return {Vector3(-outerRadius_, -outerRadius_, bottom_), Vector3(outerRadius_, outerRadius_, 0)};
}

ClosestPoint Ring::closest(const Vector3& point) const {
  return closestOfTurnedRectangle(point, Vector2(holeRadius_, bottom_), Vector2(outerRadius_, 0));
}

}  // namespace probewright::simulation
