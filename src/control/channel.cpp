#include "control/channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "control/alarm.hpp"
#include "control/missing_axis.hpp"
#include "control/stopped_place.hpp"
#include "geometry/decompositions.hpp"

namespace probewright::control {
namespace {

constexpr std::array<std::string_view, 3> linearNames = {"X", "Y", "Z"};

bool isRotary(const machine::MachineDescription& machine, std::size_t axis) {
  return machine.axes[axis].kind == machine::AxisKind::Rotary;
}

/// The way of the tip over the table, mm: what rotary axes of head and table move it counts, what the main spindle of a
/// lathe turns beneath it does not.
double travelOnTable(const Channel& channel, const AxisPositions& from, const AxisPositions& to) {
  const machine::MachineDescription& description = channel.description();
  constexpr double turnPerPiece = 0.25;  // degrees; a chord of it is shorter than its arc by 1e-6 of the length
  constexpr double mostPieces = 10'000;
  const auto turns = [&](std::size_t axis) { return isRotary(description, axis) && axis != description.mainSpindle; };
  double turn = 0;
  for (std::size_t i = 0; i < description.axes.size(); ++i) {
    if (turns(i)) turn = std::max(turn, std::abs(to[i] - from[i]));
  }
  if (turn == 0) return (channel.machineFromAxes(to) - channel.machineFromAxes(from)).norm();
  const auto pieces = static_cast<int>(std::clamp(std::ceil(turn / turnPerPiece), 1.0, mostPieces));
  const auto tip = [&](double fraction) {
    AxisPositions axes = from;
    for (std::size_t i = 0; i < description.axes.size(); ++i) {
      if (turns(i) || !isRotary(description, i)) axes[i] += fraction * (to[i] - from[i]);
    }
    return Vector3(machine::baseFromTable(description, axes).inverse() *
                   (machine::baseFromSpindle(description, axes) * Vector3(-channel.toolVector)));
  };
  double length = 0;
  Vector3 last = tip(0);
  for (int i = 1; i <= pieces; ++i) {
    const Vector3 next = tip(static_cast<double>(i) / pieces);
    length += (next - last).norm();
    last = next;
  }
  return length;
}

}  // namespace

Channel::Channel(machine::Machine& machine, Journal& journal) : machine_(machine), journal_(journal) {
  setDescription(machine.description());
}

void Channel::setDescription(const machine::MachineDescription& believed) {
  description_ = believed;
  for (std::size_t i = 0; i < 3; ++i)
    linearAxis_[i] = description_.axisIndex(linearNames[i]);
  setFollowing(following_, reference_);
}

void Channel::setFrame(const Eigen::Affine3d& machineFromProgram) {
  machineFromProgram_ = machineFromProgram;
  programFromMachine_ = machineFromProgram.inverse();
}

void Channel::setFollowing(Following following, const AxisPositions& reference) {
  following_ = following;
  reference_ = reference;
  for (std::size_t i = 0; i < description_.axes.size(); ++i) {
    if (!isRotary(description_, i)) reference_[i] = 0;
  }
  referenceFromTable_ = machine::baseFromTable(description_, reference_);
}

MachinePlace Channel::machineFromAxes(const AxisPositions& axes) const {
  const Vector3 deviation = tipDeviation ? tipDeviation(axes) : Vector3::Zero();
  if (following_ == Following::Kinematics) {
    const Vector3 tip = machine::baseFromSpindle(description_, axes) * Vector3(-toolVector) + deviation;
    return MachinePlace(referenceFromTable_ * (machine::baseFromTable(description_, axes).inverse() * tip));
  }
  Vector3 reference = Vector3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    if (linearAxis_[i]) reference[static_cast<Eigen::Index>(i)] = axes[*linearAxis_[i]];
  }
  return MachinePlace(reference - toolVector + deviation);
}

ProgramPlace Channel::programFromAxes(const AxisPositions& axes) const {
  return programFromMachine(machineFromAxes(axes));
}

