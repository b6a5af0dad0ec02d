#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "machine/machine.hpp"

namespace probewright::testing_support {

/// A machine that answers from a script. It knows no simulation: no part, no true tool, no errors; what a real machine
/// would find out is written down beforehand. A second implementation of machine::Machine, to see that controls need
/// nothing but that.
class ScriptedMachine final : public machine::Machine {
public:
  explicit ScriptedMachine(machine::MachineDescription description) : description_(std::move(description)) {}

  // ---- the script ----

  /// What the next measuring moves find, in their order: where on its way the axis `axis` reads `reading` the sensor
  /// signals; nothing: no signal. Beyond the end of the list there is none either.
  struct Signal {
    std::size_t axis = 0;
    double reading = 0;
  };
  std::deque<std::optional<Signal>> signals;
  /// What happens on a straight line, by its number (each piece of a path counts): how it ends, and after what part of
  /// its way.
  struct Event {
    machine::MoveEnd end = machine::MoveEnd::Collision;
    double fraction = 0.5;
  };
  std::map<std::size_t, Event> events;
  /// The line of this number lasts, half of its way done, until a stop is asked for; `lasting` is told when it does.
  std::optional<std::size_t> endless;
  std::function<void()> lasting;
  std::set<int> magazine = {0, 1, 2};  ///< tools that the changer has
  std::set<int> byHand;                ///< tools that somebody has to put in
  std::optional<std::string> changerRefuses;
  std::set<int> probes = {1};  ///< tools that are touch probes
  bool hasToolTouchProbe = true;
  std::set<int> functions = {7, 8, 9};
  std::string serial = "4711";

  // ---- what it was told ----

  struct Line {
    machine::AxisPositions target;
    machine::Feed feed;
    bool ofPath = false;  ///< with others, without a stop between them
  };
  std::vector<Line> lines;
  std::vector<machine::Sensor> measured;
  std::vector<std::string> orders;  ///< spindle, functions, tools, in words
  std::size_t paths = 0;

  // ---- the machine ----

  const machine::MachineDescription& description() const override { return description_; }
  void stopOn(std::stop_token stop) override { stop_ = std::move(stop); }
  machine::AxisPositions position() const override { return at_; }

  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override {
    if (auto refused = refusal(target, feed)) return *std::move(refused);
    if (sensor_ && !(target == at_)) return {machine::MoveEnd::ProbeSignal, "the sensor is still deflected"};
    return travel(target, feed, false);
  }

  machine::PathResult moveAlong(std::span<const machine::PathPiece> path) override {
    ++paths;
    // This machine looks at the whole path before it begins.
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (auto refused = refusal(path[i].target, path[i].feed)) return {refused->end, 0, std::move(refused->detail)};
    }
    if (sensor_ && !path.empty()) return {machine::MoveEnd::ProbeSignal, 0, "the sensor is still deflected"};
    for (std::size_t i = 0; i < path.size(); ++i) {
      machine::MoveResult piece = travel(path[i].target, path[i].feed, true);
      if (piece.end != machine::MoveEnd::Reached) return {piece.end, i, std::move(piece.detail)};
    }
    return {machine::MoveEnd::Reached, path.size(), {}};
  }

  machine::MeasureResult measure(const machine::MeasureOrder& order) override {
    using machine::MeasureEnd;
    const bool probe = probes.contains(tool_);
    const bool ready = order.sensor == machine::Sensor::TouchProbe ? probe : hasToolTouchProbe && !probe && tool_ != 0;
    if (stop_.stop_requested()) return {MeasureEnd::Cancelled, at_, stopped};
    if (!ready) return {MeasureEnd::NotReady, at_, "no such sensor"};
    if (auto refused = refusal(order.target, order.feed)) {
      return {refused->end == machine::MoveEnd::AxisLimit ? MeasureEnd::AxisLimit : MeasureEnd::Refused, at_,
              std::move(refused->detail)};
    }
    if (sensor_ == order.sensor) return {MeasureEnd::DeflectedAtStart, at_, "the sensor is deflected"};
    measured.push_back(order.sensor);
    std::optional<Signal> signal;
    if (!signals.empty()) {
      signal = signals.front();
      signals.pop_front();
    }
    std::optional<double> fraction;
    if (signal) {
      const double from = at_[signal->axis], way = order.target[signal->axis] - from;
      if (way != 0 && (signal->reading - from) / way > 0 && (signal->reading - from) / way < 1)
        fraction = (signal->reading - from) / way;
    }
    const machine::AxisPositions start = at_;
    const machine::MoveResult way = travel(order.target, order.feed, false, fraction);
    switch (way.end) {
      case machine::MoveEnd::Reached:
        break;
      case machine::MoveEnd::Cancelled:
        return {MeasureEnd::Cancelled, at_, way.detail};
      default:
        return {MeasureEnd::Collision, at_, way.detail};
    }
    if (!fraction) return {MeasureEnd::NoContact, at_, {}};
    const machine::AxisPositions latched = at_;
    // The axes brake beyond the signal.
    at_ = between(start, order.target, std::min(1.0, *fraction + 0.001));
    sensor_ = order.sensor;
    return {MeasureEnd::Touched, latched, {}};
  }

  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override {
    if (auto refused = refusal(target, feed)) return *std::move(refused);
    sensor_.reset();
    return travel(target, feed, false);
  }

  bool deflected(machine::Sensor sensor) const override { return sensor_ == sensor; }
  std::string probeSerial() const override { return probes.contains(tool_) ? serial : std::string(); }

