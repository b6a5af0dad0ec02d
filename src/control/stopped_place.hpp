#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "base/number_text.hpp"
#include "control/channel.hpp"

/// Places in messages as the person at the control can look at them: in the active workpiece system.
namespace probewright::control {

/// "X+1.000 Y+2.000 Z+3.000 of the active workpiece system", in the unit that the program counts in: "X+0.0394 Y+0.0787
/// Z+0.1181 inch of the active workpiece system".
/// `unit`: mm in the unit of the program; `radius`: X counts from the axis of a lathe's spindle.
inline std::string workpiecePlace(const ProgramPlace& tip, double unit, bool radius) {
  const bool inch = unit != 1;
  // A number of hundreds of digits says no more than its size.
  const auto number = [&](double millimetres) {
    const double value = millimetres / unit;
    return std::abs(value) < 1e9 ? formatSigned(value, inch ? 4 : 3) : fmt::format("{:+.3g}", value);
  };
  return fmt::format("X{}{} Y{} Z{}{} of the active workpiece system", number(tip.x()), radius ? " (radius)" : "",
                     number(tip.y()), number(tip.z()), inch ? " inch" : "");
}

inline std::string workpiecePlace(const Channel& channel, const ProgramPlace& tip) {
  return workpiecePlace(tip, channel.programUnit != nullptr ? *channel.programUnit : 1,
                        channel.description().mainSpindle.has_value());
}

/// "tool tip stopped at X+1.000 Y+2.000 Z+3.000 of the active workpiece system".
inline std::string stoppedPlace(const Channel& channel) {
  return "tool tip stopped at " + workpiecePlace(channel, channel.position());
}

/// "The stylus is deflected before probing begins: ...; the tool tip is at X+1.000 ...": `detail` is what the machine
/// says.
inline std::string deflectedAtStart(const Channel& channel, const std::string& what, const std::string& detail) {
  return fmt::format("{}{}{}; the tool tip is at {}", what, detail.empty() ? "" : ": ", detail,
                     workpiecePlace(channel, channel.position()));
}

/// What a machine says of a target beyond its travel, and where the tool tip would have gone.
inline std::string beyondTravel(const Channel& channel, const std::string& detail,
                                const machine::AxisPositions& target) {
  const ProgramPlace tip = channel.programFromAxes(target);
  if (!tip.vector().allFinite()) return detail;
  return fmt::format("{}; the tool tip would go to {}", detail.empty() ? "The target is beyond the travel" : detail,
                     workpiecePlace(channel, tip));
}

}  // namespace probewright::control
