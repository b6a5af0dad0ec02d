#include "session/standing_machine.hpp"

#include <fmt/format.h>

#include <cmath>

namespace probewright::session {

using machine::AxisPositions;
using machine::MoveResult;

void StandingMachine::hold() {
  released_ = false;
  at_ = machine_.position();
  angle_ = machine_.spindleAngle();
  tool_.reset();
  orderedAngle_.reset();
}

MoveResult StandingMachine::countTo(const AxisPositions& target) {
  const auto& axes = description().axes;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const machine::Axis& axis = axes[i];
    if (axis.modulo || (target[i] >= axis.minimum - 1e-9 && target[i] <= axis.maximum + 1e-9)) continue;
    return {machine::MoveEnd::AxisLimit,
            fmt::format("axis {}: {} lies outside its travel {} to {}", axis.name,
                        std::abs(target[i]) < 1e9 ? fmt::format("{:.3f}", target[i]) : fmt::format("{:.3g}", target[i]),
                        axis.minimum, axis.maximum)};
  }
  at_ = target;
  return {};
}

MoveResult StandingMachine::move(const AxisPositions& target, machine::Feed feed) {
  return released_ ? machine_.move(target, feed) : countTo(target);
}

machine::MeasureResult StandingMachine::measure(const AxisPositions& target, machine::Feed feed) {
  if (released_) return machine_.measure(target, feed);
  const MoveResult result = countTo(target);
  if (result.end == machine::MoveEnd::AxisLimit) return {machine::MeasureEnd::AxisLimit, {}, result.detail};
  return {machine::MeasureEnd::NoContact, {}, {}};
}

MoveResult StandingMachine::retract(const AxisPositions& target, machine::Feed feed) {
  return released_ ? machine_.retract(target, feed) : countTo(target);
}

MoveResult StandingMachine::orientSpindle(double degrees) {
  if (released_) return machine_.orientSpindle(degrees);
  orderedAngle_ = angle_ = degrees;
  return {};
}

MoveResult StandingMachine::changeTool(const machine::ToolOrder& order) {
  if (released_) return machine_.changeTool(order);
  tool_ = order;
  for (std::size_t i = 0; i < description().axes.size(); ++i) {
    if (description().axes[i].kind == machine::AxisKind::Linear) at_[i] = description().toolChange[i];
  }
  return {};
}

void StandingMachine::dwell(double seconds) {
  if (released_) machine_.dwell(seconds);
}

}  // namespace probewright::session
