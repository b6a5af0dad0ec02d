#pragma once

#include <vector>

#include "control/journal.hpp"
#include "records/truth.hpp"
#include "truth/touched_points.hpp"

/// True values beside results.
namespace probewright::truth {

/// Of each cycle, what was planted at the features that it touched. A result has a true value where one way from the
/// touches to its value explains it (to 0.02 mm or 0.005 degrees); what is a parameter, or computed from other things,
/// has none.
std::vector<records::CycleTruth> trueValues(const control::Journal& journal, const std::vector<TouchedCycle>& touched,
                                            const simulation::Truth& truth);

}  // namespace probewright::truth
