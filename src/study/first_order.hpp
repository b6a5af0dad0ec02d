#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "control/journal.hpp"
#include "simulation/truth.hpp"

/// Uncertainties of single results at no cost of trials: the scatter of the probe, carried on by the law of propagation
/// of uncertainty (JCGM 100:2008, 5.1), to first order.
namespace probewright::study {

struct FirstOrder {
  std::size_t given = 0;     ///< results that have got their uncertainty
  std::size_t withheld = 0;  ///< measured values whose dependence on the touches is not known here
  /// Of those given, results for which first order is wrong by more than 5 %: places of cycle and result.
  std::set<std::pair<std::size_t, std::size_t>> doubtful;
  /// What of the setup the uncertainties do not hold, one sentence each: where there is one, they are too small.
  std::vector<std::string> notHeld;
};

/// Enters the expanded uncertainty (k = 2) of measured values and differences into the journal of a run with
/// workpieces: by the cofactors of the cycle's fit, or, where single touches or pairs of opposite ones were evaluated,
/// by their number. What a tool touch probe has measured gets none. The standard uncertainty of a touch is the
/// repeatability of the probe; where probes differ, of the one that repeats worst. Fits are laid again through touches
/// that such errors have moved: a result that these move by another value than first order says, by more than 5 %, is
/// doubtful.
FirstOrder addUncertainties(control::Journal& journal, const simulation::Truth& truth);

/// Lines for a terminal: each main result with its uncertainty, and what that does not hold.
std::string firstOrderText(const control::Journal& journal, const FirstOrder& done);

/// The standard uncertainty of a touch of the probe: its repeatability; of several probes, of the one that repeats
/// worst. 0 if the setup tells none.
double scatterOf(const simulation::Truth& truth);

/// The standard uncertainty of a result for a standard uncertainty of 1 mm of each touch; nothing if it is not known
/// here. Of angles in degrees.
std::optional<double> sensitivityToTouches(const control::CycleRecord& cycle, const control::ResultRecord& result);

}  // namespace probewright::study
