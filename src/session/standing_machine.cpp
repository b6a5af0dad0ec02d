#include "session/standing_machine.hpp"

#include <fmt/format.h>

#include <cmath>

#include "control/tool_spindle.hpp"

namespace probewright::session {

using machine::AxisPositions;
using machine::MoveEnd;
using machine::MoveResult;
using machine::Rotation;

namespace {

constexpr const char* stoppedText = "the run was stopped";

}  // namespace

void StandingMachine::hold() {
  released_ = false;
  at_ = machine_.position();
  spindle_ = machine_.spindle();
  if (drivesTools()) driven_ = toolSpindle_->toolSpindle();
  orders_ = {};
}

void StandingMachine::stopOn(std::stop_token stop) {
  stop_ = stop;
  machine_.stopOn(std::move(stop));
}

std::optional<MoveResult> StandingMachine::refusal(machine::Feed feed) const {
  if (stop_.stop_requested()) return MoveResult{MoveEnd::Cancelled, stoppedText};
  if (!feed.rapid && !(feed.perMinute > 0)) return MoveResult{MoveEnd::Refused, "the feed is not above 0"};
  return std::nullopt;
}

MoveResult StandingMachine::countTo(const AxisPositions& target, machine::Feed feed) {
  if (auto refused = refusal(feed)) return *std::move(refused);
  const auto& axes = description().axes;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const machine::Axis& axis = axes[i];
    if (axis.modulo || (target[i] >= axis.minimum - 1e-9 && target[i] <= axis.maximum + 1e-9)) continue;
    return {MoveEnd::AxisLimit,
            fmt::format("axis {}: {} lies outside its travel {} to {}", axis.name,
                        std::abs(target[i]) < 1e9 ? fmt::format("{:.3f}", target[i]) : fmt::format("{:.3g}", target[i]),
                        axis.minimum, axis.maximum)};
  }
  at_ = target;
  return {};
}

MoveResult StandingMachine::move(const AxisPositions& target, machine::Feed feed) {
  return released_ ? machine_.move(target, feed) : countTo(target, feed);
}

machine::PathResult StandingMachine::moveAlong(std::span<const machine::PathPiece> path) {
  if (released_) return machine_.moveAlong(path);
  for (std::size_t i = 0; i < path.size(); ++i) {
    MoveResult piece = countTo(path[i].target, path[i].feed);
    if (piece.end != MoveEnd::Reached) return {piece.end, i, std::move(piece.detail)};
  }
  return {MoveEnd::Reached, path.size(), {}};
}

machine::MeasureResult StandingMachine::measure(const machine::MeasureOrder& order) {
  using machine::MeasureEnd;
  if (released_) return machine_.measure(order);
  MoveResult result = countTo(order.target, order.feed);
  const MeasureEnd end = result.end == MoveEnd::AxisLimit   ? MeasureEnd::AxisLimit
                         : result.end == MoveEnd::Cancelled ? MeasureEnd::Cancelled
                         : result.end == MoveEnd::Refused   ? MeasureEnd::Refused
                                                            : MeasureEnd::NoContact;
  return {end, {}, std::move(result.detail)};
}

MoveResult StandingMachine::retract(const AxisPositions& target, machine::Feed feed) {
  return released_ ? machine_.retract(target, feed) : countTo(target, feed);
}

std::optional<MoveResult> StandingMachine::refusedTurn(Rotation rotation, double speed) const {
  if (rotation == Rotation::None) return std::nullopt;
  if (stop_.stop_requested()) return MoveResult{MoveEnd::Cancelled, stoppedText};
  if (speed >= 0 && std::isfinite(speed)) return std::nullopt;
  return MoveResult{MoveEnd::Refused, fmt::format("a spindle speed of {} is not possible", speed)};
}

std::optional<MoveResult> StandingMachine::refusedAngle(double degrees) const {
  if (stop_.stop_requested()) return MoveResult{MoveEnd::Cancelled, stoppedText};
  if (std::isfinite(degrees)) return std::nullopt;
  return MoveResult{MoveEnd::Refused, "the spindle is sent to an angle that is not a number"};
}

