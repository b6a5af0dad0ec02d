#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "machine/description.hpp"

/// Machines as TOML files; docs/machine-files.md describes every key.
namespace probewright::machine {

/// The machine that `text` describes. Mistakes go to `diagnostics`, each with its place in `file`; nothing is returned
/// if there are any.
std::optional<MachineDescription> parseMachine(std::string_view text, const std::string& file,
                                               Diagnostics& diagnostics);

/// The ready-made machine called `nameOrPath` or the one in that file, which is TOML or, if its name ends in .ini, a
/// LinuxCNC configuration. Mistakes go to `diagnostics`, and warnings of what had to be assumed; a mistake without a
/// place is not of the file: there is no such machine.
std::optional<MachineDescription> readMachine(const std::string& nameOrPath, Diagnostics& diagnostics);
/// The same; the first mistake, if there are any.
Result<MachineDescription> readMachine(const std::string& nameOrPath);

/// The names of the ready-made machines: "mill3", "mill4-table", "mill5-table-table", "mill5-head-table",
/// "mill5-head-head", "lathe2c". They are part of the program and need no file.
std::vector<std::string> readyMadeMachines();

}  // namespace probewright::machine
