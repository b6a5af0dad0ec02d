#include "truth/run_truth.hpp"

#include <utility>

#include "truth/clearance.hpp"
#include "truth/diagnosis.hpp"
#include "truth/entries.hpp"
#include "truth/touched_points.hpp"
#include "truth/true_values.hpp"

namespace probewright::truth {

std::shared_ptr<const records::Truth> truthOf(const session::RunOutcome& outcome,
                                              const simulation::VirtualMachine& machine, const Told& told) {
  auto known = std::make_shared<records::Truth>();
  const std::vector<TouchedCycle> touched = touchedCycles(outcome.journal, machine.truth(), machine.path());
  known->cycles = trueValues(outcome.journal, touched, machine.truth());
  known->entries = frameEntries(outcome, touched, known->cycles);
  for (auto& entry : toolEntries(outcome, told.beliefs, told.calibrated, machine.truth()))
    known->entries.push_back(std::move(entry));
  for (auto& entry : kinematicEntries(outcome, machine.truth()))
    known->entries.push_back(std::move(entry));
  for (auto& entry : tableEntries(outcome, told.beliefs, touched, machine.truth(), machine.path()))
    known->entries.push_back(std::move(entry));
  known->diagnoses = diagnoses(outcome, machine);
  if (told.clearance) known->clearance = clearanceOf(outcome, machine, told.clearanceLimit);
  known->travel = travelMargins(machine);
  if (told.clearanceLimit > 0) known->nearEnds = nearEnds(outcome, machine, told.clearanceLimit);
  return known;
}

}  // namespace probewright::truth
