#pragma once

#include <array>
#include <optional>

#include "cycles/sinumerik/lathe_tool_touches.hpp"

/// What a call of CYCLE982 asks for, and what measuring finds.
namespace probewright::cycles::sinumerik {

/// The units of S_MVAR, and its thousands.
enum class LatheTask { Calibrate, AlongAxis, Complete };
enum class LatheQuantities { Length, Radius, LengthAndRadius, RearSide };

struct LatheVariant {
  LatheTask task = LatheTask::Calibrate;
  LatheQuantities quantities = LatheQuantities::Length;
  bool reversal = false;     ///< of a mill
  bool radial = false;       ///< the mill or drill lies along the 2nd axis of the plane
  bool incremental = false;  ///< from where the tool is
  bool positions = false;    ///< the spindle goes to S_STA1 first
};

/// What was found, beside where the data have it.
struct LatheFindings {
  std::array<std::optional<double>, 2> tip;  ///< the tip is believed so far in plus of where it is, mm
  std::optional<double> radius;              ///< larger than believed, mm
};

/// S_MD, or where the middle of the contact lies: +1, -1. Alarm 61326.
double directionOf(Context& context, const LatheToolTouches& touches, int axis);

/// Mills and drills along the axis S_MA: length, radius or both. Alarms 61325,
/// 61326, 61332, 61351.
LatheFindings measureRotatedToolAlongAxis(Context& context, const LatheVariant& variant, const LatheTool& tool,
                                          LatheToolTouches& touches);

/// Both lengths and the radius of a mill, the lengths alone if its radius is
/// entered as 0. The tool ends where it began.
LatheFindings measureMillCompletely(Context& context, const LatheVariant& variant, const LatheTool& tool,
                                    LatheToolTouches& touches);

}  // namespace probewright::cycles::sinumerik
