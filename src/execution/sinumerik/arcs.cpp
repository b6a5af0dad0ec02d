#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "control/alarm.hpp"
#include "execution/sinumerik/measuring_inputs.hpp"
#include "execution/sinumerik/motion.hpp"
#include "language/word_column.hpp"

/// Arcs as the SINUMERIK language writes them: G2, G3, CIP, CT.
namespace probewright::execution::sinumerik {

using control::Alarm;
using control::Feed;

namespace {

/// $MC_CIRCLE_ERROR_CONST as delivered: how far the radii at start and end may differ, mm.
constexpr double radiusError = 0.01;
constexpr double circle = 2 * std::numbers::pi;

/// The sweep from arm `a` to arm `b` about `axis`, in the sense of `clockwise`; equal arms give a full circle.
double sweepBetween(const Vector3& a, const Vector3& b, const Vector3& axis, bool clockwise) {
  double angle = std::atan2(axis.dot(a.cross(b)), a.dot(b));
  if (std::abs(angle) < 1e-9) angle = 0;
  if (clockwise) return angle >= 0 ? angle - circle : angle;
  return angle <= 0 ? angle + circle : angle;
}

}  // namespace

PathElement PathMotion::arc(const Words& words, MoveKind kind) const {
  const Vector3 from = start(), to = endOf(words);
  switch (kind) {
    case MoveKind::ArcThroughPoint:
      return arcThroughPoint(words, from, to);
    case MoveKind::ArcTangential:
      return tangentialArc(from, to);
    default:
      return arcAboutCentre(words, kind == MoveKind::ArcClockwise, from, to);
  }
}

PathElement PathMotion::arcAboutCentre(const Words& words, bool clockwise, Vector3 from, Vector3 to) const {
  const control::WorkingPlane plane = control_.workingPlane();
  PathElement element;
  element.isArc = true;
  element.axis = Vector3::Unit(plane.tool);
  element.start = from;
  element.end = to;
  const auto inPlane = [&](Vector3 vector) {
    vector[plane.tool] = 0;
    return vector;
  };
  const Vector3 chord = inPlane(to - from);
  const double sense = clockwise ? -1 : 1;
  const bool anyCentre = words.centre[0] || words.centre[1] || words.centre[2];
  if (words.opening && !(*words.opening > 0 && *words.opening < 360))
    throw Alarm("14040", fmt::format("the opening angle AR={} lies outside 0 to 360 degrees", *words.opening),
                "write a full circle with its end point and I, J, K, and choose the direction with G2 or G3");
  if (words.radius || (words.opening && !anyCentre)) {
    if (chord.norm() < 1e-9)
      throw Alarm("14040", "an arc with CR or AR cannot end where it begins", "write a full circle with I, J, K");
    double radius = 0;
    bool large = false;
    if (words.radius) {
      radius = std::abs(*words.radius);
      large = *words.radius < 0;
    } else {
      radius = chord.norm() / 2 / std::sin(radiansFromDegrees(*words.opening) / 2);
      large = *words.opening > 180;
    }
    const double half = chord.norm() / 2;
    if (radius < half - radiusError)
      throw Alarm("14040", fmt::format("the radius {} is too small for an end point {} away", radius, 2 * half),
                  "check CR and the end point");
    const double height = std::sqrt(std::max(0.0, radius * radius - half * half)) * (large ? -1 : 1) * sense;
    element.centre = from + chord / 2 + height * element.axis.cross(chord.normalized());
    element.sweep = sweepBetween(from - element.centre, from + chord - element.centre, element.axis, clockwise);
  } else if (anyCentre) {
    element.centre = from;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      if (!words.centre[i] || index == plane.tool) continue;
      const auto [mode, value] = *words.centre[i];
      element.centre[index] = mode == WordMode::Absolute ? value : from[index] + value;
    }
    const Vector3 arm = inPlane(from - element.centre);
    if (words.opening) {
      element.sweep = sense * radiansFromDegrees(*words.opening);
      const Vector3 end = element.centre + Eigen::AngleAxisd(element.sweep, element.axis) * arm;
      element.end = inPlane(end);
      element.end[plane.tool] = to[plane.tool];
    } else {
      const Vector3 endArm = inPlane(to - element.centre);
      if (std::abs(arm.norm() - endArm.norm()) > radiusError || arm.norm() < 1e-9)
        throw Alarm("14040",
                    fmt::format("the end point lies {:.4f} mm from the centre, the start point {:.4f} mm",
                                endArm.norm(), arm.norm()),
                    "check the end point and I, J, K");
      element.sweep = sweepBetween(arm, endArm, element.axis, clockwise);
    }
  } else {
    const Vector3 arm = inPlane(from - state_.pole);
    const bool polar = words.polarAngle || words.polarRadius;
    if (!polar) throw Alarm("14040", "the arc has no centre and no radius", "write I, J, K, CR= or AR=");
    // Polar coordinates: the pole is the centre.
    element.centre = from - arm;
    element.sweep = sweepBetween(arm, inPlane(to - state_.pole), element.axis, clockwise);
    if (std::abs(arm.norm() - inPlane(to - state_.pole).norm()) > radiusError)
      throw Alarm("14040", "the polar radius changes along the arc", "write the RP of the start point");
  }
  element.sweep += sense * circle * words.turns;
  return element;
}

