#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/diagnostic.hpp"
#include "reports/machine_scene.hpp"
#include "simulation/path_record.hpp"
#include "simulation/truth.hpp"

namespace probewright::setup {

/// The machine of a world with its bodies and its own table; nothing of what lies on the table.
reports::MachineScene machineSceneOf(const simulation::Truth& truth);

/// The same with what its axes have done; null if it has no bodies.
std::shared_ptr<const reports::MachineReplay> machineReplayOf(const simulation::Truth& truth,
                                                              const simulation::PathRecord& path);

/// A machine file read on its own.
struct MachineWorld {
  simulation::Truth truth;  ///< with its bodies and its table
  Diagnostics remarks;      ///< warnings: where ISO 841 has it otherwise
};
/// The machine that machine::readMachine() reads, built with its bodies. Mistakes go to `diagnostics`; nothing is
/// returned if there are any.
std::optional<MachineWorld> readMachineWorld(const std::string& nameOrPath, Diagnostics& diagnostics);

}  // namespace probewright::setup