AxisPositions Channel::axesFromMachine(const MachinePlace& tip, const AxisPositions& rotary) const {
  AxisPositions axes = rotary;
  if (following_ == Following::LinearAxes) {
    const Vector3 reference = tip.vector() + toolVector - (tipDeviation ? tipDeviation(rotary) : Vector3::Zero());
    for (std::size_t i = 0; i < 3; ++i) {
      if (linearAxis_[i]) {
        axes[*linearAxis_[i]] = reference[static_cast<Eigen::Index>(i)];
      } else if (std::abs(reference[static_cast<Eigen::Index>(i)]) > 1e-6) {
        throw MissingAxis("", fmt::format("The machine has no axis {} to reach the position", linearNames[i]),
                          "program positions that its axes reach; cancel frames that turn them out of their plane");
      }
    }
    return axes;
  }
  // With the rotary axes given, the tip is an affine function of the linear axes.
  for (std::size_t i = 0; i < 3; ++i) {
    if (linearAxis_[i]) axes[*linearAxis_[i]] = 0;
  }
  const MachinePlace atZero = machineFromAxes(axes);
  Matrix3 slope = Matrix3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    if (!linearAxis_[i]) continue;
    AxisPositions one = axes;
    one[*linearAxis_[i]] = 1;
    slope.col(static_cast<Eigen::Index>(i)) = (machineFromAxes(one) - atZero).vector();
  }
  const Vector3 way = (tip - atZero).vector();
  const Vector3 solution = solveLinear(slope, way);
  if ((slope * solution - way).norm() > 1e-6) {
    throw Alarm("", "The machine's linear axes cannot reach the position");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (linearAxis_[i]) axes[*linearAxis_[i]] = solution[static_cast<Eigen::Index>(i)];
  }
  return axes;
}

AxisPositions Channel::axesFromProgram(const ProgramPlace& tip, const AxisPositions& rotary) const {
  return axesFromMachine(machineFromProgram(tip), rotary);
}

ProgramWay Channel::toolAxis() const {
  const Vector3 direction = toolVector.norm() > 1e-9 ? toolVector.normalized() : Vector3::UnitZ();
  return ProgramWay((spindleFromProgram().inverse() * direction).normalized());
}

Matrix3 Channel::spindleFromProgram() const {
  if (following_ != Following::Kinematics) return machineFromProgram_.linear();
  const AxisPositions now = axes();
  const Matrix3 referenceFromSpindle = referenceFromTable_.linear() *
                                       machine::baseFromTable(description_, now).linear().transpose() *
                                       machine::baseFromSpindle(description_, now).linear();
  return referenceFromSpindle.transpose() * machineFromProgram_.linear();
}

Eigen::Affine3d Channel::programFromTable(const AxisPositions& axes) const {
  if (following_ == Following::Kinematics) return programFromMachine_ * referenceFromTable_;
  // Linear axes count alike whether they move the table or the tool.
  AxisPositions turned = axes;
  for (std::size_t i = 0; i < description_.axes.size(); ++i) {
    if (!isRotary(description_, i)) turned[i] = 0;
  }
  // Positions are those of the linear axes: a head that turns the tool aside moves the tip, but not its coordinates.
  const Vector3 aside = machine::baseFromSpindle(description_, turned) * Vector3(-toolVector) + toolVector;
  return programFromMachine_ * Pose(translation(-aside)) * machine::baseFromTable(description_, turned);
}

namespace {

constexpr bool whileMoving = false, whileMeasuring = true;

}  // namespace

void Channel::note(Interruption why, bool measuring, const AxisPositions& from, const AxisPositions& to) {
  const AxisPositions now = axes();
  journal_.interrupt({.why = why,
                      .measuring = measuring,
                      .cycle = std::nullopt,
                      .from = from,
                      .to = to,
                      .end = now,
                      .programFromTable = programFromTable(now),
                      .programUnit = programUnit != nullptr ? *programUnit : 1,
                      .seconds = seconds()});
}