PathElement PathMotion::arcThroughPoint(const Words& words, Vector3 from, Vector3 to) const {
  Vector3 middle = (from + to) / 2;
  for (std::size_t i = 0; i < 3; ++i)
    if (words.middle[i]) middle[static_cast<Eigen::Index>(i)] = *words.middle[i];
  const Vector3 a = middle - from, b = to - from;
  const Vector3 normal = a.cross(b);
  if (normal.norm() < 1e-9 * std::max(1.0, a.norm() * b.norm()))
    throw Alarm("14040", "start, intermediate and end point of CIP lie on a straight line",
                "write G1, or check I1, J1, K1");
  PathElement element;
  element.isArc = true;
  element.start = from;
  element.end = to;
  element.axis = normal.normalized();
  // The centre of the circle through three points.
  element.centre = from + (a.squaredNorm() * b - b.squaredNorm() * a).cross(normal) / (2 * normal.squaredNorm());
  constexpr bool clockwise = false;  // as seen along the normal
  element.sweep = sweepBetween(from - element.centre, to - element.centre, element.axis, clockwise);
  return element;
}

PathElement PathMotion::tangentialArc(Vector3 from, Vector3 to) const {
  const control::WorkingPlane plane = control_.workingPlane();
  PathElement element;
  element.axis = Vector3::Unit(plane.tool);
  element.start = from;
  element.end = to;
  Vector3 chord = to - from, tangent = direction_;
  chord[plane.tool] = tangent[plane.tool] = 0;
  if (tangent.norm() < 1e-9 || chord.norm() < 1e-9)
    throw Alarm("14045", "CT needs a motion in the plane before it and an end point away from its start");
  tangent.normalize();
  const double half = std::atan2(element.axis.dot(tangent.cross(chord)), tangent.dot(chord));
  if (std::abs(half) < 1e-9) return element;  // straight on
  element.isArc = true;
  element.sweep = 2 * half;
  const double radius = chord.norm() / 2 / std::sin(half);
  element.centre = from + radius * element.axis.cross(tangent);
  return element;
}

