#include "truth/run_truth.hpp"

#include "truth/touched_points.hpp"
#include "truth/true_values.hpp"

namespace probewright::truth {

std::shared_ptr<const records::Truth> truthOf(const session::RunOutcome& outcome,
                                              const simulation::VirtualMachine& machine) {
  auto known = std::make_shared<records::Truth>();
  const std::vector<TouchedCycle> touched = touchedCycles(outcome.journal, machine.truth(), machine.path());
  known->cycles = trueValues(outcome.journal, touched, machine.truth());
  return known;
}

}  // namespace probewright::truth
