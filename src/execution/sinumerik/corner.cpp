#include "execution/sinumerik/corner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace probewright::execution::sinumerik {

namespace {

constexpr double circle = 2 * std::numbers::pi;
constexpr int halvings = 60;  ///< of an interval: down to the last bit
constexpr double smallest = 1e-6;

/// Where the first element ends, where the second begins (fractions of their ways), and what lies between.
struct Transition {
  double first = 1, second = 0;
  PathElement inserted;
};

double lengthOf(const PathElement& element) {
  if (!element.isArc) return (element.end - element.start).norm();
  return (element.start - element.centre).norm() * std::abs(element.sweep);
}

bool liesInPlane(const PathElement& element, const control::WorkingPlane& plane) {
  const bool level = std::abs(element.end[plane.tool] - element.start[plane.tool]) < 1e-9;
  return level && (!element.isArc || std::abs(element.axis[plane.tool]) > 1 - 1e-9);
}

/// `element` moved to its left by `distance`. Nothing if an arc has no room for that.
std::optional<PathElement> parallel(const PathElement& element, const Vector3& axis, double distance) {
  PathElement moved = element;
  moved.start += distance * axis.cross(element.startDirection());
  moved.end += distance * axis.cross(element.endDirection());
  if (!element.isArc) return moved;
  const double turning = element.sweep * element.axis.dot(axis) > 0 ? 1 : -1;
  const double radius = (element.start - element.centre).norm() - turning * distance;
  return radius > smallest ? std::optional(moved) : std::nullopt;
}

/// The point of the element's line or circle that is nearest to `centre`, as a fraction of its way. `turn`: which
/// of the turns of an arc counts.
enum class Turn { First, Last };
double footOn(const PathElement& element, const Vector3& centre, Turn turn) {
  if (!element.isArc) {
    const Vector3 along = element.end - element.start;
    return (centre - element.start).dot(along) / along.squaredNorm();
  }
  const Vector3 a = element.start - element.centre, b = centre - element.centre;
  const double sense = element.sweep < 0 ? -1 : 1, whole = std::abs(element.sweep);
  double angle = sense * std::atan2(element.axis.dot(a.cross(b)), a.dot(b) - a.dot(element.axis) * b.dot(element.axis));
  if (turn == Turn::Last) {
    angle += circle * std::floor((whole - angle) / circle + 1e-9);
  } else {
    angle -= circle * std::floor(angle / circle + 1e-9);
  }
  return angle / whole;
}

std::optional<Transition> rounded(const PathElement& first, const PathElement& second, double radius,
                                  const control::WorkingPlane& plane) {
  const Vector3 axis = Vector3::Unit(plane.tool);
  const double side = axis.dot(first.endDirection().cross(second.startDirection())) > 0 ? 1 : -1;
  const auto a = parallel(first, axis, side * radius), b = parallel(second, axis, side * radius);
  if (!a || !b) return std::nullopt;
  std::optional<Transition> best;
  double nearest = 0;
  for (Vector3 centre : intersections(*a, *b, plane)) {
    centre[plane.tool] = first.end[plane.tool];
    Transition found;
    found.first = footOn(first, centre, Turn::Last);
    found.second = footOn(second, centre, Turn::First);
    if (!(found.first >= -1e-12 && found.first <= 1 + 1e-9 && found.second >= -1e-9 && found.second <= 1 + 1e-12))
      continue;
    const double distance = (centre - first.end).norm();
    if (best && distance >= nearest) continue;
    nearest = distance;
    PathElement& arc = found.inserted;
    arc.isArc = true;
    arc.axis = axis;
    arc.centre = centre;
    arc.start = first.at(found.first);
    arc.end = second.at(found.second);
    const Vector3 from = arc.start - centre, to = arc.end - centre;
    arc.sweep = std::atan2(axis.dot(from.cross(to)), from.dot(to));
    if (arc.sweep * side < 0) arc.sweep += side * circle;
    best = found;
  }
  return best;
}

/// The fraction of an element's way that lies beyond the distance `width` (as the crow flies) from one of its ends.
double fractionFor(const PathElement& element, double width) {
  if (!element.isArc) return width / (element.end - element.start).norm();
  const double radius = (element.start - element.centre).norm();
  return 2 * std::asin(std::min(1.0, width / (2 * radius))) / std::abs(element.sweep);
}

/// The largest width of a chamfer that an element has room for.
double roomOn(const PathElement& element) {
  if (!element.isArc) return (element.end - element.start).norm();
  const double radius = (element.start - element.centre).norm();
  return 2 * radius * std::sin(std::min(std::abs(element.sweep), std::numbers::pi) / 2);
}

Transition chamfered(const PathElement& first, const PathElement& second, double width) {
  Transition found;
  found.first = 1 - fractionFor(first, width);
  found.second = fractionFor(second, width);
  found.inserted.start = first.at(found.first);
  found.inserted.end = second.at(found.second);
  return found;
}

/// The largest value of [0, upTo] for which `fits`; it fits at 0 and up to some value.
template <class Fits>
double largest(double upTo, const Fits& fits) {
  if (fits(upTo)) return upTo;
  double low = 0, high = upTo;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

std::optional<Transition> transition(const PathElement& first, const PathElement& second, const Corner& corner,
                                     const control::WorkingPlane& plane) {
  if (!liesInPlane(first, plane) || !liesInPlane(second, plane) || corner.size < smallest) return std::nullopt;
  const Vector3 in = first.endDirection(), out = second.startDirection();
  if (in.isZero() || out.isZero() || in.cross(out).norm() < tangential) return std::nullopt;
  if (corner.kind == Corner::Kind::Rounding) {
    const double radius =
        largest(corner.size, [&](double r) { return r == 0 || rounded(first, second, r, plane).has_value(); });
    return radius < smallest ? std::nullopt : rounded(first, second, radius, plane);
  }
  const double room = std::min(roomOn(first), roomOn(second));
  double width = std::min(room, corner.size);
  if (corner.kind == Corner::Kind::ChamferLength) {
    width = largest(room, [&](double each) {
      const PathElement line = chamfered(first, second, each).inserted;
      return (line.end - line.start).norm() <= corner.size;
    });
  }
  return width < smallest ? std::nullopt : std::optional(chamfered(first, second, width));
}

}  // namespace

void CornerMaker::add(const PathElement& element, const std::optional<Corner>& corner,
                      const control::WorkingPlane& plane) {
  PathElement next = element;
  if (held_) {
    if (lengthOf(element) < 1e-9) return;
    const PathElement before = *held_;
    held_.reset();
    if (auto found = transition(before, next, corner_, plane)) {
      if (found->first > 1e-12) output_(before.between(0, found->first));
      found->inserted.feed = next.feed.rapid ? next.feed : corner_.feed.value_or(next.feed);
      output_(found->inserted);
      next = next.between(found->second, 1);
    } else {
      output_(before);
    }
  }
  if (!corner) return output_(next);
  held_ = next;
  corner_ = *corner;
}

void CornerMaker::flush() {
  if (!held_) return;
  const PathElement element = *held_;
  held_.reset();
  output_(element);
}

}  // namespace probewright::execution::sinumerik
