#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "control/journal.hpp"
#include "records/truth.hpp"
#include "study/trial.hpp"

namespace probewright::study {

/// What the journal of a run answers: the measured values, differences and corrections of its cycles, and the numbers
/// that it has left in tables. A result is called by cycle, line and name, "421@23 Q153"; by "#2" where the line has
/// called the cycle a second time; programs other than `mainProgram` by their file first.
struct Observed {
  std::string mainProgram;
  std::string prefix;                       ///< comes before all names
  double scatter = 0;                       ///< standard uncertainty of a touch, mm
  std::vector<records::CycleTruth> truths;  ///< of each cycle; empty: nobody knows them
};
std::vector<Observation> observationsOf(const control::Journal& journal, const Observed& observed);

/// The message without what differs from trial to trial: numbers with a decimal point become "...".
std::string withoutNumbers(std::string_view message);

}  // namespace probewright::study
