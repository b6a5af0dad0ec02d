#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "base/diagnostic.hpp"
#include "control/heidenhain/control.hpp"
#include "control/heidenhain/machine_parameters.hpp"
#include "control/sinumerik/data_store.hpp"
#include "control/sinumerik/init_text.hpp"
#include "simulation/setup.hpp"

namespace probewright::sinumerik {
class GlobalUserData;
}

/// What a control believes when a program starts: its own table files where the setup names a folder, otherwise tables
/// made from the setup. Mistakes go to `diagnostics`.
namespace probewright::session {

/// TOOL.T, TCHPROBE.TP, PRESET.PR and all datum tables (*.D). A file in the setup's folder comes first; tools, probes
/// and presets that the setup describes are entered where the file has no row for them.
control::heidenhain::Tables heidenhainTables(const simulation::Setup& setup, control::ControlKind kind,
                                             Diagnostics& diagnostics);

/// The row of the preset table that is active at the start; 0 if the setup names none.
int activePresetRow(const simulation::Setup& setup);

/// The machine parameters that [parameters] of the setup sets: "maxTouchFeed" or "122602", "MP6120"...
control::heidenhain::MachineParameters machineParameters(const simulation::Setup& setup, control::ControlKind kind,
                                                         Diagnostics& diagnostics);

/// A SINUMERIK control's data: initialization texts (*.INI, *.TOA, *.UFR, *.GUD, *.SEA...) of the setup's folder,
/// tools, calibration data and zero offsets of the setup, machine and setting data of [parameters], and the texts, to
/// be written back.
struct SinumerikData {
  control::sinumerik::DataStore store;
  struct File {
    std::string name;
    control::sinumerik::InitText text;
  };
  std::vector<File> files;
};
/// Lists in them that are longer than a row of their array go on in the next one: `globalData` knows the arrays.
SinumerikData sinumerikData(const simulation::Setup& setup, Diagnostics& diagnostics,
                            const sinumerik::GlobalUserData* globalData = nullptr);

/// The names of all data that a SINUMERIK control of this setup has values for; none for other controls.
std::set<std::string> namesOfData(const simulation::Setup& setup, control::ControlKind kind);

/// Number of the settable zero offset that is active at the start: 0 is G500.
int activeZeroOffset(const simulation::Setup& setup);

}  // namespace probewright::session