  machine::MoveResult turnSpindle(machine::Rotation rotation, double speed) override {
    const bool stands = rotation == machine::Rotation::None;
    if (!stands && stop_.stop_requested()) return {machine::MoveEnd::Cancelled, stopped};
    if (!stands && !(speed >= 0 && std::isfinite(speed))) return {machine::MoveEnd::Refused, "no such speed"};
    spindle_.rotation = rotation;
    spindle_.speed = stands ? 0 : speed;
    orders.push_back(stands                                     ? "spindle off"
                     : rotation == machine::Rotation::Clockwise ? fmt::format("clockwise {}", speed)
                                                                : fmt::format("counterclockwise {}", speed));
    return {};
  }
  machine::MoveResult orientSpindle(double degrees) override {
    if (stop_.stop_requested()) return {machine::MoveEnd::Cancelled, stopped};
    if (!description_.spindleOrients || !std::isfinite(degrees))
      return {machine::MoveEnd::Refused, "the spindle cannot be oriented"};
    spindle_ = {machine::Rotation::None, 0, degrees};
    clock_ += 0.5;
    return {};
  }
  machine::SpindleState spindle() const override { return spindle_; }
  bool hasFunction(int number) const override { return functions.contains(number); }
  machine::FunctionResult function(int number) override {
    if (!hasFunction(number)) return {machine::FunctionEnd::Unknown, {}};
    if (stop_.stop_requested()) return {machine::FunctionEnd::Cancelled, stopped};
    orders.push_back(fmt::format("M{}", number));
    return {};
  }

  machine::ToolChangeResult changeTool(const machine::ToolOrder& order) override {
    using machine::ToolChangeEnd;
    if (stop_.stop_requested()) return {ToolChangeEnd::Cancelled, stopped};
    if (order.number == tool_) return {};
    const bool isByHand = byHand.contains(order.number);
    if (!isByHand && !magazine.contains(order.number))
      return {ToolChangeEnd::Missing, fmt::format("no pocket holds tool {}", order.number)};
    if (sensor_) return {ToolChangeEnd::ProbeSignal, "the sensor is still deflected"};
    if (changerRefuses) return {ToolChangeEnd::Refused, *changerRefuses};
    for (std::size_t i = 0; i < description_.axes.size(); ++i) {
      if (description_.axes[i].kind == machine::AxisKind::Linear) at_[i] = description_.toolChange[i];
    }
    spindle_.rotation = machine::Rotation::None;
    spindle_.speed = 0;
    if (isByHand && std::exchange(asked_, order.number) != order.number)
      return {ToolChangeEnd::ByHand, "the magazine has no pocket for it"};
    asked_.reset();
    tool_ = order.number;
    orders.push_back(fmt::format("tool {}", tool_));
    return {};
  }

  machine::WaitEnd dwell(double seconds) override {
    if (stop_.stop_requested()) return machine::WaitEnd::Cancelled;
    clock_ += std::max(0.0, seconds);
    return machine::WaitEnd::Over;
  }
  double seconds() const override { return clock_; }

private:
  static constexpr const char* stopped = "stopped";

  std::optional<machine::MoveResult> refusal(const machine::AxisPositions& target, machine::Feed feed) const {
    if (stop_.stop_requested()) return machine::MoveResult{machine::MoveEnd::Cancelled, stopped};
    if (!feed.rapid && !(feed.perMinute > 0)) return machine::MoveResult{machine::MoveEnd::Refused, "no feed"};
    for (std::size_t i = 0; i < description_.axes.size(); ++i) {
      const machine::Axis& axis = description_.axes[i];
      if (!axis.modulo && !(target[i] >= axis.minimum && target[i] <= axis.maximum))
        return machine::MoveResult{machine::MoveEnd::AxisLimit, "software limit of " + axis.name};
    }
    return std::nullopt;
  }

  machine::AxisPositions between(const machine::AxisPositions& from, const machine::AxisPositions& to, double f) const {
    if (f == 1) return to;
    machine::AxisPositions at = from;
    for (std::size_t i = 0; i < description_.axes.size(); ++i)
      at[i] += f * (to[i] - from[i]);
    return at;
  }

  machine::MoveResult travel(const machine::AxisPositions& target, machine::Feed feed, bool ofPath,
                             std::optional<double> signal = {}) {
    if (stop_.stop_requested()) return {machine::MoveEnd::Cancelled, stopped};
    const machine::AxisPositions from = at_;
    const std::size_t number = lines.size();
    lines.push_back({target, feed, ofPath});
    const auto goTo = [&](double fraction) {
      at_ = between(from, target, fraction);
      double square = 0;
      for (std::size_t i = 0; i < description_.axes.size(); ++i)
        square += std::pow(at_[i] - from[i], 2);
      clock_ += std::sqrt(square) / (feed.rapid ? 10000 : feed.perMinute) * 60;
    };
    if (endless == number) {
      goTo(0.5);
      std::mutex mutex;
      std::unique_lock lock(mutex);
      std::condition_variable_any nothing;
      if (lasting) lasting();
      nothing.wait(lock, stop_, [] { return false; });
      return {machine::MoveEnd::Cancelled, stopped};
    }
    if (const auto event = events.find(number); event != events.end()) {
      goTo(event->second.fraction);
      if (event->second.end == machine::MoveEnd::ProbeSignal) {
        sensor_ = probes.contains(tool_) ? machine::Sensor::TouchProbe : machine::Sensor::ToolTouchProbe;
      }
      return {event->second.end, "as the script has it"};
    }
    goTo(signal.value_or(1));
    return {};
  }

  machine::MachineDescription description_;
  std::stop_token stop_;
  machine::AxisPositions at_;
  std::optional<machine::Sensor> sensor_;  ///< that is deflected
  machine::SpindleState spindle_;
  int tool_ = 0;
  std::optional<int> asked_;  ///< the tool that somebody was asked to put in
  double clock_ = 0;
};

}  // namespace probewright::testing_support
