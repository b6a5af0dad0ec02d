#pragma once

#include <string>

#include "base/diagnostic.hpp"
#include "simulation/virtual_machine.hpp"

namespace probewright::setup {

/// What parts, fixtures and bodies of the machine lack: something may enter where a triangle or a face is missing.
/// `file`: that names them.
void warnOfSolids(const simulation::Truth& truth, const std::string& file, Diagnostics& diagnostics);

/// What bodies of the machine touch where it starts.
void warnOfBodies(const simulation::VirtualMachine& machine, const std::string& file, Diagnostics& diagnostics);

}  // namespace probewright::setup