MoveResult StandingMachine::turnSpindle(Rotation rotation, double speed) {
  if (released_) return machine_.turnSpindle(rotation, speed);
  if (auto refused = refusedTurn(rotation, speed)) return *std::move(refused);
  spindle_.rotation = rotation;
  spindle_.speed = rotation == Rotation::None ? 0 : speed;
  orders_.rotation = spindle_;
  if (rotation != Rotation::None) orders_.angle.reset();
  return {};
}

MoveResult StandingMachine::orientSpindle(double degrees) {
  if (released_) return machine_.orientSpindle(degrees);
  if (auto refused = refusedAngle(degrees)) return *std::move(refused);
  spindle_ = {Rotation::None, 0, degrees};
  orders_.angle = degrees;
  orders_.rotation.reset();
  return {};
}

MoveResult StandingMachine::turnTool(Rotation rotation, double speed) {
  if (released_) return toolSpindle_->turnTool(rotation, speed);
  if (auto refused = refusedTurn(rotation, speed)) return *std::move(refused);
  driven_.rotation = rotation;
  driven_.speed = rotation == Rotation::None ? 0 : speed;
  orders_.toolRotation = driven_;
  if (rotation != Rotation::None) orders_.toolAngle.reset();
  return {};
}

MoveResult StandingMachine::orientTool(double degrees) {
  if (released_) return toolSpindle_->orientTool(degrees);
  if (auto refused = refusedAngle(degrees)) return *std::move(refused);
  driven_ = {Rotation::None, 0, degrees};
  orders_.toolAngle = degrees;
  orders_.toolRotation.reset();
  return {};
}

machine::FunctionResult StandingMachine::function(int number) {
  if (released_ || !machine_.hasFunction(number)) return machine_.function(number);
  if (stop_.stop_requested()) return {machine::FunctionEnd::Cancelled, stoppedText};
  // M9 ends what M7 and M8 have begun.
  std::erase_if(orders_.functions, [&](int earlier) {
    return earlier == number || (number == 9 && (earlier == 7 || earlier == 8)) ||
           (earlier == 9 && (number == 7 || number == 8));
  });
  orders_.functions.push_back(number);
  return {};
}

machine::ToolChangeResult StandingMachine::changeTool(const machine::ToolOrder& order) {
  if (released_) return machine_.changeTool(order);
  if (stop_.stop_requested()) return {machine::ToolChangeEnd::Cancelled, stoppedText};
  orders_.tool = order;
  if (!description().mainSpindle) {
    spindle_.rotation = Rotation::None;
    spindle_.speed = 0;
    orders_.rotation.reset();
  }
  for (std::size_t i = 0; i < description().axes.size(); ++i) {
    if (description().axes[i].kind == machine::AxisKind::Linear) at_[i] = description().toolChange[i];
  }
  return {};
}

machine::WaitEnd StandingMachine::dwell(double seconds) {
  if (released_) return machine_.dwell(seconds);
  return stop_.stop_requested() ? machine::WaitEnd::Cancelled : machine::WaitEnd::Over;
}

void catchUp(StandingMachine& machine, control::Channel& channel, std::optional<std::size_t> last) {
  const machine::AxisPositions target = machine.position();
  const StandingOrders orders = machine.orders();
  machine.release();
  if (orders.tool) channel.changeTool(*orders.tool);
  if (orders.angle) channel.orientSpindle(*orders.angle);
  if (orders.rotation) channel.turnSpindle(orders.rotation->rotation, orders.rotation->speed);
  if (orders.toolAngle) control::orientTool(channel, machine, *orders.toolAngle);
  if (orders.toolRotation)
    control::turnTool(channel, machine, orders.toolRotation->rotation, orders.toolRotation->speed);
  for (const int number : orders.functions)
    channel.function(number);
  if (last) {
    const machine::AxisPositions now = machine.position();
    const bool up = target[*last] > now[*last];
    machine::AxisPositions between = up ? now : target;
    between[*last] = up ? target[*last] : now[*last];
    channel.moveAxes(between, machine::Feed::rapidTraverse());
  }
  channel.moveAxes(target, machine::Feed::rapidTraverse());
}

}  // namespace probewright::session
