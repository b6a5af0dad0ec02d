#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/host.hpp"
#include "language/klartext/lexer.hpp"

/// Path functions.
namespace probewright::language::klartext {

using control::Alarm;
using control::Feed;

namespace {

[[noreturn]] void refuseMachineCoordinates() {
  throw Alarm("Function not permitted", "M91 and M92 take axes in straight lines only",
              "go there with L and the coordinates of the axes");
}

constexpr double endPointTolerance = 0.016;  ///< mm: how far C may end beside its circle

bool isLinearAxis(char letter) { return letter >= 'X' && letter <= 'Z'; }

Vector2 turned(const Vector2& v, double angle) {
  return {v.x() * std::cos(angle) - v.y() * std::sin(angle), v.x() * std::sin(angle) + v.y() * std::cos(angle)};
}

/// The single letter of an axis word, or 0.
char axisLetter(const Word& word) {
  const bool single = word.address < 256;
  const char letter = single ? static_cast<char>(word.address) : '\0';
  return std::string_view("XYZABCUVW").find(letter) != std::string_view::npos ? letter : '\0';
}

}  // namespace

const Word* KlartextHost::find(WordRange range, std::string_view address, Evaluation& evaluation) const {
  for (const Word& word : evaluation.words(range)) {
    if (word.address == addressOf(address)) return &word;
  }
  return nullptr;
}

double KlartextHost::length(const Operand& operand, Evaluation& evaluation) const {
  return evaluation.number(operand) * control_.unit;
}

std::size_t KlartextHost::axisOf(char letter) const {
  const auto axis = control_.channel.description().axisIndex(std::string_view(&letter, 1));
  if (!axis) {
    throw Alarm("Axis not available", fmt::format("The machine has no axis {}", letter),
                "take the axis out of the block or choose a machine that has it");
  }
  return *axis;
}

Vector3 KlartextHost::programmedPosition() const {
  if (!contour_.holds()) return control_.channel.position();
  const control::WorkingPlane& plane = control_.coordinates.plane;
  return plane.xyzFromPlane({contour_.end().x(), contour_.end().y(), contour_.endHeight()});
}

/// The end point that the axis words X, Y, Z give.
Vector3 KlartextHost::pointOf(const Move& move, Evaluation& evaluation, const Vector3& from) const {
  Vector3 point = from;
  for (const Word& word : evaluation.words(move.words)) {
    const char letter = axisLetter(word);
    if (!isLinearAxis(letter)) continue;
    double& coordinate = point[letter - 'X'];
    const double value = length(word.value, evaluation);
    coordinate = word.mode == WordMode::Incremental ? coordinate + value : value;
  }
  return point;
}

/// Slower than any control takes, and it would never arrive.
Feed KlartextHost::checkedFeed(double millimetresPerMinute) {
  constexpr double slowest = 1e-3;
  if (millimetresPerMinute >= slowest) return Feed::at(millimetresPerMinute);
  throw Alarm("Feed rate wrong",
              fmt::format("A feed rate of {} mm/min is not possible", formatShortest(millimetresPerMinute)),
              "program F from 0.001 on");
}

/// A programmed feed, with M136 per revolution.
Feed KlartextHost::feedFor(double programmed) const {
  if (!feedPerRevolution_) return checkedFeed(programmed);
  if (control_.tool.spindleSpeed > 0) return checkedFeed(programmed * control_.tool.spindleSpeed);
  throw Alarm("Spindle speed missing", "With M136 the feed rate counts per revolution, but the spindle has no speed",
              "program S in TOOL CALL, or M137");
}

Feed KlartextHost::feedOf(const Move& move, Evaluation& evaluation) {
  if (move.autoFeed) feed_ = control_.tool.feed;
  if (move.feed.present()) feed_ = length(move.feed, evaluation);
  const double perMinute = feedPerRevolution_ ? 1 : control_.tool.spindleSpeed;
  if (const Word* perRevolution = find(move.words, "FU", evaluation)) {
    feed_ = length(perRevolution->value, evaluation) * perMinute;
  }
  if (const Word* perTooth = find(move.words, "FZ", evaluation)) {
    feed_ = length(perTooth->value, evaluation) * perMinute * teeth();
  }
  if (move.rapid) return Feed::rapidTraverse();
  if (feed_ == 0) {
    throw Alarm("Feed rate is missing", "No feed rate has been programmed yet", "program F or FMAX in this block");
  }
  return feedFor(feed_);
}

BlockPlace KlartextHost::placeOf(Evaluation& evaluation) const {
  return {levels_.back().program, evaluation.block().position};
}

double KlartextHost::teeth() const {
  return std::max(control_.tables.tools.numberOr(control_.tool.row, "CUT", 1), 1.0);
}

/// True if the block moves an axis; a feed or a radius compensation alone does not.
bool KlartextHost::travels(const Move& move, Evaluation& evaluation) const {
  return std::ranges::any_of(evaluation.words(move.words), [](const Word& word) {
    return word.address != addressOf("FU") && word.address != addressOf("FZ");
  });
}

Side KlartextHost::sideOf(const Move& move) {
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

void KlartextHost::move(const Move& move, Evaluation& evaluation) {
  const bool straightLine = move.kind == MoveKind::Linear || move.kind == MoveKind::Rapid;
  if (!straightLine && (move.machineCoordinates || move.machineReference2)) refuseMachineCoordinates();
  if (!straightLine && untiltedPositions_) leaveOut("M130 in a block other than a straight line");
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
    default:
      arc(move, evaluation);
      break;
  }
  bool callsByItself = false;  // M99 in the block: the call comes after the move
  for (const Instruction& instruction : evaluation.block().instructions) {
    if (std::holds_alternative<EndProgram>(instruction)) settle();
    const auto* command = std::get_if<Command>(&instruction);
    callsByItself = callsByItself || (command != nullptr && evaluation.at(command->name) == "CYCL CALL");
  }
  if (cycleAtEachMove_ && !callsByItself && travels(move, evaluation)) {
    contour_.flush();
    callMachiningCycle();
  }
}

/// Words of straight lines that would change where the tool is, and are not carried out.
void KlartextHost::namePathWords(const Move& move, Evaluation& evaluation) {
  const control::heidenhain::ActiveTool& tool = control_.tool;
  const bool oversized = tool.deltaLength != 0 || tool.deltaRadius != 0 || tool.deltaRadius2 != 0;
  for (const Word& word : evaluation.words(move.words)) {
    if (word.address == 'R' && word.mode == WordMode::DirectShortest) {
      leaveOut(word.value.number > 0 ? "The paraxial radius compensation R+" : "The paraxial radius compensation R-");
    }
    const bool normal =
        word.address == addressOf("NX") || word.address == addressOf("NY") || word.address == addressOf("NZ");
    if (normal && oversized) leaveOut("The 3-D compensation of tool oversizes in LN blocks");
  }
}

/// M130: the end point in coordinates of the workpiece system that is not tilted, as the tilted one sees it.
Vector3 KlartextHost::untiltedTarget(const Move& move, Evaluation& evaluation, const Vector3& from) const {
  const control::heidenhain::Coordinates& coordinates = control_.coordinates;
  const Eigen::Affine3d machineFromUntilted =
      Eigen::Affine3d(coordinates.machineFromPreset().matrix()) * coordinates.workpiece.matrix(coordinates.plane);
  const Eigen::Affine3d programFromUntilted = control_.channel.frame().inverse() * machineFromUntilted;
  return programFromUntilted * pointOf(move, evaluation, programFromUntilted.inverse() * from);
}

void KlartextHost::straightTo(const Vector3& to, Feed feed) {
  if (ignoreProbe_) {  // M141: away with a deflected stylus
    control_.channel.retractTo(to, feed);
  } else {
    control_.channel.moveTo(to, feed);
  }
}

void KlartextHost::straight(const Move& move, Evaluation& evaluation) {
  namePathWords(move, evaluation);
  const Side side = sideOf(move);
  const bool hasWords = move.words.count > 0;
  if (!hasWords && !contour_.holds()) {
    if (move.feed.present()) feed_ = length(move.feed, evaluation);
    return;
  }
  const Vector3 from = programmedPosition();
  const bool untilted = untiltedPositions_ && control_.coordinates.tilt.has_value();
  Vector3 to = untilted ? untiltedTarget(move, evaluation, from) : pointOf(move, evaluation, from);
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
    if (spaceAngles_ && letter <= 'C') continue;
    const std::size_t axis = axisOf(letter);
    const machine::Axis& description = control_.channel.description().axes[axis];
    const bool rotary = description.kind == machine::AxisKind::Rotary;
    const double sign = control_.coordinates.axisSign(axis);
    const double now = sign * (control_.channel.axes()[axis] - control_.channel.rotaryOffset[axis]);
    double value = rotary ? evaluation.number(word.value) : length(word.value, evaluation);
    if (word.mode == WordMode::Incremental) value += now;
    if (rotary && shortestPath_ && description.modulo) value = now + std::remainder(value - now, 360.0);
    element.rotary[axis] = sign * value;
  }
  if (spaceAngles_ && turns) turnToSpaceAngles(move.words, element.rotary, evaluation);
  if (directed && control_.channel.holdTip) {
    turns = true;
    turnToVector(move.words, element.rotary, evaluation);
  } else if (directed) {
    leaveOut("The tool direction TX, TY, TZ of LN blocks without M128 or FUNCTION TCPM");
  }
  if (move.polar) {
    const control::WorkingPlane plane = polePlane_.value_or(control_.coordinates.plane);
    if (!poleSet_)
      throw Alarm("Pole missing", "There is no pole for polar coordinates", "program CC before this block");
    const Vector3 start = plane.planeFromXyz(from);
    const Vector3 pole = plane.planeFromXyz(pole_);
    const Vector2 arm(start.x() - pole.x(), start.y() - pole.y());
    double radius = arm.norm();
    double angle = std::atan2(arm.y(), arm.x());
    if (const Word* pr = find(move.words, "PR", evaluation)) {
      const double value = length(pr->value, evaluation);
      radius = pr->mode == WordMode::Incremental ? radius + value : value;
    }
    if (const Word* pa = find(move.words, "PA", evaluation)) {
      const double value = radiansFromDegrees(evaluation.number(pa->value));
      angle = pa->mode == WordMode::Incremental ? angle + value : value;
    }
    to = plane.xyzFromPlane(
        {pole.x() + radius * std::cos(angle), pole.y() + radius * std::sin(angle), plane.planeFromXyz(to).z()});
  }
  const Feed feed = feedOf(move, evaluation);
  const bool waits =
      levels_.back().program != nullptr && levels_.back().program->cornerFollows(evaluation.block().next);
  if (side == Side::Off && !waits && !contour_.holds()) {
    const control::WorkingPlane& plane = control_.coordinates.plane;
    contour_.passed((plane.planeFromXyz(to) - plane.planeFromXyz(from)).head<2>());
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
    moveTurning(target, feed);
    return;
  }
  const control::WorkingPlane& plane = control_.coordinates.plane;
  const Vector3 a = plane.planeFromXyz(from);
  const Vector3 b = plane.planeFromXyz(to);
  element.from = a.head<2>();
  element.to = b.head<2>();
  element.heightFrom = a.z();
  element.heightTo = b.z();
  element.side = side;
  element.feed = feed;
  element.block = placeOf(evaluation);
  contour_.add(element, waits);
}

