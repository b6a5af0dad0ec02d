#pragma once

#include <bitset>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "language/program.hpp"
#include "simulation/setup.hpp"

namespace probewright::session {

/// What a program names and the control of this setup does not have: tools that are called or corrected, rows of the
/// preset table that are activated. Only what the text says; names and numbers that the run computes are left to it.
/// Mistakes in the tables that the setup names are told too.
Diagnostics checkAgainstSetup(language::Program& program, control::ControlKind kind, const simulation::Setup& setup,
                              std::bitset<10> skipLevels = {});

}  // namespace probewright::session
