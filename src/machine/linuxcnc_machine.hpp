#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/diagnostic.hpp"
#include "machine/description.hpp"

/// The machine that a LinuxCNC configuration drives. docs/linuxcnc.md says what is read of it and what is refused.
namespace probewright::machine {

struct LinuxCncMachine {
  MachineDescription description;             ///< its axes are the joints' letters, in the order X Y Z A B C U V W
  std::vector<std::filesystem::path> inputs;  ///< all files that were read
};

/// Reads `ini` and what belongs to it. What a virtual machine cannot be is a mistake in `diagnostics`, with the way
/// out; what had to be assumed is a warning there. Nothing is returned if there are mistakes.
std::optional<LinuxCncMachine> readLinuxCncMachine(const std::filesystem::path& ini, Diagnostics& diagnostics);

}  // namespace probewright::machine
