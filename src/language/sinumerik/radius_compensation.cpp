#include "language/sinumerik/radius_compensation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "control/alarm.hpp"

namespace probewright::sinumerik {

namespace {

constexpr double tangential = 1e-6;  ///< sine of the angle below which a corner counts as none

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

void RadiusCompensator::begin(int side, double radius, const control::WorkingPlane& plane, bool cornerArc) {
  side_ = side;
  radius_ = radius;
  plane_ = plane;
  axis_ = Vector3::Unit(plane.tool);
  cornerArc_ = cornerArc;
  approaching_ = true;
  leaving_ = false;
  held_.reset();
  positionKnown_ = false;
}

void RadiusCompensator::end() { leaving_ = true; }

/// From the contour to the tool centre, square to the direction of travel.
Vector3 RadiusCompensator::normal(const Vector3& travel) const {
  const Vector3 flat = travel - travel.dot(axis_) * axis_;
  return axis_.cross(direction(flat)) * (side_ * radius_);
}

PathElement RadiusCompensator::offset(const PathElement& element) const {
  PathElement moved = element;
  moved.start += normal(element.startDirection());
  moved.end += normal(element.endDirection());
  if (element.isArc) {
    const Vector3 before = element.start - element.centre;
    if (before.dot(moved.start - element.centre) <= 0)
      throw control::Alarm("10753", "the tool radius is larger than the radius of this arc",
                           "use a smaller tool or a larger arc");
  }
  return moved;
}

void RadiusCompensator::putOut(PathElement element, const Vector3& end) {
  if (positionKnown_) element.start = position_;
  element.end = end;
  if (element.isArc) {
    const Vector3 a = element.start - element.centre, b = end - element.centre;
    const double angle = std::atan2(axis_.dot(a.cross(b)), a.dot(b) - a.dot(axis_) * b.dot(axis_));
    const double circle = 2 * std::numbers::pi;
    // Cutting a corner shortens or lengthens the arc a little; it keeps its sense and its number of turns.
    element.sweep = angle + circle * std::round((element.sweep - angle) / circle);
  }
  output_(element);
  position_ = end;
  positionKnown_ = true;
}

std::optional<Vector3> RadiusCompensator::intersection(const PathElement& first, const PathElement& second,
                                                       const Vector3& corner) const {
  const auto flat = [this](const Vector3& p) { return Vector2(p[plane_.main], p[plane_.minor]); };
  const auto nearest = [&](std::vector<Vector2> points) -> std::optional<Vector3> {
    if (points.empty()) return std::nullopt;
    const Vector2 wanted = flat(corner);
    const Vector2 best = *std::min_element(points.begin(), points.end(), [&](const Vector2& a, const Vector2& b) {
      return (a - wanted).squaredNorm() < (b - wanted).squaredNorm();
    });
    Vector3 point = corner;
    point[plane_.main] = best.x();
    point[plane_.minor] = best.y();
    return point;
  };
  const auto cross = [](const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); };
  const auto lineCircle = [&](const PathElement& line, const PathElement& arc) {
    const Vector2 p = flat(line.start), d = (flat(line.end) - p).normalized(), c = flat(arc.centre);
    const double radius = (flat(arc.start) - c).norm();
    const double along = d.dot(c - p), across = cross(d, c - p);
    std::vector<Vector2> points;
    if (std::abs(across) > radius) return points;
    const double half = std::sqrt(radius * radius - across * across);
    points.push_back(p + (along - half) * d);
    points.push_back(p + (along + half) * d);
    return points;
  };
  if (!first.isArc && !second.isArc) {
    const Vector2 p = flat(first.start), d = flat(first.end) - p, q = flat(second.start), e = flat(second.end) - q;
    const double denominator = cross(d, e);
    if (std::abs(denominator) < 1e-12) return std::nullopt;
    return nearest({p + cross(q - p, e) / denominator * d});
  }
  if (!first.isArc) return nearest(lineCircle(first, second));
  if (!second.isArc) return nearest(lineCircle(second, first));
  const Vector2 a = flat(first.centre), b = flat(second.centre);
  const double ra = (flat(first.start) - a).norm(), rb = (flat(second.start) - b).norm(), distance = (b - a).norm();
  if (distance < 1e-12 || distance > ra + rb || distance < std::abs(ra - rb)) return std::nullopt;
  const double along = (distance * distance + ra * ra - rb * rb) / (2 * distance);
  const double half = std::sqrt(std::max(0.0, ra * ra - along * along));
  const Vector2 d = (b - a) / distance, n(-d.y(), d.x());
  return nearest({a + along * d + half * n, a + along * d - half * n});
}

void RadiusCompensator::add(const PathElement& element) {
  if (leaving_) {
    flush();
    side_ = 0;
    PathElement away = element;
    away.isArc = false;
    putOut(away, element.end);
    return;
  }
  const Vector3 out = element.startDirection();
  if (normal(out).isZero()) {  // along the tool axis: the contour stands still
    flush();
    const Vector3 from = positionKnown_ ? position_ : element.start;
    putOut(element, from + (element.end - element.start));
    return;
  }
  if (!held_) {
    if (approaching_ && element.isArc)
      throw control::Alarm("10750", "tool radius compensation cannot begin with an arc", "begin with G0 or G1");
    if (approaching_ && !positionKnown_) position_ = element.start;
    positionKnown_ = true;
    const Vector3 begin = approaching_ ? position_ : offset(element).start;
    if ((begin - position_).norm() > 1e-9) {
      PathElement connection;
      connection.feed = element.feed;
      putOut(connection, begin);
    }
    held_ = element;
    return;
  }
  const Vector3 in = held_->endDirection();
  const Vector3 corner = held_->end;
  if (approaching_) {
    putOut(*held_, corner + normal(out));
    approaching_ = false;
  } else {
    const PathElement first = offset(*held_), second = offset(element);
    const double turn = axis_.dot(in.cross(out));
    const bool straight = std::abs(turn) < tangential && in.dot(out) > 0;
    const bool outside = !straight && turn * side_ < 0;
    std::optional<Vector3> cut;
    if (!straight && (!outside || !cornerArc_)) cut = intersection(first, second, first.end);
    // Nearly reversing outer corners would be cut far away.
    if (cut && outside && (*cut - corner).norm() > 3 * radius_) cut.reset();
    if (cut) {
      putOut(first, *cut);
    } else if (straight) {
      putOut(first, first.end);
    } else if (outside) {
      putOut(first, first.end);
      PathElement round;
      round.isArc = true;
      round.centre = corner;
      round.axis = axis_;
      round.sweep = std::atan2(turn, in.dot(out));
      round.feed = element.feed;
      round.start = first.end;
      putOut(round, second.start);
    } else {
      throw control::Alarm("10753", "the tool radius is too large for this inner corner", "use a smaller tool");
    }
  }
  held_ = element;
}

void RadiusCompensator::flush() {
  if (!held_) return;
  const PathElement element = *held_;
  held_.reset();
  if (approaching_) {
    putOut(element, element.end + normal(element.endDirection()));
    approaching_ = false;
  } else {
    putOut(offset(element), element.end + normal(element.endDirection()));
  }
}

}  // namespace probewright::sinumerik
