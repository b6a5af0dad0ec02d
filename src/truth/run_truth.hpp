#pragma once

#include <memory>

#include "records/truth.hpp"
#include "session/run.hpp"
#include "simulation/virtual_machine.hpp"

namespace probewright::truth {

/// What the machine knows of a run on it. The machine must have recorded its path.
std::shared_ptr<const records::Truth> truthOf(const session::RunOutcome& outcome,
                                              const simulation::VirtualMachine& machine);

}  // namespace probewright::truth
