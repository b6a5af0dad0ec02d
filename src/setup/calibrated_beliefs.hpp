#pragma once

#include <vector>

#include "control/beliefs.hpp"
#include "simulation/world.hpp"

/// What a control believes where the setup is silent: what is true, as if every tool had just been measured and the
/// probe calibrated without an error. Here, and nowhere else, a belief is made from the truth.
namespace probewright::setup {

/// The tool as calibration would find it when the probe measures at the believed feed. A probe's effective length and
/// radius are shorter by pretravel and signal delay; its tip offset is the true one, at spindle angle 0.
void believeAsCalibrated(control::BelievedTool& believed, const simulation::TrueTool& tool);

/// What else depends on a probe's believed values, whoever gave them: the radius along the stylus, and whether the ball
/// counts as the end of an arm: further off the spindle axis than twice ball and shaft together, as where the true
/// stylus is made.
void believeShape(control::BelievedTool& believed, const simulation::TrueProbe& probe);

/// The tool touch probes as they were fitted at the start posture, and calibrated.
std::vector<control::BelievedToolProbe> believedToolProbes(const simulation::World& world);

/// The Hirth couplings of axes of which the setup does not say what the control believes.
void believeHirthCouplings(control::Beliefs& beliefs, const simulation::Truth& truth);

/// A machine without an axis Y is a lathe.
control::Technology believedTechnology(const machine::MachineDescription& machine);

}  // namespace probewright::setup