void PathMotion::measure(const Command& command, Evaluation& evaluation) {
  flush();
  control::Channel& channel = control_.channel;
  const std::span<const Word> all = evaluation.words(command.words);
  const std::string_view motion = evaluation.at(command.text);
  if (motion == "G0") state_.group1 = MoveKind::Rapid;
  if (motion == "G1") state_.group1 = MoveKind::Linear;
  const bool axial = evaluation.at(command.name).size() == 5;  // MEASA, MEAWA: axis and mode stand after the event
  const std::uint32_t skipped = axial ? 3 : 1;
  WordRange axes{command.words.first + skipped, command.words.count - skipped};
  if (!all.empty() && all.back().address == addressOf("F")) {
    state_.feed = evaluation.number(all.back().value);
    --axes.count;
  }
  const double event = evaluation.number(all.front().value);
  if (event != 1 && event != -1 && event != 2 && event != -2)
    throw Alarm("14020", fmt::format("there is no probe event {}", event), "write 1, -1, 2 or -2");
  const std::optional<machine::Sensor> sensor = sensorAt(std::abs(event) == 2 ? 2 : 1, control_);
  if (state_.group1 != MoveKind::Rapid && state_.group1 != MoveKind::Linear)
    throw Alarm("21610", "a measuring block is a straight line", "write G1 with MEAS");
  Words words = read(axes, evaluation);
  if (words.angle && !resolveAngle(words, state_.group1)) flush();  // which refuses ANG alone
  const ProgramPlace from = channel.position(), to(endOf(words));
  const ProgramWay way = to - from;
  const Feed speed = feed(state_.group1, from.vector(), to.vector());
  if (way.norm() > 1e-9) direction_ = way.normalized().vector();

  control::Journal& journal = channel.journal();
  const bool ownRecord = !journal.cycleOpen;
  if (ownRecord) {
    control::CycleRecord record;
    record.name = evaluation.at(command.name);
    record.title =
        record.name == "MEAS" ? "Measuring, rest of the path deleted" : "Measuring, path travelled to its end";
    record.place = evaluation.place();
    record.place.column = language::columnOf(record.name, evaluation.at(evaluation.block().source));
    record.startSeconds = channel.seconds();
    journal.begin(std::move(record));
  }
  machine::MeasureResult result;
  if (sensor) {
    result = channel.measureTo(to, speed, *sensor);
  } else {
    channel.moveTo(to, speed);  // nothing is connected that could signal
  }
  control::CycleRecord& record = journal.cycles.back();
  control::TouchRecord touch;
  touch.target = to.vector();
  touch.direction = way.norm() > 0 ? way.normalized().vector() : Vector3::Zero();
  touch.seconds = channel.seconds();
  measurement_ = {};
  std::string alarm;
  switch (result.end) {
    case machine::MeasureEnd::Touched: {
      measurement_ = {.triggered = true, .latched = result.latched, .tip = channel.touchFrom(result).tip};
      touch.outcome = "touched";
      break;
    }
    case machine::MeasureEnd::NoContact:
      touch.outcome = "no contact";
      break;
    case machine::MeasureEnd::DeflectedAtStart:
      touch.outcome = "deflected";
      alarm = "21700";
      break;
    case machine::MeasureEnd::Collision:
      touch.outcome = "collision";
      alarm = channel.alarms.collision;
      break;
    case machine::MeasureEnd::AxisLimit:
      touch.outcome = "axis limit";
      alarm = channel.alarms.limit;
      break;
    case machine::MeasureEnd::NotReady:
      touch.outcome = "no probe";
      alarm = "21610";
      break;
    case machine::MeasureEnd::Cancelled:  // the channel throws it, and what is refused
    case machine::MeasureEnd::Refused:
      break;
  }
  touch.latched = measurement_.latched;
  touch.ballCentre = touch.surface = measurement_.tip.vector();
  journal.touch(touch);
  if (measurement_.triggered) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!words.target.linear[i]) continue;
      control::ResultRecord found;
      found.name = fmt::format("$AA_MW[{}]", static_cast<char>('X' + static_cast<char>(i)));
      found.meaning = "position at the probe signal, workpiece coordinates";
      constexpr std::array along = {control::Along::X, control::Along::Y, control::Along::Z};
      found.kind = {control::Role::Touch, {control::Quantity::Coordinate, along[i]}};
      found.value = measurement_.tip[static_cast<Eigen::Index>(i)];
      found.unit = "mm";
      record.results.push_back(std::move(found));
    }
  }
  record.endSeconds = channel.seconds();
  if (ownRecord) journal.cycleOpen = false;
  if (!alarm.empty()) {
    record.alarm = alarm + ": " + touch.outcome;
    throw Alarm(alarm,
                fmt::format("the measuring block ended with: {}{}{}", touch.outcome, result.detail.empty() ? "" : ", ",
                            result.detail),
                "check the position of the probe, the tool and the workpiece");
  }
  if (measurement_.triggered && evaluation.at(command.name).starts_with("MEAW")) channel.retractTo(to, speed);
}

}  // namespace probewright::execution::sinumerik
