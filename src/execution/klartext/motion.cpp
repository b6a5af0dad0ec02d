#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/axis_words.hpp"
#include "execution/klartext/motion.hpp"
#include "language/klartext/lexer.hpp"

/// Straight lines, feeds, positions of the machine. Arcs are in motion_arcs.cpp.
namespace probewright::execution::klartext {

using control::Alarm;
using control::Feed;

namespace {

[[noreturn]] void refuseMachineCoordinates() {
  throw Alarm("Function not permitted", "M91 and M92 take axes in straight lines only",
              "go there with L and the coordinates of the axes");
}

}  // namespace

Motion::Motion(RunContext& run, ToolGuidance& guidance, Tools& tools)
    : run_(run),
      control_(run.control),
      guidance_(guidance),
      tools_(tools),
      contour_([this](const Element& element) { runElement(element, control_.coordinates.plane); },
               [this]() { return control_.channel.toolRadius; }) {}

ProgramPlace Motion::programmedPosition() const {
  if (!contour_.holds()) return control_.channel.position();
  const control::WorkingPlane& plane = control_.coordinates.plane;
  return plane.xyzFromPlane(PlanePlace(contour_.end().x(), contour_.end().y(), contour_.endHeight()));
}

ProgramPlace Motion::pointOf(WordRange words, Evaluation& evaluation, const ProgramPlace& from) const {
  ProgramPlace point = from;
  for (const Word& word : evaluation.words(words)) {
    const char letter = axisLetter(word);
    if (!isLinearAxis(letter)) continue;
    double& coordinate = point[letter - 'X'];
    const double value = run_.length(word.value, evaluation);
    coordinate = word.mode == WordMode::Incremental ? coordinate + value : value;
  }
  return point;
}

Feed checkedFeed(double millimetresPerMinute) {
  constexpr double slowest = 1e-3;
  if (millimetresPerMinute >= slowest) return Feed::at(millimetresPerMinute);
  throw Alarm("Feed rate wrong",
              fmt::format("A feed rate of {} mm/min is not possible", formatShortest(millimetresPerMinute)),
              "program F from 0.001 on");
}

/// A programmed feed, with M136 per revolution.
Feed Motion::feedFor(double programmed) const {
  if (!modes.feedPerRevolution) return checkedFeed(programmed);
  if (control_.tool.spindleSpeed > 0) return checkedFeed(programmed * control_.tool.spindleSpeed);
  throw Alarm("Spindle speed missing", "With M136 the feed rate counts per revolution, but the spindle has no speed",
              "program S in TOOL CALL, or M137");
}

Feed Motion::feedOf(const Move& move, Evaluation& evaluation) {
  if (move.autoFeed) feed_ = control_.tool.feed;
  if (move.feed.present()) feed_ = run_.feed(move.feed, evaluation);
  const double perMinute = modes.feedPerRevolution ? 1 : control_.tool.spindleSpeed;
  if (const Word* perRevolution = find(move.words, "FU", evaluation)) {
    feed_ = run_.length(perRevolution->value, evaluation) * perMinute;
  }
  if (const Word* perTooth = find(move.words, "FZ", evaluation)) {
    feed_ = run_.length(perTooth->value, evaluation) * perMinute * tools_.teeth();
  }
  if (move.rapid) return Feed::rapidTraverse();
  if (feed_ == 0) {
    throw Alarm("Feed rate is missing", "No feed rate has been programmed yet", "program F or FMAX in this block");
  }
  return feedFor(feed_);
}

BlockPlace Motion::placeOf(Evaluation& evaluation) const {
  return {run_.levels.back().program, evaluation.block().position};
}

bool Motion::travels(const Move& move, Evaluation& evaluation) {
  return std::ranges::any_of(evaluation.words(move.words), [](const Word& word) {
    return word.address != addressOf("FU") && word.address != addressOf("FZ");
  });
}

Side Motion::sideOf(const Move& move) {
  switch (move.compensation) {
    case RadiusCompensation::Off:
      side_ = Side::Off;
      break;
    case RadiusCompensation::Left:
      side_ = Side::Left;
      break;
    case RadiusCompensation::Right:
      side_ = Side::Right;
      break;
    case RadiusCompensation::Unchanged:
      break;
  }
  return side_;
}

bool Motion::cornerFollows(Evaluation& evaluation) const {
  const HeidenhainProgram* program = run_.levels.back().program;
  return program != nullptr && program->cornerFollows(evaluation.block().next);
}

void Motion::settle() {
  contour_.flush();
  contour_.discard();
  side_ = Side::Off;
}

void Motion::carryOut(const Move& move, Evaluation& evaluation) {
  const bool straightLine = move.kind == MoveKind::Linear || move.kind == MoveKind::Rapid;
  if (!straightLine && (move.machineCoordinates || move.machineReference2)) refuseMachineCoordinates();
  if (!straightLine && modes.untiltedPositions) run_.leaveOut("M130 in a block other than a straight line");
  switch (move.kind) {
    case MoveKind::SetCentre:
      setCentre(move, evaluation);
      return;
    case MoveKind::Rounding:
    case MoveKind::Chamfer:
      corner(move, evaluation);
      return;
    case MoveKind::Approach:
    case MoveKind::Depart:
      approachOrDepart(move, evaluation);
      break;
    case MoveKind::Linear:
    case MoveKind::Rapid:
      if (move.machineCoordinates || move.machineReference2) {
        moveInMachineCoordinates(move, evaluation);
      } else {
        straight(move, evaluation);
      }
      break;
    case MoveKind::Modal:
    case MoveKind::ArcClockwise:
    case MoveKind::ArcCounterclockwise:
    case MoveKind::ArcTangential:
    case MoveKind::ArcThroughPoint:
      arc(move, evaluation);
      break;
  }
  for (const Instruction& instruction : evaluation.block().instructions)
    if (std::holds_alternative<EndProgram>(instruction)) settle();
}

/// Words of straight lines that would change where the tool is, and are not carried out.
void Motion::namePathWords(const Move& move, Evaluation& evaluation) {
  const control::heidenhain::ActiveTool& tool = control_.tool;
  const bool oversized = tool.deltaLength != 0 || tool.deltaRadius != 0 || tool.deltaRadius2 != 0;
  for (const Word& word : evaluation.words(move.words)) {
    if (word.address == 'R' && word.mode == WordMode::DirectShortest) {
      run_.leaveOut(word.value.number > 0 ? "The paraxial radius compensation R+"
                                          : "The paraxial radius compensation R-");
    }
    const bool normal =
        word.address == addressOf("NX") || word.address == addressOf("NY") || word.address == addressOf("NZ");
    if (normal && oversized) run_.leaveOut("The 3-D compensation of tool oversizes in LN blocks");
  }
}

/// Refuses an axis of the plane beside polar coordinates, which say where it goes themselves.
void Motion::refuseMixture(const Move& move, const control::WorkingPlane& plane, Evaluation& evaluation) const {
  if (!move.polar) return;
  for (const Word& word : evaluation.words(move.words)) {
    const char letter = axisLetter(word);
    if (!isLinearAxis(letter) || letter - 'X' == plane.tool) continue;
    throw Alarm("Block format incorrect",
                fmt::format("Beside polar coordinates only {:c} may stand, not {:c}, which lies in their plane",
                            'X' + plane.tool, letter),
                fmt::format("take {:c} away, or write the end point in X, Y, Z", letter));
  }
}

/// Where PR and PA lead to from `start`; what is not given stays as it is there.
Vector2 Motion::polarEnd(const Move& move, const Vector2& start, const Vector2& pole, Evaluation& evaluation) const {
  const Vector2 arm = start - pole;
  double radius = arm.norm();
  double angle = std::atan2(arm.y(), arm.x());
  if (const Word* pr = find(move.words, "PR", evaluation)) {
    const double value = run_.length(pr->value, evaluation);
    radius = pr->mode == WordMode::Incremental ? radius + value : value;
  }
  if (const Word* pa = find(move.words, "PA", evaluation)) {
    const double value = radiansFromDegrees(evaluation.number(pa->value));
    angle = pa->mode == WordMode::Incremental ? angle + value : value;
  }
  return pole + radius * Vector2(std::cos(angle), std::sin(angle));
}

/// M130: the end point in coordinates of the workpiece system that is not tilted, as the tilted one sees it.
ProgramPlace Motion::untiltedTarget(const Move& move, Evaluation& evaluation, const ProgramPlace& from) const {
  const control::heidenhain::Coordinates& coordinates = control_.coordinates;
  const Eigen::Affine3d machineFromUntilted =
      Eigen::Affine3d(coordinates.machineFromPreset().matrix()) * coordinates.workpiece.matrix(coordinates.plane);
  const Eigen::Affine3d programFromUntilted = control_.channel.frame().inverse() * machineFromUntilted;
  const ProgramPlace inUntilted(programFromUntilted.inverse() * from.vector());
  return ProgramPlace(programFromUntilted * pointOf(move.words, evaluation, inUntilted).vector());
}

void Motion::straightTo(const ProgramPlace& to, Feed feed) {
  if (modes.ignoreProbe) {  // M141: away with a deflected stylus
    control_.channel.retractTo(to, feed);
  } else {
    control_.channel.moveTo(to, feed);
  }
}

void Motion::straight(const Move& move, Evaluation& evaluation) {
  namePathWords(move, evaluation);
  const Side side = sideOf(move);
  const bool hasWords = move.words.count > 0;
  if (!hasWords && !contour_.holds()) {
    if (move.feed.present()) feed_ = run_.feed(move.feed, evaluation);
    return;
  }
  const ProgramPlace from = programmedPosition();
  const bool untilted = modes.untiltedPositions && control_.coordinates.tilt.has_value();
  ProgramPlace to = untilted ? untiltedTarget(move, evaluation, from) : pointOf(move.words, evaluation, from);
  Element element;
  bool turns = false;
  bool travels = move.polar;
  bool directed = false;
  for (const Word& word : evaluation.words(move.words)) {
    const char letter = axisLetter(word);
    if (isLinearAxis(letter)) travels = true;
    if (word.address == addressOf("TX") || word.address == addressOf("TY") || word.address == addressOf("TZ")) {
      directed = true;
    }
    if (letter == '\0' || isLinearAxis(letter)) continue;
    turns = true;
    if (guidance_.spaceAngles() && letter <= 'C') continue;
    const std::size_t axis = run_.axisOf(letter);
    const machine::Axis& description = control_.channel.description().axes[axis];
    const bool rotary = description.kind == machine::AxisKind::Rotary;
    const double sign = control_.coordinates.axisSign(axis);
    const double now = sign * (control_.channel.axes()[axis] - control_.channel.rotaryOffset[axis]);
    double value = rotary ? evaluation.number(word.value) : run_.length(word.value, evaluation);
    if (word.mode == WordMode::Incremental) value += now;
    if (rotary && modes.shortestPath && description.modulo) value = now + std::remainder(value - now, 360.0);
    element.rotary[axis] = sign * value;
  }
  if (guidance_.spaceAngles() && turns) guidance_.turnToSpaceAngles(move.words, element.rotary, evaluation);
  if (directed && control_.channel.holdTip) {
    turns = true;
    guidance_.turnToVector(move.words, element.rotary, evaluation);
  } else if (directed) {
    run_.leaveOut("The tool direction TX, TY, TZ of LN blocks without M128 or FUNCTION TCPM");
  }
  if (move.polar) {
    const control::WorkingPlane plane = polePlane_.value_or(control_.coordinates.plane);
    refuseMixture(move, plane, evaluation);
    if (!poleSet_)
      throw Alarm("Pole missing", "There is no pole for polar coordinates", "program CC before this block");
    const PlanePlace start = plane.planeFromXyz(from);
    const PlanePlace pole = plane.planeFromXyz(pole_);
    const Vector2 end = polarEnd(move, start.inPlane(), pole.inPlane(), evaluation);
    to = plane.xyzFromPlane(PlanePlace(end.x(), end.y(), plane.planeFromXyz(to).z()));
  }
  const Feed feed = feedOf(move, evaluation);
  const bool waits = cornerFollows(evaluation);
  if (side == Side::Off && !waits && !contour_.holds()) {
    const control::WorkingPlane& plane = control_.coordinates.plane;
    contour_.passed((plane.planeFromXyz(to) - plane.planeFromXyz(from)).inPlane());
    if (!turns) {
      straightTo(to, feed);
      return;
    }
    control::Target target;
    for (std::size_t i = 0; i < 3; ++i) {
      if (travels && find(move.words, std::string_view("XYZ").substr(i, 1), evaluation) != nullptr) {
        target.linear[i] = to[static_cast<Eigen::Index>(i)];
      }
    }
    if (move.polar || (travels && untilted)) target.linear = {to.x(), to.y(), to.z()};
    target.rotary = element.rotary;
    guidance_.moveTurning(target, feed);
    return;
  }
  const control::WorkingPlane& plane = control_.coordinates.plane;
  const PlanePlace a = plane.planeFromXyz(from);
  const PlanePlace b = plane.planeFromXyz(to);
  element.from = a.inPlane();
  element.to = b.inPlane();
  element.heightFrom = a.z();
  element.heightTo = b.z();
  element.side = side;
  element.feed = feed;
  element.block = placeOf(evaluation);
  contour_.add(element, waits);
}

void Motion::moveInMachineCoordinates(const Move& move, Evaluation& evaluation) {
  settle();
  const machine::MachineDescription& description = control_.channel.description();
  machine::AxisPositions target = control_.channel.axes();
  for (const Word& word : evaluation.words(move.words)) {
    const char letter = axisLetter(word);
    if (letter == '\0') refuseMachineCoordinates();
    const std::size_t axis = run_.axisOf(letter);
    const bool rotary = description.axes[axis].kind == machine::AxisKind::Rotary;
    const double value = rotary ? evaluation.number(word.value) : run_.length(word.value, evaluation);
    const double reference =
        control_.coordinates.turnsTaken[axis] + (move.machineReference2 ? description.toolChange[axis] : 0);
    target[axis] = word.mode == WordMode::Incremental ? target[axis] + value : reference + value;
  }
  sideOf(move);
  control_.channel.moveAxes(target, feedOf(move, evaluation));
}

void Motion::retract(std::optional<double> distance, Feed feed) {
  control::Channel& channel = control_.channel;
  const machine::MachineDescription& description = channel.description();
  const ProgramPlace start = channel.position();
  const ProgramWay direction = channel.toolAxis();
  const machine::AxisPositions from = channel.axes();
  double way = distance.value_or(std::numeric_limits<double>::infinity());
  if (!distance) {
    const machine::AxisPositions ahead = channel.axesFromProgram(start + direction, from);
    for (std::size_t i = 0; i < description.axes.size(); ++i) {
      const double slope = ahead[i] - from[i];
      if (std::abs(slope) < 1e-9) continue;
      const double limit = slope > 0 ? description.axes[i].maximum : description.axes[i].minimum;
      way = std::min(way, std::max(0.0, (limit - from[i]) / slope));
    }
    if (!std::isfinite(way)) return;
    // Stay clear of the limit by less than any control shows.
    way = std::max(0.0, way - 1e-6);
  }
  channel.moveTo(start + way * direction, feed);
}

}  // namespace probewright::execution::klartext
