#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "control/sinumerik/control.hpp"
#include "execution/names.hpp"
#include "execution/sinumerik/motion.hpp"
#include "language/value.hpp"

namespace probewright::execution::sinumerik {

/// The $ variables of a channel: what the control knows, under the control's names.
///
/// Computed ones ($AA_IW[X], $P_TOOLNO, $P_ACTFRAME, $AC_MEA[1] ...) come from the state; all others are data of the
/// store: tool data, frames, machine and setting data. A datum without value and default reads as 0, with one warning
/// a name.
class SystemVariables {
public:
  SystemVariables(Control& control, MotionState& state, PathMotion& motion)
      : control_(control), state_(state), motion_(motion) {}

  Value read(std::string_view name, std::span<const Value> indices);
  void write(std::string_view name, std::span<const Value> indices, const Value& value);
  /// True if the control has a value under this name.
  bool exists(std::string_view name, std::span<const Value> indices) const;

private:
  std::string machineAxisAt(std::span<const Value> indices, std::string_view name) const;
  std::optional<Value> readState(std::string_view name, std::span<const Value> indices);
  std::optional<Value> readPosition(std::string_view name, std::span<const Value> indices);
  std::optional<Value> readFrame(std::string_view name, std::span<const Value> indices);
  bool writeFrame(std::string_view name, std::span<const Value> indices, const Value& value);
  std::optional<Value> readTool(std::string_view name, std::span<const Value> indices);
  Value datum(std::string_view name, std::span<const Value> indices);
  control::sinumerik::Frame* activeFrame(std::string_view name);
  /// Millimetres in one unit of system variables: G700 converts them, G70 only what is in motions and frames.
  double unit() const { return state_.variableUnit(control_.unit); }

  Control& control_;
  MotionState& state_;
  PathMotion& motion_;
  std::set<std::string, std::less<>> warned_;
};

/// The key of a datum of the store.
control::sinumerik::DataKey dataKey(std::string_view name, std::span<const Value> indices);

}  // namespace probewright::execution::sinumerik