void Channel::note(machine::MoveEnd end, const AxisPositions& from, const AxisPositions& to) {
  switch (end) {
    case machine::MoveEnd::Reached:
    case machine::MoveEnd::Cancelled:
    case machine::MoveEnd::Refused:
      return;
    case machine::MoveEnd::ProbeSignal:
      return note(Interruption::Deflected, whileMoving, from, to);
    case machine::MoveEnd::Collision:
      return note(Interruption::Collision, whileMoving, from, to);
    case machine::MoveEnd::AxisLimit:
      return note(Interruption::Limit, whileMoving, from, to);
  }
}

void Channel::note(machine::MeasureEnd end, const AxisPositions& from, const AxisPositions& to) {
  switch (end) {
    case machine::MeasureEnd::Touched:
    case machine::MeasureEnd::NotReady:
    case machine::MeasureEnd::Cancelled:
    case machine::MeasureEnd::Refused:
      return;
    case machine::MeasureEnd::NoContact:
      return note(Interruption::NoContact, whileMeasuring, from, to);
    case machine::MeasureEnd::DeflectedAtStart:
      return note(Interruption::Deflected, whileMeasuring, from, to);
    case machine::MeasureEnd::Collision:
      return note(Interruption::Collision, whileMeasuring, from, to);
    case machine::MeasureEnd::AxisLimit:
      return note(Interruption::Limit, whileMeasuring, from, to);
  }
}

void Channel::judgeTravel(machine::MoveResult result) const {
  if (result.end == machine::MoveEnd::ProbeSignal || result.end == machine::MoveEnd::Collision) addPlace(result.detail);
  judge(result);
}

void Channel::addPlace(std::string& detail) const {
  detail += (detail.empty() ? "The " : "; the ") + stoppedPlace(*this);
}

void Channel::judge(const machine::MoveResult& result) const {
  switch (result.end) {
    case machine::MoveEnd::Reached:
      return;
    case machine::MoveEnd::ProbeSignal:
      throw Alarm(alarms.probeSignal, result.detail, "check the clearance and the path of the probe");
    case machine::MoveEnd::Collision:
      throw Alarm(alarms.collision, result.detail, "check clearance heights, tool lengths and the presets");
    case machine::MoveEnd::AxisLimit:
      throw Alarm(alarms.limit, result.detail, "check the presets and the position of the workpiece in the machine");
    case machine::MoveEnd::Refused:
      throw Alarm(alarms.refused, result.detail,
                  "see what the machine lacks; what it never can, take out of the program");
    case machine::MoveEnd::Cancelled:
      throw Cancelled();
  }
}

void Channel::count(const AxisPositions& from, const AxisPositions& to) {
  const double length = travelOnTable(*this, from, to);
  pathLength_ += length;
  if (CycleRecord* cycle = journal_.open()) cycle->pathLength += length;
}

namespace {

/// The target as a control orders it: an axis that only rounding leads beyond an end of its travel (by up to 1e-9 mm or
/// degrees, as after the way through a tilted system and back) goes to that end.
AxisPositions withinTravel(const machine::MachineDescription& description, AxisPositions target) {
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < description.axes.size(); ++i) {
    const machine::Axis& axis = description.axes[i];
    if (axis.kind == machine::AxisKind::Rotary && axis.modulo) continue;
    const double inside = std::clamp(target[i], axis.minimum, axis.maximum);
    if (std::abs(target[i] - inside) <= rounding) target[i] = inside;
  }
  return target;
}

}  // namespace

void Channel::moveAxes(const AxisPositions& end, Feed feed) {
  const AxisPositions start = axes(), target = withinTravel(description_, end);
  if (start == target) return;
  machine::MoveResult result = machine_.move(target, feed);
  count(start, axes());
  note(result.end, start, target);
  if (result.end == machine::MoveEnd::AxisLimit) result.detail = beyondTravel(*this, result.detail, target);
  judgeTravel(std::move(result));
}

