#include "simulation/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::simulation {
namespace {

/// Two triangles meet the ball at the same time on their common edge, each in a point of its own in the last digit. Of
/// these the one that is smaller in its first different coordinate counts, whichever triangle is looked at first.
bool keep(Meeting& best, double when, const Vector3& point, const Vector3& normal = Vector3::Zero()) {
  if (!(when <= best.when)) return false;
  if (when == best.when && !std::ranges::lexicographical_compare(point, best.point)) return false;
  best = {when, point, normal};
  return true;
}

double square(double value) { return value * value; }

/// The ball against the point, given that it does not overlap it at the start.
bool approachPoint(const Way& way, double radius, const Vector3& point, Meeting& best) {
  const Vector3 m = way.start - point;
  const double b = m.dot(way.direction);
  if (b >= 0 || -b - radius > best.when) return false;
  const double halfChordSquared = square(radius) - (m - b * way.direction).squaredNorm();
  if (halfChordSquared <= 2 * kTouchTolerance * radius) return false;
  const double when = std::max(0.0, -b - std::sqrt(halfChordSquared));
  if (when > best.when || when >= way.length) return false;
  if (way.length < -b && (m + way.length * way.direction).norm() >= radius - kTouchTolerance) return false;
  return keep(best, when, point);
}

/// The ball against the inside of the segment, given that it does not overlap the segment at the start.
bool approachSegment(const Way& way, double radius, const Vector3& a, const Vector3& edge, Meeting& best) {
  const double edgeSquared = edge.squaredNorm();
  if (edgeSquared <= 0) return false;
  const double inverse = 1 / edgeSquared;
  const Vector3 m = way.start - a;
  const double mAlong = m.dot(edge) * inverse;
  const double dAlong = way.direction.dot(edge) * inverse;
  const Vector3 mAcross = m - mAlong * edge;
  const Vector3 dAcross = way.direction - dAlong * edge;
  const double speedSquared = dAcross.squaredNorm();
  const double b = mAcross.dot(dAcross);
  if (b >= 0 || speedSquared < 1e-24) return false;
  // Inside the endless cylinder, but not near the segment: an end of the segment is met first.
  if (mAcross.squaredNorm() < square(radius - kTouchTolerance)) return false;
  const double nearest = -b / speedSquared;
  const double halfChordSquared = square(radius) - (mAcross + nearest * dAcross).squaredNorm();
  if (halfChordSquared <= 2 * kTouchTolerance * radius) return false;
  const double when = std::max(0.0, nearest - std::sqrt(halfChordSquared / speedSquared));
  if (when > best.when || when >= way.length) return false;
  const double along = mAlong + when * dAlong;
  if (along < 0 || along > 1) return false;
  if (way.length < nearest && (mAcross + way.length * dAcross).norm() >= radius - kTouchTolerance) return false;
  return keep(best, when, a + along * edge);
}

/// The triangle's plane as the ball sees it at the start of its way.
struct PlaneView {
  Vector3 normal = Vector3::Zero();  ///< zero for a triangle without area
  double height = 0;
};

PlaneView viewPlane(const Way& way, const Triangle& t) {
  const Vector3 scaled = (t[1] - t[0]).cross(t[2] - t[0]);
  const double squared = scaled.squaredNorm();
  if (squared <= 0) return {};
  const Vector3 normal = scaled / std::sqrt(squared);
  return {normal, normal.dot(way.start - t[0])};
}

/// The ball against the triangle, given that it does not overlap it at the start.
bool approachTriangle(const Way& way, double radius, const Triangle& t, const PlaneView& plane, Meeting& best) {
  const Vector3 e0 = t[1] - t[0];
  const Vector3 e1 = t[2] - t[1];
  const Vector3 e2 = t[0] - t[2];
  const double gap = std::abs(plane.height) - radius;
  if (gap >= -kTouchTolerance && !plane.normal.isZero()) {
    const double side = plane.height < 0 ? -1 : 1;
    const double approach = -side * plane.normal.dot(way.direction);
    if (gap - approach * way.length >= -kTouchTolerance || approach <= 0) return false;
    const double when = std::max(0.0, gap / approach);
    if (when > best.when) return false;
    const Vector3 foot = way.at(when) - side * radius * plane.normal;
    // From here on the ball cuts a growing disc out of the plane. It can meet an edge first only while its middle is
    // outside that edge, at the beginning or by the end.
    const double rest = std::min({best.when, way.length, when + 2 * radius / approach}) - when;
    const std::array<Vector3, 3> inward{plane.normal.cross(e0), plane.normal.cross(e1), plane.normal.cross(e2)};
    std::array<bool, 3> outside{};
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const double now = inward[i].dot(foot - t[i]);
      inside = inside && now >= 0;
      outside[i] = now < 0 || now + rest * inward[i].dot(way.direction) < 0;
    }
    if (inside) return keep(best, when, foot, plane.normal);
    bool met = false;
    if (outside[0]) met |= approachSegment(way, radius, t[0], e0, best);
    if (outside[1]) met |= approachSegment(way, radius, t[1], e1, best);
    if (outside[2]) met |= approachSegment(way, radius, t[2], e2, best);
    if (outside[0] || outside[2]) met |= approachPoint(way, radius, t[0], best);
    if (outside[0] || outside[1]) met |= approachPoint(way, radius, t[1], best);
    if (outside[1] || outside[2]) met |= approachPoint(way, radius, t[2], best);
    return met;
  }
  bool met = approachSegment(way, radius, t[0], e0, best);
  met |= approachSegment(way, radius, t[1], e1, best);
  met |= approachSegment(way, radius, t[2], e2, best);
  for (const Vector3& corner : t)
    met |= approachPoint(way, radius, corner, best);
  return met;
}

