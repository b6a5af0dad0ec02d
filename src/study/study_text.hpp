#pragma once

#include <string>

#include "study/run_study.hpp"

namespace probewright::study {

/// What a study has found, as tables for a terminal: results with their uncertainties, an uncertainty budget of each,
/// conformity, capability, alarms. Of a program with more than `most` main results only the first have budgets.
std::string studyText(const StudyResult& result, std::size_t most = 12);

}  // namespace probewright::study
