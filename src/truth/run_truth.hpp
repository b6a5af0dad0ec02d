#pragma once

#include <memory>

#include "records/truth.hpp"
#include "session/run.hpp"
#include "simulation/virtual_machine.hpp"

namespace probewright::truth {

/// What the control was told before the run.
struct Told {
  const control::Beliefs& beliefs;
  const control::Beliefs& calibrated;  ///< the same, if tools and probes had just been measured without an error
  bool clearance = false;              ///< also asked for: how near the tool came to things
  double clearanceLimit = 0;           ///< mm; 0: none
};

/// What the machine knows of a run on it. The machine must have recorded its path.
std::shared_ptr<const records::Truth> truthOf(const session::RunOutcome& outcome,
                                              const simulation::VirtualMachine& machine, const Told& told);

}  // namespace probewright::truth
