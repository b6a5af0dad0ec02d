#pragma once

#include "cycles/heidenhain/context.hpp"

/// How cycles 480, 484 and 30 calibrate the tool touch probe TT with an exact cylindrical tool.
namespace probewright::cycles::heidenhain {

/// `middle`: about where the middle of the contact's upper edge is, machine coordinates. `clearanceHeight`: machine
/// coordinate along the tool axis. Finds the contact's upper edge, middle and effective widths, and how far the tool
/// runs out, and keeps them. Throws Alarm.
void calibrateToolProbe(Context& context, const PartInMachine& middle, double clearanceHeight);

/// The same where centerPos (MP6580) says that the tool touch probe is; `clearanceHeight` in program coordinates.
void calibrateFittedToolProbe(Context& context, double clearanceHeight);

/// Refuses what cannot calibrate: no tool, a touch probe, a tool without length or radius.
void requireCalibratingTool(Context& context);

}  // namespace probewright::cycles::heidenhain
