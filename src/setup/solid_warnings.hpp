#pragma once

#include <string>

#include "base/diagnostic.hpp"
#include "simulation/truth.hpp"

namespace probewright::setup {

/// What parts, fixtures and bodies of the machine lack: something may enter where a triangle or a face is missing.
/// `file`: that names them.
void warnOfSolids(const simulation::Truth& truth, const std::string& file, Diagnostics& diagnostics);

}  // namespace probewright::setup