/// A path of straight pieces; those that go nowhere are left out.
void Channel::travel(std::vector<machine::PathPiece> path) {
  const AxisPositions start = axes();
  AxisPositions last = start;
  for (machine::PathPiece& piece : path)
    piece.target = withinTravel(description_, piece.target);
  std::erase_if(path,
                [&](const machine::PathPiece& piece) { return std::exchange(last, piece.target) == piece.target; });
  if (path.empty()) return;
  machine::PathResult result = machine_.moveAlong(path);
  last = start;
  for (std::size_t i = 0; i < result.reached; ++i)
    count(std::exchange(last, path[i].target), path[i].target);
  if (result.reached < path.size()) {
    count(last, axes());
    note(result.end, last, path[result.reached].target);
  }
  if (result.end == machine::MoveEnd::AxisLimit && result.reached < path.size())
    result.detail = beyondTravel(*this, result.detail, path[result.reached].target);
  judgeTravel({result.end, std::move(result.detail)});
}

void Channel::moveAlong(std::span<const ProgramPlace> tips, Feed feed) {
  const AxisPositions start = axes();
  std::vector<machine::PathPiece> path;
  path.reserve(tips.size());
  for (const ProgramPlace& tip : tips)
    path.push_back({axesFromProgram(tip, start), feed});
  travel(std::move(path));
}

void Channel::moveTo(const ProgramPlace& tip, Feed feed) { moveAxes(axesFromProgram(tip, axes()), feed); }

void Channel::moveTo(const Target& target, Feed feed) {
  const AxisPositions start = axes();
  AxisPositions end = start;
  bool turns = false;
  for (std::size_t i = 0; i < description_.axes.size(); ++i) {
    if (!target.rotary[i]) continue;
    end[i] = *target.rotary[i] + rotaryOffset[i];
    turns = turns || end[i] != start[i];
  }
  const bool travels = std::ranges::any_of(target.linear, [](const auto& value) { return value.has_value(); });
  const ProgramPlace from = programFromAxes(start);
  // What is not programmed keeps the tip's place on the workpiece with TCPM, the axes' place without.
  ProgramPlace to = turns && !holdTip ? programFromAxes(end) : from;
  for (std::size_t i = 0; i < 3; ++i) {
    if (target.linear[i]) to[static_cast<Eigen::Index>(i)] = *target.linear[i];
  }
  if (!travels && !(turns && holdTip)) {
    moveAxes(end, feed);
    return;
  }
  end = axesFromProgram(to, end);
  if (!turns || !holdTip || following_ == Following::LinearAxes) {
    moveAxes(end, feed);
    return;
  }
  // The tip's path is straight on the workpiece, so the axes' path is curved: as many pieces as the tolerance asks for.
  const auto at = [&](double fraction) {
    AxisPositions rotary = start;
    for (std::size_t i = 0; i < description_.axes.size(); ++i) {
      if (isRotary(description_, i)) rotary[i] = start[i] + fraction * (end[i] - start[i]);
    }
    return axesFromProgram(from + fraction * (to - from), rotary);
  };
  const AxisPositions middle = at(0.5);
  double sag = 0;
  for (std::size_t i = 0; i < description_.axes.size(); ++i) {
    if (!isRotary(description_, i)) sag = std::max(sag, std::abs(middle[i] - (start[i] + end[i]) / 2));
  }
  double turn = 0;
  for (std::size_t i = 0; i < description_.axes.size(); ++i) {
    if (isRotary(description_, i)) turn = std::max(turn, std::abs(end[i] - start[i]));
  }
  const int pieces = std::clamp(
      std::max(static_cast<int>(std::ceil(std::sqrt(sag / pathTolerance))), static_cast<int>(std::ceil(turn / 5))), 1,
      10000);
  std::vector<machine::PathPiece> path;
  path.reserve(static_cast<std::size_t>(pieces));
  for (int i = 1; i <= pieces; ++i)
    path.push_back({i == pieces ? end : at(static_cast<double>(i) / pieces), feed});
  travel(std::move(path));
}

machine::MeasureResult Channel::measureTo(const ProgramPlace& tip, Feed feed, machine::Sensor sensor, TouchWith part) {
  const AxisPositions start = axes();
  const AxisPositions target = withinTravel(description_, axesFromProgram(tip, start));
  journal_.programFromTable = programFromTable(start);
  machine::MeasureResult result = machine_.measure({target, feed, sensor, part});
  count(start, axes());
  note(result.end, start, target);
  if (result.end == machine::MeasureEnd::Cancelled) throw Cancelled();
  if (result.end == machine::MeasureEnd::Refused) judge({machine::MoveEnd::Refused, result.detail});
  if (result.end == machine::MeasureEnd::Collision) addPlace(result.detail);
  if (result.end == machine::MeasureEnd::AxisLimit) result.detail = beyondTravel(*this, result.detail, target);
  return result;
}

