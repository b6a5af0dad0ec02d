#include "execution/sinumerik/path_element.hpp"

#include <cmath>

#include "execution/motion/plane_curve.hpp"

namespace probewright::execution::sinumerik {

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
  const auto curve = [&](const PathElement& element) {
    const Vector2 start = flat(element.start);
    if (!element.isArc) return motion::PlaneCurve::line(start, (flat(element.end) - start).normalized());
    const Vector2 centre = flat(element.centre);
    return motion::PlaneCurve::circleAbout(centre, (start - centre).norm());
  };
  std::vector<Vector3> points;
  for (const Vector2& point : motion::intersections(curve(first), curve(second))) {
    Vector3 found = first.end;
    found[plane.main] = point.x();
    found[plane.minor] = point.y();
    points.push_back(found);
  }
  return points;
}

}  // namespace probewright::execution::sinumerik
