#pragma once

#include <vector>

#include "records/truth.hpp"
#include "session/run.hpp"
#include "simulation/virtual_machine.hpp"

/// Why motions were interrupted: what the true world knows and the control does not.
namespace probewright::truth {

/// One for each motion that ended in an alarm, in the order of time, where there is something to say.
std::vector<records::Diagnosis> diagnoses(const session::RunOutcome& outcome,
                                          const simulation::VirtualMachine& machine);

}  // namespace probewright::truth
