#include "execution/sinumerik/radius_compensation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "control/alarm.hpp"

namespace probewright::execution::sinumerik {

namespace {

Vector3 direction(const Vector3& vector) {
  const double length = vector.norm();
  return length > 1e-12 ? Vector3(vector / length) : Vector3::Zero();
}

}  // namespace

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
  const std::vector<Vector3> points = intersections(first, second, plane_);
  if (points.empty()) return std::nullopt;
  Vector3 nearest = *std::ranges::min_element(points, {}, [&](const Vector3& p) { return (p - corner).squaredNorm(); });
  nearest[plane_.tool] = corner[plane_.tool];
  return nearest;
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

}  // namespace probewright::execution::sinumerik
