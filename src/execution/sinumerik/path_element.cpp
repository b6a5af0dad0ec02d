#include "execution/sinumerik/path_element.hpp"

#include <cmath>

namespace probewright::sinumerik {

namespace {

Vector3 direction(const Vector3& vector) {
  const double length = vector.norm();
  return length > 1e-12 ? Vector3(vector / length) : Vector3::Zero();
}

Vector3 turned(const Vector3& vector, const Vector3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis) * vector;
}

}  // namespace

Vector3 PathElement::startDirection() const {
  if (!isArc) return direction(end - start);
  return direction(axis.cross(start - centre) * (sweep < 0 ? -1 : 1));
}

Vector3 PathElement::endDirection() const {
  if (!isArc) return direction(end - start);
  return turned(startDirection(), axis, sweep);
}

Vector3 PathElement::at(double fraction) const {
  if (!isArc) return start + fraction * (end - start);
  const Vector3 arm = start - centre;
  const Vector3 flat = arm - arm.dot(axis) * axis;
  const double rise = (end - start).dot(axis);
  // The radius goes over from that of the start to that of the end, so that both are met exactly.
  const Vector3 endArm = end - centre;
  const double growth = flat.norm() > 0 ? (endArm - endArm.dot(axis) * axis).norm() / flat.norm() : 1;
  return centre + turned(flat, axis, fraction * sweep) * (1 + fraction * (growth - 1)) +
         (arm.dot(axis) + fraction * rise) * axis;
}

PathElement PathElement::between(double first, double last) const {
  PathElement part = *this;
  if (first > 0) part.start = at(first);
  if (last < 1) part.end = at(last);
  part.sweep = sweep * (last - first);
  return part;
}

std::vector<Vector3> intersections(const PathElement& first, const PathElement& second,
                                   const control::WorkingPlane& plane) {
  const auto flat = [&](const Vector3& p) { return Vector2(p[plane.main], p[plane.minor]); };
  const auto cross = [](const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); };
  std::vector<Vector3> points;
  const auto keep = [&](const Vector2& point) {
    Vector3 found = first.end;
    found[plane.main] = point.x();
    found[plane.minor] = point.y();
    points.push_back(found);
  };
  const auto lineCircle = [&](const PathElement& line, const PathElement& arc) {
    const Vector2 p = flat(line.start), d = (flat(line.end) - p).normalized(), c = flat(arc.centre);
    const double radius = (flat(arc.start) - c).norm();
    const double along = d.dot(c - p), across = cross(d, c - p);
    if (std::abs(across) > radius) return;
    const double half = std::sqrt(radius * radius - across * across);
    keep(p + (along - half) * d);
    keep(p + (along + half) * d);
  };
  if (!first.isArc && !second.isArc) {
    const Vector2 p = flat(first.start), d = flat(first.end) - p, q = flat(second.start), e = flat(second.end) - q;
    const double denominator = cross(d, e);
    if (std::abs(denominator) >= 1e-12) keep(p + cross(q - p, e) / denominator * d);
  } else if (!first.isArc) {
    lineCircle(first, second);
  } else if (!second.isArc) {
    lineCircle(second, first);
  } else {
    const Vector2 a = flat(first.centre), b = flat(second.centre);
    const double ra = (flat(first.start) - a).norm(), rb = (flat(second.start) - b).norm(), distance = (b - a).norm();
    if (distance < 1e-12 || distance > ra + rb || distance < std::abs(ra - rb)) return points;
    const double along = (distance * distance + ra * ra - rb * rb) / (2 * distance);
    const double half = std::sqrt(std::max(0.0, ra * ra - along * along));
    const Vector2 d = (b - a) / distance, n(-d.y(), d.x());
    keep(a + along * d + half * n);
    keep(a + along * d - half * n);
  }
  return points;
}

}  // namespace probewright::sinumerik
