#pragma once

#include <span>
#include <string>

#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/tool_probe_data.hpp"

/// What CYCLE971 and CYCLE982 do alike: which data field they use, how fast they touch, and what becomes of the tool.
namespace probewright::cycles::sinumerik {

/// The tens of S_MVAR.
ProbeSystem systemOf(const Context& context);

/// The data field that S_PRNUM names, as an index; 0 or left out counts as 1. Alarm 61313 beyond the 6th.
int toolProbeIndex(Context& context);

/// The feed of a touch while the tool stands, mm/min: S_VMS; else the one that the field was calibrated with; else that
/// of SD 55628. `calibrating`: the field's own does not count.
enum class Touching { Calibrates, Measures };
double touchingFeed(const Context& context, const ToolProbeField& field, Touching what);

/// What a difference between the measured and the believed tool leads to.
enum class Judgement {
  Corrects,
  Random,   ///< smaller than S_TZL
  WornOut,  ///< larger than S_TDIF
};

/// Measures again, where the machine does so, while one of the differences is beyond S_TSA or S_TDIF. To be called
/// before anything is corrected.
void repeatIfBeyond(Context& context, std::span<const double> differences);

/// Judges a difference, the empirical value taken off: alarm 61303 beyond S_TSA, message 61306 beyond S_TDIF. `what` is
/// measured: "length 1".
Judgement judgeTool(Context& context, double difference, const std::string& what);

/// Corrects the active edge by `difference`, its empirical value taken off. `component`: 0, 1, 2 the lengths 1, 2, 3,
/// and 3 the radius. With 0 in the units of S_KNUM the geometry becomes what was measured, and the wear 0; with 1 the
/// wear takes the difference.
void correctEdge(Context& context, int component, double difference);

/// Length 1, 2, 3 (0, 1, 2) or the radius (3) of the active edge as it is believed: geometry and wear.
double believedComponent(const Context& context, int component);

/// _OVR[27] to _OVR[30], _OVI[0], _OVI[7], _OVI[8]: limits, edge and tool.
void noteTool(Context& context);

}  // namespace probewright::cycles::sinumerik
