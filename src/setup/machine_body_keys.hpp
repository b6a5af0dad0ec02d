#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/toml_table.hpp"
#include "machine/description.hpp"
#include "simulation/world.hpp"

/// The bodies that a machine is built of: [[body]] of a machine file, [[machine.body]] of a setup.
namespace probewright::setup {

/// `file` of a part, a fixture or a body; nothing if it has none. Relative paths count from `folder`.
std::optional<std::filesystem::path> readShapeFile(TomlReader& reader, const std::filesystem::path& folder);

/// [[body]] of `owner`, added to `bodies`; the files that they name are added to `inputs`.
void readBodies(TomlReader& owner, const machine::MachineDescription& machine, const std::filesystem::path& folder,
                std::vector<simulation::WorldBody>& bodies, std::vector<std::filesystem::path>& inputs);

/// Those of the machine that machine::readMachine() reads, which has no mistakes of its own.
void readBodiesOf(const std::string& nameOrPath, const machine::MachineDescription& machine, Diagnostics& diagnostics,
                  std::vector<simulation::WorldBody>& bodies, std::vector<std::filesystem::path>& inputs);

}  // namespace probewright::setup