void KlartextHost::addElement(Element element, const Move& move, Evaluation& evaluation) {
  element.side = sideOf(move);
  element.feed = feedOf(move, evaluation);
  element.block = placeOf(evaluation);
  contour_.add(element,
               levels_.back().program != nullptr && levels_.back().program->cornerFollows(evaluation.block().next));
}

void KlartextHost::arc(const Move& move, Evaluation& evaluation) {
  const Word* radiusWord = find(move.words, "R", evaluation);
  const bool needsPole = move.polar || (move.kind != MoveKind::ArcTangential && radiusWord == nullptr);
  const bool beside = needsPole && polePlane_.has_value();
  const control::WorkingPlane plane = beside ? *polePlane_ : control_.coordinates.plane;
  if (beside) contour_.flush();
  const Vector3 from3 = programmedPosition();
  const Vector3 from = plane.planeFromXyz(from3);
  const Vector3 to = plane.planeFromXyz(pointOf(move, evaluation, from3));
  if (move.kind == MoveKind::ArcClockwise) arcDirection_ = -1;
  if (move.kind == MoveKind::ArcCounterclockwise) arcDirection_ = 1;
  Element element;
  element.arc = true;
  element.from = from.head<2>();
  element.to = to.head<2>();
  element.heightFrom = from.z();
  element.heightTo = to.z();
  const Vector3 pole3 = plane.planeFromXyz(pole_);
  const Vector2 pole = pole3.head<2>();
  if (needsPole && !poleSet_) throw Alarm("Circle centre missing", "There is no circle centre", "program CC before it");
  if (move.kind != MoveKind::ArcTangential && arcDirection_ == 0) {
    throw Alarm("Direction of rotation missing", "The arc has no direction of rotation", "program DR+ or DR-");
  }
  const double direction = arcDirection_;

  if (move.kind == MoveKind::ArcTangential) {
    if (move.polar) {
      const Vector2 arm = element.from - pole;
      double radius = arm.norm();
      double angle = std::atan2(arm.y(), arm.x());
      if (const Word* pr = find(move.words, "PR", evaluation)) radius = length(pr->value, evaluation);
      if (const Word* pa = find(move.words, "PA", evaluation)) {
        const double value = radiansFromDegrees(evaluation.number(pa->value));
        angle = pa->mode == WordMode::Incremental ? angle + value : value;
      }
      element.to = pole + radius * Vector2(std::cos(angle), std::sin(angle));
    }
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
    const double radius = length(radiusWord->value, evaluation);
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

void KlartextHost::setCentre(const Move& move, Evaluation& evaluation) {
  const Vector3 from = programmedPosition();
  if (move.words.count == 0) {
    pole_ = from;
    polePlane_.reset();
  } else {
    std::string missing = "XYZ";
    Vector3 base = poleSet_ ? pole_ : from;
    for (const Word& word : evaluation.words(move.words)) {
      const char letter = axisLetter(word);
      if (!isLinearAxis(letter)) throw Alarm("Axis not permitted", "CC takes coordinates X, Y, Z only");
      const int axis = letter - 'X';
      std::erase(missing, letter);
      const double value = length(word.value, evaluation);
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

void KlartextHost::corner(const Move& move, Evaluation& evaluation) {
  const Word* size = find(move.words, "R", evaluation);
  if (size == nullptr) return;
  std::optional<Feed> feed;
  if (move.feed.present()) feed = feedFor(length(move.feed, evaluation));
  const double value = length(size->value, evaluation);
  if (move.kind == MoveKind::Rounding) {
    contour_.round(value, feed, placeOf(evaluation));
  } else {
    contour_.chamfer(value, feed, placeOf(evaluation));
  }
}

void KlartextHost::approachOrDepart(const Move& move, Evaluation& evaluation) {
  const control::WorkingPlane& plane = control_.coordinates.plane;
  Approach way;
  const std::string_view variant = evaluation.at(move.variant);
  const auto is = [&](char a, char b) { return upper(variant[0]) == a && upper(variant[1]) == b; };
  way.path = variant.size() == 3 ? Approach::Path::ArcAndLine
             : is('L', 'T')      ? Approach::Path::TangentialLine
             : is('L', 'N')      ? Approach::Path::PerpendicularLine
                                 : Approach::Path::TangentialArc;
  const Vector3 from = programmedPosition();
  Vector3 to = pointOf(move, evaluation, from);
  if (move.polar) {
    if (!poleSet_)
      throw Alarm("Pole missing", "There is no pole for polar coordinates", "program CC before this block");
    const Vector3 pole = plane.planeFromXyz(pole_);
    const Vector3 start = plane.planeFromXyz(from);
    Vector2 arm(start.x() - pole.x(), start.y() - pole.y());
    double radius = arm.norm();
    double angle = std::atan2(arm.y(), arm.x());
    if (const Word* pr = find(move.words, "PR", evaluation)) radius = length(pr->value, evaluation);
    if (const Word* pa = find(move.words, "PA", evaluation)) {
      angle = radiansFromDegrees(evaluation.number(pa->value));
    }
    to = plane.xyzFromPlane(
        {pole.x() + radius * std::cos(angle), pole.y() + radius * std::sin(angle), plane.planeFromXyz(to).z()});
  }
  const Vector3 point = plane.planeFromXyz(to);
  way.point = point.head<2>();
  way.height = point.z();
  if (const Word* word = find(move.words, "LEN", evaluation)) way.length = std::abs(length(word->value, evaluation));
  if (const Word* word = find(move.words, "R", evaluation)) way.radius = length(word->value, evaluation);
  if (const Word* word = find(move.words, "CCA", evaluation))
    way.angle = radiansFromDegrees(evaluation.number(word->value));
  way.feed = feedOf(move, evaluation);
  way.block = placeOf(evaluation);
  if (move.kind == MoveKind::Approach) {
    way.side = sideOf(move);
    const Vector3 start = plane.planeFromXyz(from);
    contour_.approach(start.head<2>(), start.z(), way);
  } else {
    contour_.depart(way);
    side_ = Side::Off;
  }
}

void KlartextHost::moveInMachineCoordinates(const Move& move, Evaluation& evaluation) {
  settle();
  const machine::MachineDescription& description = control_.channel.description();
  machine::AxisPositions target = control_.channel.axes();
  for (const Word& word : evaluation.words(move.words)) {
    const char letter = axisLetter(word);
    if (letter == '\0') refuseMachineCoordinates();
    const std::size_t axis = axisOf(letter);
    const bool rotary = description.axes[axis].kind == machine::AxisKind::Rotary;
    const double value = rotary ? evaluation.number(word.value) : length(word.value, evaluation);
    const double reference =
        control_.coordinates.turnsTaken[axis] + (move.machineReference2 ? description.toolChange[axis] : 0);
    target[axis] = word.mode == WordMode::Incremental ? target[axis] + value : reference + value;
  }
  sideOf(move);
  control_.channel.moveAxes(target, feedOf(move, evaluation));
}

void KlartextHost::runElement(const Element& element, const control::WorkingPlane& plane) {
  control::Channel& channel = control_.channel;
  const auto point = [&](const Vector2& p, double height) { return plane.xyzFromPlane({p.x(), p.y(), height}); };
  if (!element.arc) {
    const bool turns = std::ranges::any_of(element.rotary, [](const auto& value) { return value.has_value(); });
    const Vector3 to = point(element.to, element.heightTo);
    if (turns) {
      control::Target target;
      target.linear = {to.x(), to.y(), to.z()};
      target.rotary = element.rotary;
      moveTurning(target, element.feed);
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
  // A chord's sagitta is r (1 - cos(a/2)).
  const double step = radius > channel.pathTolerance ? 2 * std::acos(1 - channel.pathTolerance / radius) : sweep;
  const int pieces = std::clamp(static_cast<int>(std::ceil(sweep / std::max(step, 1e-6))), 1, 100000);
  const Vector2 arm = element.from - element.centre;
  std::vector<Vector3> points;
  points.reserve(static_cast<std::size_t>(pieces));
  for (int i = 1; i <= pieces; ++i) {
    const double fraction = static_cast<double>(i) / pieces;
    const Vector2 at = i == pieces ? element.to : Vector2(element.centre + turned(arm, fraction * element.sweep));
    points.push_back(point(at, element.heightFrom + fraction * (element.heightTo - element.heightFrom)));
  }
  channel.moveAlong(points, element.feed);
}

}  // namespace probewright::language::klartext
