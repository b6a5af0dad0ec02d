#pragma once

#include <optional>
#include <string>

namespace probewright::machine {

/// A machine file as it is written.
struct MachineText {
  std::string text;
  std::string file;  ///< for messages; relative paths in it count from its folder
};

/// The TOML of the machine that readMachine() reads; nothing of a LinuxCNC configuration, or if there is none.
std::optional<MachineText> machineText(const std::string& nameOrPath);

}  // namespace probewright::machine