bool approachTriangle(const Way& way, double radius, const Triangle& t, Meeting& best) {
  return approachTriangle(way, radius, t, viewPlane(way, t), best);
}

/// The nearest points of the segments p..p+u and q..q+v.
std::pair<Vector3, Vector3> closestOnSegments(const Vector3& p, const Vector3& u, const Vector3& q, const Vector3& v) {
  const Vector3 w = p - q;
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double wu = w.dot(u);
  const double wv = w.dot(v);
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 1e-15 * uu * vv ? std::clamp((uv * wv - vv * wu) / determinant, 0.0, 1.0) : 0.0;
  double r = vv > 0 ? std::clamp((uv * s + wv) / vv, 0.0, 1.0) : 0.0;
  s = uu > 0 ? std::clamp((uv * r - wu) / uu, 0.0, 1.0) : 0.0;
  return {p + s * u, q + r * v};
}

struct Nearest {
  double distance = 1e300;
  Vector3 onTriangle = Vector3::Zero();
};

Nearest nearestToSegment(const Vector3& p, const Vector3& axis, const Triangle& t) {
  Nearest nearest;
  const auto consider = [&](const Vector3& onSegment, const Vector3& onTriangle) {
    const double distance = (onSegment - onTriangle).norm();
    if (distance < nearest.distance) nearest = {distance, onTriangle};
  };
  consider(p, closestOnTriangle(p, t));
  consider(p + axis, closestOnTriangle(p + axis, t));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [a, b] = closestOnSegments(p, axis, t[i], t[(i + 1) % 3] - t[i]);
    consider(a, b);
  }
  const Vector3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double slope = normal.dot(axis);
  if (slope != 0) {
    const double s = normal.dot(t[0] - p) / slope;
    if (s >= 0 && s <= 1) {
      const Vector3 onSegment = p + s * axis;
      consider(onSegment, closestOnTriangle(onSegment, t));
    }
  }
  return nearest;
}

}  // namespace

Way wayBetween(const Vector3& from, const Vector3& to) {
  Way way{from, to - from, 0};
  way.length = way.direction.norm();
  way.direction = way.length > 0 ? Vector3(way.direction / way.length) : Vector3::UnitZ();
  return way;
}

Vector3 closestOnSegment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 edge = b - a;
  const double squared = edge.squaredNorm();
  if (squared <= 0) return a;
  return a + std::clamp((p - a).dot(edge) / squared, 0.0, 1.0) * edge;
}

Vector3 closestOnTriangle(const Vector3& p, const Triangle& t) {
  const Vector3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double squared = normal.squaredNorm();
  if (squared > 0) {
    const Vector3 foot = p - normal.dot(p - t[0]) / squared * normal;
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      inside = inside && normal.dot((t[(i + 1) % 3] - t[i]).cross(foot - t[i])) >= 0;
    }
    if (inside) return foot;
  }
  Vector3 closest = closestOnSegment(p, t[0], t[1]);
  for (const Vector3& other : {closestOnSegment(p, t[1], t[2]), closestOnSegment(p, t[2], t[0])}) {
    if ((other - p).squaredNorm() < (closest - p).squaredNorm()) closest = other;
  }
  return closest;
}

bool sweepPoint(const Way& way, double radius, const Vector3& point, Meeting& best) {
  const double gap = (way.start - point).norm() - radius;
  if (gap < -kTouchTolerance) return keep(best, gap, point);
  return approachPoint(way, radius, point, best);
}

bool sweepSegment(const Way& way, double radius, const Vector3& a, const Vector3& b, Meeting& best) {
  const Vector3 closest = closestOnSegment(way.start, a, b);
  const double gap = (way.start - closest).norm() - radius;
  if (gap < -kTouchTolerance) return keep(best, gap, closest);
  bool met = approachSegment(way, radius, a, b - a, best);
  met |= approachPoint(way, radius, a, best);
  met |= approachPoint(way, radius, b, best);
  return met;
}

bool sweepTriangle(const Way& way, double radius, const Triangle& t, Meeting& best) {
  const PlaneView plane = viewPlane(way, t);
  if (std::abs(plane.height) < radius) {
    const Vector3 closest = closestOnTriangle(way.start, t);
    const Vector3 arm = way.start - closest;
    const double distance = arm.norm();
    if (distance - radius < -kTouchTolerance) {
      const bool onFace = std::abs(plane.normal.dot(arm)) > (1 - 1e-12) * distance;
      return keep(best, distance - radius, closest, onFace ? plane.normal : Vector3::Zero());
    }
    if (distance - radius > best.when || distance - radius >= way.length) return false;
  }
  return approachTriangle(way, radius, t, plane, best);
}

bool sweepCapsule(const Way& way, double radius, const Vector3& axis, const Triangle& t, Meeting& best) {
  const Nearest atStart = nearestToSegment(way.start, axis, t);
  const double gap = atStart.distance - radius;
  if (gap < -kTouchTolerance) return keep(best, gap, atStart.onTriangle);
  if (gap > best.when || gap >= way.length) return false;
  // The end p meets the triangle swept backwards along the axis: a prism.
  const Triangle far{t[0] - axis, t[1] - axis, t[2] - axis};
  Meeting meeting{best.when, Vector3::Constant(1e300), {}};  // another at the same time counts
  bool met = approachTriangle(way, radius, t, meeting);
  met |= approachTriangle(way, radius, far, meeting);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    met |= approachTriangle(way, radius, {t[i], t[j], far[j]}, meeting);
    met |= approachTriangle(way, radius, {t[i], far[j], far[i]}, meeting);
  }
  if (!met) return false;
  return keep(best, meeting.when, nearestToSegment(way.at(meeting.when), axis, t).onTriangle);
}

}  // namespace probewright::simulation
