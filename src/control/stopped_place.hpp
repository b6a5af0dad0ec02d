#pragma once

#include <fmt/format.h>

#include <string>

#include "control/channel.hpp"

namespace probewright::control {

/// "tool tip stopped at X+1.000 Y+2.000 Z+3.000 of the active workpiece system": the numbers that the person at the
/// control can look at.
inline std::string stoppedPlace(const Channel& channel) {
  const Vector3 tip = channel.position();
  return fmt::format("tool tip stopped at X{:+.3f}{} Y{:+.3f} Z{:+.3f} of the active workpiece system", tip.x(),
                     channel.description().mainSpindle ? " (radius)" : "", tip.y(), tip.z());
}

}  // namespace probewright::control
