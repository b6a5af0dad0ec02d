#pragma once

#include <optional>
#include <string>

#include "cycles/heidenhain/context.hpp"

/// Q330 of the inspection cycles: the tool that made what was measured. Source: inspection fundamentals, section 8.
namespace probewright::cycles::heidenhain {

/// What a measurement tells about the tool, mm.
struct ToolMonitoring {
  double monitored = 0;  ///< the deviation that breakage is judged by
  double excess = 0;     ///< material left per side
  bool length = false;   ///< the tool's length is corrected instead of its radius
  bool correct = true;   ///< false: breakage only
  /// How far the surface lies from where it should, away from the turning axis or, with `length`, along the tool axis.
  /// Nothing: the cycle does not know turning tools.
  std::optional<double> turned = std::nullopt;
};

/// The row of TOOL.T that Q330 means, by number (5, 5.1) or name; empty if monitoring is off. Throws Alarm if there is
/// no such tool.
std::string monitoredToolRow(Context& context);

/// Refuses, before anything is touched, a tool in Q330 that is in no table, or a turning tool that the cycle cannot
/// correct: cycles without Q498 and Q531 know none, the others need both.
void requireMonitoredTool(Context& context);

/// Corrects the tool of Q330 or, if the deviation says that it broke, locks it and throws Alarm. A mill is corrected in
/// DR or DL; breakage is RBREAK. A turning tool (TYP is TURN) is corrected in DZL and DXL of TOOLTURN.TRN, breakage is
/// LBREAK of TOOL.T: its tip truly lies where the surface is, so the deviation, turned into the tool's axes by Q531 and
/// Q498, is what the lengths lack. DXL grows along the tool's X, DZL shrinks along its Z, as DL of a mill does.
void monitorTool(Context& context, const ToolMonitoring& monitoring);

}  // namespace probewright::cycles::heidenhain
