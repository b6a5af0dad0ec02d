#include "survival/watched_machine.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::survival {

using machine::AxisPositions;
using machine::MeasureEnd;
using machine::MoveEnd;

double wayOf(const machine::MachineDescription& machine, const AxisPositions& from, const AxisPositions& to) {
  double sum = 0;
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    if (machine.axes[i].kind == machine::AxisKind::Linear) sum += (to[i] - from[i]) * (to[i] - from[i]);
  }
  return std::sqrt(sum);
}

Step WatchedMachine::begin(StepKind kind) const {
  Step step;
  step.kind = kind;
  step.from = machine_.position();
  step.seconds = machine_.seconds();
  return step;
}

void WatchedMachine::end(Step step) {
  step.end = machine_.position();
  step.tool = machine_.path().points.back().tool;
  step.spindleDegrees = machine_.spindle().angle;
  if (step.kind == StepKind::Turn || step.kind == StepKind::ToolChange) step.to = step.end;
  steps_.push_back(step);
}

machine::MoveResult WatchedMachine::move(const AxisPositions& target, machine::Feed feed) {
  Step step = begin(StepKind::Move);
  step.to = target;
  step.feed = feed;
  auto result = machine_.move(target, feed);
  end(step);
  return result;
}

machine::PathResult WatchedMachine::moveAlong(std::span<const machine::PathPiece> path) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    machine::MoveResult piece = move(path[i].target, path[i].feed);
    if (piece.end != MoveEnd::Reached) return {piece.end, i, std::move(piece.detail)};
  }
  return {MoveEnd::Reached, path.size(), {}};
}

machine::MeasureResult WatchedMachine::measure(const machine::MeasureOrder& order) {
  Step step = begin(StepKind::Measure);
  step.to = order.target;
  step.feed = order.feed;
  step.part = order.part;
  step.sensor = order.sensor;
  machine::MeasureResult result;
  if (plan_ == nullptr) {
    result = machine_.measure(order);
  } else if (touches_ < plan_->size()) {
    const PlannedTouch& planned = (*plan_)[touches_];
    const double way = wayOf(description(), step.from, step.to);
    const auto at = [&](double along) {
      AxisPositions place = step.from;
      const double fraction = way > 0 ? std::clamp(along / way, 0.0, 1.0) : 0.0;
      for (std::size_t i = 0; i < description().axes.size(); ++i)
        place[i] += (step.to[i] - step.from[i]) * fraction;
      return place;
    };
    const machine::MoveResult moved = machine_.move(at(planned.signal + planned.overtravel), order.feed);
    result.end = moved.end == MoveEnd::Reached     ? MeasureEnd::Touched
                 : moved.end == MoveEnd::AxisLimit ? MeasureEnd::AxisLimit
                 : moved.end == MoveEnd::Cancelled ? MeasureEnd::Cancelled
                                                   : MeasureEnd::Refused;
    result.detail = moved.detail;
    result.latched = at(planned.signal);
  } else {
    const machine::MoveResult moved = machine_.move(order.target, order.feed);
    result.end = moved.end == MoveEnd::Cancelled ? MeasureEnd::Cancelled : MeasureEnd::NoContact;
  }
  step.touched = result.end == MeasureEnd::Touched;
  if (step.touched) {
    ++touches_;
    step.latched = result.latched;
  }
  end(step);
  return result;
}

machine::MoveResult WatchedMachine::retract(const AxisPositions& target, machine::Feed feed) {
  Step step = begin(StepKind::Retract);
  step.to = target;
  step.feed = feed;
  auto result = machine_.retract(target, feed);
  end(step);
  return result;
}

machine::MoveResult WatchedMachine::turnSpindle(machine::Rotation rotation, double speed) {
  return machine_.turnSpindle(rotation, speed);
}

machine::MoveResult WatchedMachine::orientSpindle(double degrees) {
  const Step step = begin(StepKind::Turn);
  auto result = machine_.orientSpindle(degrees);
  end(step);
  return result;
}

machine::ToolChangeResult WatchedMachine::changeTool(const machine::ToolOrder& order) {
  const Step step = begin(StepKind::ToolChange);
  auto result = machine_.changeTool(order);
  end(step);
  return result;
}

}  // namespace probewright::survival
