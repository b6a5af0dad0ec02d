#pragma once

#include "cycles/sinumerik/corrections.hpp"

/// What the cycles for turned parts share: diameters, the spindle with the workpiece, results of one measured value.
namespace probewright::cycles::sinumerik {

/// What a program writes for one mm along the measuring axis: 2 with diameter programming (DIAMON), else 1.
double measureOf(const Context& context);

/// Positions the spindle that carries the workpiece: the C axis where the machine has one on that side, otherwise the
/// spindle itself (alarm 61372 if it cannot be positioned).
void turnWorkpiece(Context& context, double degrees);

/// How a measured surface or diameter reflects on the tool. `side` +1 where the surface was touched in plus direction.
/// Lengths follow the axis in which they act, X for measurements in Y.
ToolInfluence influenceOnTurning(const Context& context, int measuringAxis, double side, double measure);

/// Set value, actual value and difference in the results of the measuring axis and of the axis by number.
void reportTurned(Context& context, int axis, double set, double actual, double difference, const Compared& compared);

/// The results of CYCLE974 and CYCLE994.
inline constexpr std::array<ResultDefinition, 12> turnedResults = {{
    {"_OVR[0]", "set value, measuring axis or diameter"},
    {"_OVR[1]", "set value, 1st axis"},
    {"_OVR[2]", "set value, 2nd axis"},
    {"_OVR[3]", "set value, 3rd axis"},
    {"_OVR[4]", "actual value, measuring axis or diameter"},
    {"_OVR[5]", "actual value, 1st axis"},
    {"_OVR[6]", "actual value, 2nd axis"},
    {"_OVR[7]", "actual value, 3rd axis"},
    {"_OVR[16]", "difference, measuring axis or diameter"},
    {"_OVR[17]", "difference, 1st axis"},
    {"_OVR[18]", "difference, 2nd axis"},
    {"_OVR[19]", "difference, 3rd axis"},
}};

}  // namespace probewright::cycles::sinumerik
