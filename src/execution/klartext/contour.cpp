#include "execution/klartext/contour.hpp"

#include <cmath>
#include <numbers>

#include "control/alarm.hpp"
#include "execution/motion/plane_curve.hpp"
#include "language/klartext/heidenhain_program.hpp"

namespace probewright::execution::klartext {

using control::Alarm;
using control::Feed;
using motion::cross;
using motion::left;
using motion::PlaneCurve;
using motion::turned;

namespace {

constexpr double tangentTolerance = 1e-9;
constexpr double lengthTolerance = 1e-9;

double angleOf(const Vector2& v) { return std::atan2(v.y(), v.x()); }
double normalized(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }
double sign(Side side) { return static_cast<double>(static_cast<int>(side)); }

Vector2 unit(const Vector2& v) {
  const double length = v.norm();
  return length < lengthTolerance ? Vector2(Vector2::Zero()) : Vector2(v / length);
}

/// The curve beside an element.
PlaneCurve beside(const Element& element, double distanceToLeft) {
  if (!element.arc) {
    const Vector2 direction = element.startDirection();
    return PlaneCurve::line(element.from + distanceToLeft * left(direction), direction);
  }
  const double radius = element.radius() - (element.sweep > 0 ? distanceToLeft : -distanceToLeft);
  if (radius < -lengthTolerance) {
    throw Alarm("Tool radius too large", "The tool radius is larger than the inside radius of the contour",
                "use a smaller tool or a larger radius");
  }
  return PlaneCurve::circleAbout(element.centre, std::max(radius, 0.0));
}

/// The intersection nearest to `place`, or nothing. Curves that touch but for rounding cross.
std::optional<Vector2> intersection(const PlaneCurve& a, const PlaneCurve& b, const Vector2& place) {
  constexpr double slack = 1e-6;
  return motion::nearest(motion::intersections(a, b, slack), place);
}

/// The element from `from` to `to` on the same line or circle.
Element shortened(Element element, const Vector2& from, const Vector2& to) {
  if (element.arc) {
    const double start = normalized(angleOf(from - element.centre) - angleOf(element.from - element.centre));
    const double end = normalized(angleOf(to - element.centre) - angleOf(element.to - element.centre));
    element.sweep += end - start;
  }
  element.from = from;
  element.to = to;
  return element;
}

Vector2 footOn(const Element& element, const Vector2& point) {
  if (element.arc) return element.centre + unit(point - element.centre) * element.radius();
  const Vector2 direction = element.startDirection();
  return element.from + direction * direction.dot(point - element.from);
}

/// True if the point on the element's line or circle lies within the element.
bool within(const Element& element, const Vector2& point) {
  if (!element.arc) {
    const double along = element.startDirection().dot(point - element.from);
    return along > -1e-6 && along < (element.to - element.from).norm() + 1e-6;
  }
  const double turn = std::abs(shortened(element, element.from, point).sweep);
  return turn < std::abs(element.sweep) + 1e-6;
}

}  // namespace

Vector2 Element::startDirection() const {
  if (!arc) return unit(to - from);
  return (sweep > 0 ? 1.0 : -1.0) * left(unit(from - centre));
}

Vector2 Element::endDirection() const {
  if (!arc) return unit(to - from);
  return (sweep > 0 ? 1.0 : -1.0) * left(unit(to - centre));
}

Element tangentialArc(const Vector2& from, const Vector2& direction, const Vector2& to) {
  Element element;
  element.from = from;
  element.to = to;
  const Vector2 chord = to - from;
  const double aside = left(direction).dot(chord);
  if (std::abs(aside) < lengthTolerance) return element;
  element.arc = true;
  element.centre = from + left(direction) * (chord.squaredNorm() / (2 * aside));
  element.sweep = 2 * std::atan2(aside, direction.dot(chord));
  return element;
}

/// Alarms of `work` name the block of the element that was under way.
template <class Work>
void Contour::located(Work work) {
  try {
    work();
  } catch (Alarm& alarm) {
    if (!alarm.place() && current_.program != nullptr) {
      alarm.setPlace({current_.program->file(), current_.position.line, current_.position.offset});
    }
    throw;
  }
}

void Contour::add(const Element& element, bool waits) {
  located([&] { addLocated(element, waits); });
}

void Contour::flush() {
  located([&] { flushLocated(); });
}

void Contour::depart(const Approach& departure) {
  located([&] { departLocated(departure); });
}

void Contour::addLocated(const Element& element, bool waits) {
  current_ = element.block;
  Element added = element;
  end_ = element.to;
  endHeight_ = element.heightTo;
  const Vector2 direction = element.endDirection();
  if (!direction.isZero(0)) direction_ = direction;
  if (last_) {
    Element first = *last_;
    last_.reset();
    std::optional<Element> corner;
    if (corner_) corner = cut(first, added, *corner_);
    corner_.reset();
    compensate(first);
    if (corner) compensate(*corner);
  }
  corner_.reset();
  last_ = added;
  if (waits) return;
  last_.reset();
  compensate(added);
}

void Contour::round(double radius, std::optional<Feed> feed, const BlockPlace& block) {
  if (last_) corner_ = Corner{.size = radius, .rounding = true, .feed = feed, .block = block};
}

void Contour::chamfer(double length, std::optional<Feed> feed, const BlockPlace& block) {
  if (last_) corner_ = Corner{.size = length, .rounding = false, .feed = feed, .block = block};
}

std::optional<Element> Contour::cut(Element& first, Element& second, const Corner& corner) {
  current_ = corner.block;
  const Vector2 in = first.endDirection();
  const Vector2 out = second.startDirection();
  const double turn = cross(in, out);
  if (corner.size <= 0 || std::abs(turn) < tangentTolerance) return std::nullopt;
  Element between;
  between.block = corner.block;
  between.side = first.side;
  between.feed = corner.feed.value_or(first.feed);
  between.heightFrom = between.heightTo = first.heightTo;
  const Vector2 vertex = first.to;
  if (corner.rounding) {
    const double side = turn > 0 ? 1 : -1;
    const std::optional<Vector2> centre =
        intersection(beside(first, side * corner.size), beside(second, side * corner.size), vertex);
    if (!centre) throw Alarm("Rounding radius too large", "The rounding RND does not fit between its two elements");
    between.arc = true;
    between.centre = *centre;
    between.from = footOn(first, *centre);
    between.to = footOn(second, *centre);
    // Beside an arc the tangents at the ends differ from those at the vertex.
    const Vector2 begin = between.from - *centre, end = between.to - *centre;
    between.sweep = std::atan2(cross(begin, end), begin.dot(end));
    if (between.sweep * side < 0) between.sweep += side * 2 * std::numbers::pi;
  } else {
    if (first.arc || second.arc) {
      throw Alarm("Chamfer not permitted", "A chamfer CHF is possible between two straight lines only");
    }
    between.from = vertex - in * corner.size;
    between.to = vertex + out * corner.size;
  }
  if (!within(first, between.from) || !within(second, between.to)) {
    throw Alarm(corner.rounding ? "Rounding radius too large" : "Chamfer too large",
                "The corner is larger than one of its two elements", "make it smaller");
  }
  first = shortened(first, first.from, between.from);
  second = shortened(second, between.to, second.to);
  return between;
}

void Contour::compensate(const Element& element) {
  current_ = element.block;
  if (element.side == Side::Off) {
    finish();
    compensated_ = false;
    if (approach_) runApproach(element);
    current_ = element.block;
    Element free = element;
    if (lastSide_ != Side::Off && !free.arc) {
      free.from = position_;
      free.heightFrom = height_;
    }
    lastSide_ = Side::Off;
    run_(free);
    position_ = free.to;
    height_ = free.heightTo;
    return;
  }
  if (approach_) {
    runApproach(element);
    previous_ = Waiting{.element = element, .approachLine = false};
  } else if (previous_) {
    join(element);
    previous_ = Waiting{.element = element, .approachLine = false};
  } else if (compensated_) {
    const Vector2 beside = element.from + sign(element.side) * radius_() * left(element.startDirection());
    if ((beside - position_).norm() > lengthTolerance) lineTo(beside, element.heightFrom, element.feed);
    previous_ = Waiting{.element = element, .approachLine = false};
  } else {
    position_ = element.from;
    height_ = element.heightFrom;
    previous_ = Waiting{.element = element, .approachLine = !element.arc};
    if (element.arc)
      lineTo(element.from + sign(element.side) * radius_() * left(element.startDirection()), height_, element.feed);
  }
  compensated_ = true;
  lastSide_ = element.side;
}

void Contour::join(const Element& next) {
  const Element first = previous_->element;
  current_ = first.block;
  const double offset = sign(next.side) * radius_();
  const Vector2 vertex = first.to;
  const Vector2 out = next.startDirection();
  if (previous_->approachLine) {
    lineTo(vertex + offset * left(out.isZero(0) ? first.endDirection() : out), first.heightTo, first.feed);
    return;
  }
  const Vector2 in = first.endDirection();
  if (in.isZero(0) || out.isZero(0)) {  // a move of the tool axis alone keeps the place beside the contour
    runOffset(first, in.isZero(0) ? position_ : Vector2(vertex + offset * left(in)));
    current_ = next.block;
    if (!out.isZero(0)) lineTo(vertex + offset * left(out), height_, next.feed);
    return;
  }
  const double turn = cross(in, out);
  const bool straightOn = std::abs(turn) < tangentTolerance && in.dot(out) > 0;
  if (straightOn || first.side != next.side) {
    runOffset(first, vertex + sign(first.side) * radius_() * left(in));
    current_ = next.block;
    if (first.side != next.side) lineTo(vertex + offset * left(out), first.heightTo, next.feed);
    return;
  }
  if (turn * offset > 0) {
    const PlaneCurve besideFirst = beside(first, offset);
    current_ = next.block;
    const std::optional<Vector2> corner = intersection(besideFirst, beside(next, offset), vertex);
    if (!corner) {
      throw Alarm("Tool radius too large", "The tool does not fit into an inside corner of the contour",
                  "use a smaller tool");
    }
    runOffset(first, *corner);
    return;
  }
  runOffset(first, vertex + offset * left(in));
  double sweep = std::atan2(turn, in.dot(out));
  if (sweep * offset > 0) sweep -= std::copysign(2 * std::numbers::pi, sweep);
  arcTo(vertex, sweep, height_, first.feed);
}

void Contour::finish() {
  if (!previous_) return;
  const Waiting waiting = *previous_;
  previous_.reset();
  const Element& element = waiting.element;
  current_ = element.block;
  const Vector2 direction = element.endDirection();
  const Vector2 end =
      direction.isZero(0) ? position_ : Vector2(element.to + sign(element.side) * radius_() * left(direction));
  if (waiting.approachLine) {
    lineTo(end, element.heightTo, element.feed);
  } else {
    runOffset(element, end);
  }
}

/// Runs beside an element of the contour, from where the tool centre stands to `end`.
void Contour::runOffset(const Element& element, const Vector2& end) {
  current_ = element.block;
  Element moved = element;
  if (element.arc) {
    beside(element, sign(element.side) * radius_());  // refuses an inside radius smaller than the tool's
    const double start = normalized(angleOf(position_ - element.centre) - angleOf(element.from - element.centre));
    const double stop = normalized(angleOf(end - element.centre) - angleOf(element.to - element.centre));
    moved.sweep += stop - start;
  }
  moved.from = position_;
  moved.to = end;
  moved.heightFrom = height_;
  run_(moved);
  position_ = end;
  height_ = element.heightTo;
}

void Contour::lineTo(const Vector2& to, double height, Feed feed) {
  Element line;
  line.block = current_;
  line.from = position_;
  line.to = to;
  line.heightFrom = height_;
  line.heightTo = height;
  line.feed = feed;
  run_(line);
  position_ = to;
  height_ = height;
}

void Contour::arcTo(const Vector2& centre, double sweep, double height, Feed feed) {
  Element arc;
  arc.block = current_;
  arc.arc = true;
  arc.centre = centre;
  arc.sweep = sweep;
  arc.from = position_;
  arc.to = centre + turned(position_ - centre, sweep);
  arc.heightFrom = height_;
  arc.heightTo = height;
  arc.feed = feed;
  run_(arc);
  position_ = arc.to;
  height_ = height;
}

void Contour::approach(const Vector2& from, double heightFrom, const Approach& approach) {
  flush();
  position_ = from;
  height_ = heightFrom;
  approach_ = approach;
  end_ = approach.point;
  endHeight_ = approach.height;
}

/// The path to the first contour point, now that the contour's direction there is known.
void Contour::runApproach(const Element& next) {
  const Approach way = *approach_;
  approach_.reset();
  current_ = way.block;
  const Vector2 direction = next.startDirection();
  const double side = way.side == Side::Right ? -1 : 1;
  const Vector2 outward = side * left(direction);
  const Vector2 first = way.point + (way.side == Side::Off ? 0 : radius_()) * outward;
  switch (way.path) {
    case Approach::Path::TangentialLine:
      lineTo(first - way.length * direction, way.height, way.feed);
      break;
    case Approach::Path::PerpendicularLine:
      lineTo(first + way.length * outward, way.height, way.feed);
      break;
    case Approach::Path::TangentialArc: {
      const Vector2 centre = first + way.radius * outward;
      const double sweep = (way.radius * side > 0 ? 1 : -1) * way.angle;
      lineTo(centre + turned(first - centre, -sweep), way.height, way.feed);
      arcTo(centre, sweep, way.height, way.feed);
      break;
    }
    case Approach::Path::ArcAndLine: {
      const Vector2 centre = first + std::abs(way.radius) * outward;
      const Vector2 from = position_ - centre;
      const double distance = from.norm();
      const double radius = std::abs(way.radius);
      if (radius < lengthTolerance || distance < radius) {
        throw Alarm("Approach position wrong", "The approach begins within its own arc",
                    "begin further away, or give a smaller radius R that is not 0");
      }
      const double touch = angleOf(from) + side * std::acos(radius / distance);
      const double end = angleOf(first - centre);
      double sweep = normalized(end - touch);
      if (sweep * side < 0) sweep += side * 2 * std::numbers::pi;
      lineTo(centre + radius * Vector2(std::cos(touch), std::sin(touch)), way.height, way.feed);
      arcTo(centre, sweep, way.height, way.feed);
      break;
    }
  }
  if ((position_ - first).norm() > lengthTolerance) lineTo(first, way.height, way.feed);
  lastSide_ = way.side;
  compensated_ = way.side != Side::Off;
}

void Contour::departLocated(const Approach& departure) {
  const Vector2 direction = direction_;
  const bool beside = lastSide_ != Side::Off || previous_.has_value();
  const double side = (previous_ ? previous_->element.side : lastSide_) == Side::Right ? -1 : 1;
  const double height = endHeight_;
  const Vector2 last = end_;
  flushLocated();
  current_ = departure.block;
  if (!beside) {
    position_ = last;
    height_ = height;
  }
  if (direction.isZero(0)) throw Alarm("DEP not permitted", "There is no contour element to depart from");
  const Vector2 outward = side * left(direction);
  const Feed feed = departure.feed;
  switch (departure.path) {
    case Approach::Path::TangentialLine:
      lineTo(position_ + departure.length * direction, height_, feed);
      break;
    case Approach::Path::PerpendicularLine:
      lineTo(position_ + departure.length * outward, height_, feed);
      break;
    case Approach::Path::TangentialArc: {
      const double sweep = (departure.radius * side > 0 ? 1 : -1) * departure.angle;
      arcTo(position_ + departure.radius * outward, sweep, height_, feed);
      break;
    }
    case Approach::Path::ArcAndLine: {
      const double radius = std::abs(departure.radius);
      const Vector2 centre = position_ + radius * outward;
      const Vector2 to = departure.point - centre;
      if (radius < lengthTolerance || to.norm() < radius) {
        throw Alarm("Departure position wrong", "The departure ends within its own arc",
                    "end further away, or give a smaller radius R that is not 0");
      }
      const double touch = angleOf(to) - side * std::acos(radius / to.norm());
      double sweep = normalized(touch - angleOf(position_ - centre));
      if (sweep * side < 0) sweep += side * 2 * std::numbers::pi;
      arcTo(centre, sweep, height_, feed);
      lineTo(departure.point, departure.height, feed);
      break;
    }
  }
  discard();
}

void Contour::flushLocated() {
  if (last_) {
    const Element element = *last_;
    last_.reset();
    compensate(element);
  }
  corner_.reset();
  finish();
}

void Contour::discard() {
  last_.reset();
  corner_.reset();
  previous_.reset();
  approach_.reset();
  compensated_ = false;
  lastSide_ = Side::Off;
}

}  // namespace probewright::execution::klartext
