#include <algorithm>

#include "truth/entries.hpp"
#include "truth/family_truth.hpp"

namespace probewright::truth {

std::vector<records::EntryTruth> toolEntries(const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                                             const control::Beliefs& calibrated, const simulation::Truth& truth) {
  const FamilyTruth* family = familyTruth(outcome.control);
  // Most runs write nothing of tools; the tables need not be made again for them.
  if (family == nullptr || std::ranges::none_of(writtenValues(outcome.journal), [&](const auto& written) {
        return family->isOfTools(written.first.first);
      }))
    return {};
  return family->tools(outcome, beliefs, calibrated, truth);
}

std::vector<records::EntryTruth> tableEntries(const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                                              const std::vector<TouchedCycle>& touched, const simulation::Truth& truth,
                                              const simulation::PathRecord& path) {
  const FamilyTruth* family = familyTruth(outcome.control);
  if (family == nullptr || family->tables == nullptr) return {};
  return family->tables(outcome, beliefs, touched, truth, path);
}

}  // namespace probewright::truth