Touch Channel::touchFrom(const machine::MeasureResult& result) const {
  return {programFromAxes(result.latched), result.latched};
}

void Channel::retractTo(const ProgramPlace& tip, Feed feed) {
  const AxisPositions start = axes();
  const AxisPositions target = withinTravel(description_, axesFromProgram(tip, start));
  machine::MoveResult result = machine_.retract(target, feed);
  count(start, axes());
  note(result.end, start, target);
  if (result.end == machine::MoveEnd::AxisLimit) result.detail = beyondTravel(*this, result.detail, target);
  judgeTravel(std::move(result));
}

void Channel::turnSpindle(machine::Rotation rotation, double speed) { judge(machine_.turnSpindle(rotation, speed)); }

void Channel::orientSpindle(double degrees) {
  if (!description_.mainSpindle) {
    machine::MoveResult result = machine_.orientSpindle(degrees);
    if (result.end == machine::MoveEnd::Refused)
      throw Alarm(alarms.orientation, result.detail, "choose a machine whose spindle can be oriented");
    return judge(result);
  }
  if (spindleRotation() != machine::Rotation::None) turnSpindle(machine::Rotation::None, 0);
  AxisPositions target = axes();
  double& angle = target[*description_.mainSpindle];
  const machine::Axis& axis = description_.axes[*description_.mainSpindle];
  angle = axis.modulo ? angle + std::remainder(degrees - angle, 360.0) : degrees;
  moveAxes(target, Feed::rapidTraverse());
}

double Channel::spindleAngle() const {
  return description_.mainSpindle ? axes()[*description_.mainSpindle] : machine_.spindle().angle;
}

bool Channel::function(int number) {
  machine::FunctionResult result = machine_.function(number);
  switch (result.end) {
    case machine::FunctionEnd::CarriedOut:
      return true;
    case machine::FunctionEnd::Unknown:
      return false;
    case machine::FunctionEnd::Refused:
      throw Alarm(alarms.refused, fmt::format("M{}: {}", number, result.detail), "see what the machine lacks");
    case machine::FunctionEnd::Cancelled:
      throw Cancelled();
  }
  return false;
}

std::string askForTool(const machine::ToolOrder& order, const std::string& detail) {
  return fmt::format("Put in tool {}{}{}{}{}", order.number, order.name.empty() ? "" : " ", order.name,
                     detail.empty() ? "" : ": ", detail);
}

void Channel::changeTool(const machine::ToolOrder& order) {
  using machine::ToolChangeEnd;
  machine::ToolChangeResult result = machine_.changeTool(order);
  if (result.end == ToolChangeEnd::ByHand && onToolByHand) {
    onToolByHand(order, result.detail);
    result = machine_.changeTool(order);
  }
  switch (result.end) {
    case ToolChangeEnd::Changed:
      return;
    case ToolChangeEnd::ByHand:
      throw Alarm(alarms.refused, "the tool was not put in by hand: " + result.detail,
                  "put the tool into the spindle before NC start");
    case ToolChangeEnd::Missing:
      throw Alarm(alarms.toolMissing, result.detail, "put the tool into the magazine, or call one that it holds");
    case ToolChangeEnd::Refused:
      throw Alarm(alarms.refused, "the tool is not changed: " + result.detail, "see what the tool changer lacks");
    case ToolChangeEnd::ProbeSignal:
      return judge({machine::MoveEnd::ProbeSignal, result.detail});
    case ToolChangeEnd::Collision:
      return judge({machine::MoveEnd::Collision, result.detail});
    case ToolChangeEnd::Cancelled:
      throw Cancelled();
  }
}

void Channel::dwell(double seconds) {
  if (machine_.dwell(seconds) == machine::WaitEnd::Cancelled) throw Cancelled();
}

}  // namespace probewright::control
