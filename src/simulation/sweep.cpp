#include "simulation/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::simulation {
namespace {

bool keep(Meeting& best, double when, const Vector3& point, const Vector3& normal = Vector3::Zero()) {
  if (!(when < best.when)) return false;
  best = {when, point, normal};
  return true;
}

double square(double value) { return value * value; }

/// The ball against the point, given that it does not overlap it at the start.
bool approachPoint(const Way& way, double radius, const Vector3& point, Meeting& best) {
  const Vector3 m = way.start - point;
  const double b = m.dot(way.direction);
  if (b >= 0 || -b - radius >= best.when) return false;
  const double halfChordSquared = square(radius) - (m - b * way.direction).squaredNorm();
  if (halfChordSquared <= 2 * kTouchTolerance * radius) return false;
  const double when = std::max(0.0, -b - std::sqrt(halfChordSquared));
  if (when >= std::min(best.when, way.length)) return false;
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
  if (when >= std::min(best.when, way.length)) return false;
  const double along = mAlong + when * dAlong;
  if (along < 0 || along > 1) return false;
  if (way.length < nearest && (mAcross + way.length * dAcross).norm() >= radius - kTouchTolerance) return false;
  return keep(best, when, a + along * edge);
}

/// The ball against the triangle, given that it does not overlap it at the start.
bool approachTriangle(const Way& way, double radius, const Triangle& t, Meeting& best) {
  const Vector3 e0 = t[1] - t[0];
  const Vector3 e1 = t[2] - t[1];
  const Vector3 e2 = t[0] - t[2];
  const Vector3 scaledNormal = e0.cross(e1);
  const double scale = scaledNormal.norm();
  if (scale > 0) {
    const Vector3 normal = scaledNormal / scale;
    const double height = normal.dot(way.start - t[0]);
    const double side = height < 0 ? -1 : 1;
    const double gap = std::abs(height) - radius;
    if (gap >= -kTouchTolerance) {
      const double approach = -side * normal.dot(way.direction);
      if (gap - approach * way.length >= -kTouchTolerance || approach <= 0) return false;
      const double when = std::max(0.0, gap / approach);
      if (when >= best.when) return false;
      const Vector3 foot = way.at(when) - side * radius * normal;
      const bool inside = normal.dot(e0.cross(foot - t[0])) >= 0 && normal.dot(e1.cross(foot - t[1])) >= 0 &&
                          normal.dot(e2.cross(foot - t[2])) >= 0;
      if (inside) return keep(best, when, foot, normal);
    }
  }
  bool met = approachSegment(way, radius, t[0], e0, best);
  met |= approachSegment(way, radius, t[1], e1, best);
  met |= approachSegment(way, radius, t[2], e2, best);
  for (const Vector3& corner : t)
    met |= approachPoint(way, radius, corner, best);
  return met;
}

Vector3 unitNormal(const Triangle& t) {
  const Vector3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double length = n.norm();
  return length > 0 ? Vector3(n / length) : Vector3::Zero();
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
  // A sphere about the triangle decides most cases: no overlap at the start unless it is reached there.
  const Vector3 middle = (t[0] + t[1] + t[2]) * (1.0 / 3);
  const double reach = std::sqrt(
      std::max({(t[0] - middle).squaredNorm(), (t[1] - middle).squaredNorm(), (t[2] - middle).squaredNorm()}));
  const Vector3 m = way.start - middle;
  const double both = radius + reach;
  const double distanceSquared = m.squaredNorm();
  if (distanceSquared < square(both)) {
    const Vector3 closest = closestOnTriangle(way.start, t);
    const double gap = (way.start - closest).norm() - radius;
    if (gap < -kTouchTolerance) {
      const Vector3 normal = unitNormal(t);
      const Vector3 arm = way.start - closest;
      const bool onFace = std::abs(normal.dot(arm)) > (1 - 1e-12) * arm.norm();
      return keep(best, gap, closest, onFace ? normal : Vector3::Zero());
    }
  } else {
    const double b = m.dot(way.direction);
    if (b >= 0) return false;
    const double halfChordSquared = square(both) - (m - b * way.direction).squaredNorm();
    if (halfChordSquared <= 0) return false;
    if (-b - std::sqrt(halfChordSquared) >= std::min(best.when, way.length)) return false;
  }
  return approachTriangle(way, radius, t, best);
}

bool sweepCapsule(const Way& way, double radius, const Vector3& axis, const Triangle& t, Meeting& best) {
  const Nearest atStart = nearestToSegment(way.start, axis, t);
  const double gap = atStart.distance - radius;
  if (gap < -kTouchTolerance) return keep(best, gap, atStart.onTriangle);
  if (gap >= std::min(best.when, way.length)) return false;
  // The end p meets the triangle swept backwards along the axis: a prism.
  const Triangle far{t[0] - axis, t[1] - axis, t[2] - axis};
  Meeting meeting{best.when, {}, {}};
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
