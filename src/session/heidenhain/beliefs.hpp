#pragma once

#include "base/diagnostic.hpp"
#include "control/beliefs.hpp"
#include "control/heidenhain/control.hpp"
#include "control/heidenhain/machine_parameters.hpp"

/// What a HEIDENHAIN control believes when a program starts: its own table files where the beliefs name a folder,
/// otherwise tables made from the beliefs. Mistakes go to `diagnostics`.
namespace probewright::session::heidenhain {

/// TOOL.T, TCHPROBE.TP, PRESET.PR and all datum tables (*.D). A file in the folder of tables comes first; believed
/// tools, probes and presets are entered where the file has no row for them.
control::heidenhain::Tables heidenhainTables(const control::Beliefs& beliefs, control::ControlKind kind,
                                             Diagnostics& diagnostics);

/// The row of the preset table that is active at the start; 0 if none is said to be.
int activePresetRow(const control::Beliefs& beliefs);

/// The machine parameters that the beliefs set: "maxTouchFeed" or "122602", "MP6120"...
control::heidenhain::MachineParameters machineParameters(const control::Beliefs& beliefs, control::ControlKind kind,
                                                         Diagnostics& diagnostics);

}  // namespace probewright::session::heidenhain
