#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/beliefs.hpp"
#include "control/journal.hpp"
#include "records/truth.hpp"
#include "session/run.hpp"
#include "simulation/truth.hpp"
#include "truth/touched_points.hpp"

/// What was written into tables, against the truth.
namespace probewright::truth {

/// The last value that was written at a place of a table.
struct Written {
  double value = 0;
  std::optional<double> before;
  std::optional<std::size_t> cycle;  ///< that wrote it
};

/// By table and entry, as the journal names them; texts are left out.
using WrittenValues = std::map<std::pair<std::string, std::string>, Written>;
WrittenValues writtenValues(const control::Journal& journal);

/// Presets and zero offsets that cycles wrote. They are as wrong as the measurement that they come from: by the error
/// of the features that were touched, turned into the directions of the machine.
std::vector<records::EntryTruth> frameEntries(const session::RunOutcome& outcome,
                                              const std::vector<TouchedCycle>& touched,
                                              const std::vector<records::CycleTruth>& cycles);

/// Tools and calibration data that were written, against the ones that a perfect measurement would have found.
/// `beliefs`: of the setup; `calibrated`: the same without any error of tools and probes.
std::vector<records::EntryTruth> toolEntries(const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                                             const control::Beliefs& calibrated, const simulation::Truth& truth);

/// Axes of rotation as the control believes them at the end, against the true ones, if anything of them was written.
std::vector<records::EntryTruth> kinematicEntries(const session::RunOutcome& outcome, const simulation::Truth& truth);

/// What else a family compares: the response of a touch probe by direction, the compensation of a machine by the
/// positions of its rotary axes.
std::vector<records::EntryTruth> tableEntries(const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                                              const std::vector<TouchedCycle>& touched, const simulation::Truth& truth,
                                              const simulation::PathRecord& path);

}  // namespace probewright::truth
