#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/alarm.hpp"
#include "execution/klartext/axis_words.hpp"
#include "execution/klartext/motion.hpp"
#include "execution/motion/plane_curve.hpp"
#include "language/klartext/lexer.hpp"

/// Arcs, circle centres, corners, approach and departure.
namespace probewright::execution::klartext {

using control::Alarm;
using control::Feed;
using motion::turned;

namespace {

constexpr double endPointTolerance = 0.016;  ///< mm: how far C may end beside its circle

}  // namespace

void Motion::addElement(Element element, const Move& move, Evaluation& evaluation) {
  element.side = sideOf(move);
  element.feed = feedOf(move, evaluation);
  element.block = placeOf(evaluation);
  contour_.add(element, cornerFollows(evaluation));
}

/// Axes of an arc's block that stay where they are here.
void Motion::nameOtherAxes(const Move& move, Evaluation& evaluation) {
  for (const Word& word : evaluation.words(move.words)) {
    const char letter = axisLetter(word);
    if (letter != '\0' && !isLinearAxis(letter))
      run_.leaveOut(fmt::format("The axis {} in the block of an arc", letter));
  }
}

void Motion::arc(const Move& move, Evaluation& evaluation) {
  nameOtherAxes(move, evaluation);
  const Word* radiusWord = find(move.words, "R", evaluation);
  const bool needsPole = move.polar || (move.kind != MoveKind::ArcTangential && radiusWord == nullptr);
  const bool beside = needsPole && polePlane_.has_value();
  const control::WorkingPlane plane = beside ? *polePlane_ : control_.coordinates.plane;
  refuseMixture(move, plane, evaluation);
  if (beside) contour_.flush();
  const ProgramPlace from3 = programmedPosition();
  const PlanePlace from = plane.planeFromXyz(from3);
  const PlanePlace to = plane.planeFromXyz(pointOf(move.words, evaluation, from3));
  if (move.kind == MoveKind::ArcClockwise) arcDirection_ = -1;
  if (move.kind == MoveKind::ArcCounterclockwise) arcDirection_ = 1;
  Element element;
  element.arc = true;
  element.from = from.inPlane();
  element.to = to.inPlane();
  element.heightFrom = from.z();
  element.heightTo = to.z();
  const Vector2 pole = plane.planeFromXyz(pole_).inPlane();
  if (needsPole && !poleSet_) throw Alarm("Circle centre missing", "There is no circle centre", "program CC before it");
  if (move.kind != MoveKind::ArcTangential && arcDirection_ == 0) {
    throw Alarm("Direction of rotation missing", "The arc has no direction of rotation", "program DR+ or DR-");
  }
  const double direction = arcDirection_;

  if (move.kind == MoveKind::ArcTangential) {
    if (move.polar) element.to = polarEnd(move, element.from, pole, evaluation);
    if (contour_.direction().isZero(0)) {
      throw Alarm("Tangential arc not permitted", "There is no contour element before CT",
                  "program the element that the arc joins");
    }
    Element tangential = tangentialArc(element.from, contour_.direction(), element.to);
    tangential.heightFrom = element.heightFrom;
    tangential.heightTo = element.heightTo;
    if (beside) {
      throw Alarm("Tangential arc not permitted", "CTP joins its arc in the plane of the tool axis only",
                  "program CC in the working plane, or the arc with CP");
    }
    addElement(tangential, move, evaluation);
    return;
  }
  if (move.polar) {
    const Vector2 arm = element.from - pole;
    const Word* pa = find(move.words, "PA", evaluation);
    const double value = pa == nullptr ? 0 : radiansFromDegrees(evaluation.number(pa->value));
    element.centre = pole;
    if (pa == nullptr || pa->mode == WordMode::Incremental) {
      // The sign of IPA and DR must agree on the control; DR decides here.
      element.sweep = pa == nullptr ? direction * 2 * std::numbers::pi : direction * std::abs(value);
    } else {
      double sweep = std::remainder(value - std::atan2(arm.y(), arm.x()), 2 * std::numbers::pi);
      if (sweep * direction <= 1e-12) sweep += direction * 2 * std::numbers::pi;
      element.sweep = sweep;
    }
    element.to = pole + turned(arm, element.sweep);
  } else if (radiusWord != nullptr) {
    const double radius = run_.length(radiusWord->value, evaluation);
    const Vector2 chord = element.to - element.from;
    const double half = chord.norm() / 2;
    if (half < 1e-9) throw Alarm("Circle end point wrong", "CR needs an end point apart from its starting point");
    if (std::abs(radius) < half - endPointTolerance) {
      throw Alarm(
          "Circle radius too small",
          fmt::format("The radius R must be at least {:.4f}, half the distance to the end point", half / control_.unit),
          "correct R or the end point");
    }
    const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
    const Vector2 left(-chord.y() / (2 * half), chord.x() / (2 * half));
    const double sideOfCentre = direction * (radius > 0 ? 1 : -1);
    element.centre = (element.from + element.to) / 2 + sideOfCentre * height * left;
    double sweep = 2 * std::asin(std::min(1.0, half / std::abs(radius)));
    if (radius < 0) sweep = 2 * std::numbers::pi - sweep;
    element.sweep = direction * sweep;
  } else {
    element.centre = pole;
    const Vector2 a = element.from - pole;
    Vector2 b = element.to - pole;
    if (a.norm() < 1e-9) throw Alarm("Circle centre wrong", "The arc begins at its own centre");
    if (std::abs(a.norm() - b.norm()) > endPointTolerance) {
      throw Alarm("Circle end point wrong",
                  fmt::format("The end point lies {:.4f} mm beside the circle", std::abs(a.norm() - b.norm())),
                  "correct the end point or the centre: the two axes of CC are the plane of the circle");
    }
    double sweep = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    if (sweep * direction <= 1e-9) sweep += direction * 2 * std::numbers::pi;
    element.sweep = sweep;
    element.to = pole + turned(a, sweep);
  }
  if (!beside) {
    addElement(element, move, evaluation);
    return;
  }
  if (sideOf(move) != Side::Off) {
    throw Alarm("Radius compensation not permitted",
                "An arc that does not lie in the plane of the tool axis takes no radius compensation",
                "program it with R0, or call the tool with another axis");
  }
  element.feed = feedOf(move, evaluation);
  runElement(element, plane);
}

void Motion::setCentre(const Move& move, Evaluation& evaluation) {
  const ProgramPlace from = programmedPosition();
  if (move.words.count == 0) {
    pole_ = from;
    polePlane_.reset();
  } else {
    std::string missing = "XYZ";
    ProgramPlace base = poleSet_ ? pole_ : from;
    for (const Word& word : evaluation.words(move.words)) {
      const char letter = axisLetter(word);
      if (!isLinearAxis(letter)) throw Alarm("Axis not permitted", "CC takes coordinates X, Y, Z only");
      const int axis = letter - 'X';
      std::erase(missing, letter);
      const double value = run_.length(word.value, evaluation);
      base[axis] = word.mode == WordMode::Incremental ? from[axis] + value : value;
    }
    pole_ = base;
    if (missing.size() == 1) {  // two axes: their plane
      polePlane_ = control::WorkingPlane::ofToolAxis(missing.front());
      if (polePlane_->tool == control_.coordinates.plane.tool) polePlane_.reset();
    }
  }
  poleSet_ = true;
}

void Motion::corner(const Move& move, Evaluation& evaluation) {
  const Word* size = find(move.words, "R", evaluation);
  if (size == nullptr) return;
  std::optional<Feed> feed;
  if (move.feed.present()) feed = feedFor(run_.feed(move.feed, evaluation));
  const double value = run_.length(size->value, evaluation);
  if (move.kind == MoveKind::Rounding) {
    contour_.round(value, feed, placeOf(evaluation));
  } else {
    contour_.chamfer(value, feed, placeOf(evaluation));
  }
}

void Motion::approachOrDepart(const Move& move, Evaluation& evaluation) {
  const control::WorkingPlane& plane = control_.coordinates.plane;
  nameOtherAxes(move, evaluation);
  refuseMixture(move, plane, evaluation);
  Approach way;
  const std::string_view variant = evaluation.at(move.variant);
  const auto is = [&](char a, char b) { return upper(variant[0]) == a && upper(variant[1]) == b; };
  way.path = variant.size() == 3 ? Approach::Path::ArcAndLine
             : is('L', 'T')      ? Approach::Path::TangentialLine
             : is('L', 'N')      ? Approach::Path::PerpendicularLine
                                 : Approach::Path::TangentialArc;
  const ProgramPlace from = programmedPosition();
  ProgramPlace to = pointOf(move.words, evaluation, from);
  if (move.polar) {
    if (!poleSet_)
      throw Alarm("Pole missing", "There is no pole for polar coordinates", "program CC before this block");
    const PlanePlace pole = plane.planeFromXyz(pole_);
    const PlanePlace start = plane.planeFromXyz(from);
    const Vector2 end = polarEnd(move, start.inPlane(), pole.inPlane(), evaluation);
    to = plane.xyzFromPlane(PlanePlace(end.x(), end.y(), plane.planeFromXyz(to).z()));
  }
  const PlanePlace point = plane.planeFromXyz(to);
  way.point = point.inPlane();
  way.height = point.z();
  if (const Word* word = find(move.words, "LEN", evaluation))
    way.length = std::abs(run_.length(word->value, evaluation));
  if (const Word* word = find(move.words, "R", evaluation)) way.radius = run_.length(word->value, evaluation);
  if (const Word* word = find(move.words, "CCA", evaluation))
    way.angle = radiansFromDegrees(evaluation.number(word->value));
  way.feed = feedOf(move, evaluation);
  way.block = placeOf(evaluation);
  if (move.kind == MoveKind::Approach) {
    way.side = sideOf(move);
    const PlanePlace start = plane.planeFromXyz(from);
    contour_.approach(start.inPlane(), start.z(), way);
  } else {
    contour_.depart(way);
    side_ = Side::Off;
  }
}

void Motion::runElement(const Element& element, const control::WorkingPlane& plane) {
  control::Channel& channel = control_.channel;
  const auto point = [&](const Vector2& p, double height) {
    return plane.xyzFromPlane(PlanePlace(p.x(), p.y(), height));
  };
  if (!element.arc) {
    const bool turns = std::ranges::any_of(element.rotary, [](const auto& value) { return value.has_value(); });
    const ProgramPlace to = point(element.to, element.heightTo);
    if (turns) {
      control::Target target;
      target.linear = {to.x(), to.y(), to.z()};
      target.rotary = element.rotary;
      guidance_.moveTurning(target, element.feed);
    } else {
      straightTo(to, element.feed);
    }
    return;
  }
  const double radius = element.radius();
  const double sweep = std::abs(element.sweep);
  if (!std::isfinite(radius) || !std::isfinite(sweep)) {
    throw Alarm("Circle not defined", "The arc cannot be computed from the values of its block");
  }
  const int pieces = motion::piecesOfArc(radius, sweep, channel.pathTolerance);
  const Vector2 arm = element.from - element.centre;
  std::vector<ProgramPlace> points;
  points.reserve(static_cast<std::size_t>(pieces));
  for (int i = 1; i <= pieces; ++i) {
    const double fraction = static_cast<double>(i) / pieces;
    const Vector2 at = i == pieces ? element.to : Vector2(element.centre + turned(arm, fraction * element.sweep));
    points.push_back(point(at, element.heightFrom + fraction * (element.heightTo - element.heightFrom)));
  }
  run_.work += points.size();
  channel.moveAlong(points, element.feed);
}

}  // namespace probewright::execution::klartext
