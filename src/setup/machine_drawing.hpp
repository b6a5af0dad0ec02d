#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/diagnostic.hpp"
#include "reports/machine_scene.hpp"
#include "simulation/import_options.hpp"
#include "simulation/path_record.hpp"
#include "simulation/truth.hpp"

namespace probewright::setup {

/// What carries a solid: the table, but of tool touch probes of a lathe the bed.
machine::Link linkOf(const simulation::PlacedSolid& solid, const machine::MachineDescription& machine);

enum class Drawn : std::uint8_t { MachineOnly, WhatLiesOnTheTableToo };
/// The machine of a world with its bodies and its own table.
reports::MachineScene machineSceneOf(const simulation::Truth& truth, Drawn drawn = Drawn::MachineOnly);

/// The same with what its axes have done; null if it has no bodies and no table.
std::shared_ptr<const reports::MachineReplay> machineReplayOf(const simulation::Truth& truth,
                                                              const simulation::PathRecord& path);

/// A machine to be looked at.
struct MachineWorld {
  simulation::Truth truth;  ///< with its bodies, its table and, of a setup, what lies on it
  Diagnostics remarks;      ///< warnings: where ISO 841 has it otherwise
};
/// The machine that machine::readMachine() reads, or that of a setup, built with its bodies. Mistakes go to
/// `diagnostics`; nothing is returned if there are any.
std::optional<MachineWorld> readMachineWorld(const std::string& nameOrPath, Diagnostics& diagnostics,
                                             const simulation::ImportOptions& import = {});

}  // namespace probewright::setup
