#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "machine/description.hpp"
#include "records/job.hpp"

namespace probewright::records {

/// How a run ended; the number is the exit code of the program.
enum class ExitState { Good = 0, OutOfTolerance = 1, InputMistake = 2, Stopped = 3, Internal = 4 };

/// One text of the program as it was read: the main program or a subprogram it called.
struct ProgramSource {
  std::string path;
  std::string text;  ///< bytes of the file, whatever their encoding
};

struct Truth;

/// What a reader of the results needs to know about a run besides its journal.
struct RunInfo {
  std::vector<ProgramSource> programs;  ///< main program first, then the subprograms; may be without texts
  std::string language;                 ///< "Klartext", "SINUMERIK"
  std::string control;                  ///< "TNC640", "iTNC530", "840Dsl"
  std::string machine;                  ///< the machine's name
  std::vector<machine::Axis> axes;      ///< of the machine, in the order of AxisPositions; names the latched positions
  std::string setupPath;
  std::string partName;
  std::string partPath;  ///< the CAD file; empty for a part built from the setup
  Job job;
  std::optional<std::uint64_t> seed;     ///< of the random effects; nothing if there were none
  std::vector<int> skipLevels;           ///< levels of block skip that were on, 0 to 9
  std::string version;                   ///< of Probewright
  std::string startedAt;                 ///< wall clock, ISO 8601 with offset; empty: not recorded
  bool inches = false;                   ///< the main program counts in inches
  double totalSeconds = 0;               ///< machine clock at the end of the run
  double totalPathLength = 0;            ///< mm travelled by the tool in the whole run
  std::vector<std::string> outputFiles;  ///< tables and logs left by the control, relative to the output folder
  ExitState exit = ExitState::Good;
  std::string exitText;  ///< why it ended so, one sentence; empty when there is nothing to say
  /// Results whose uncertainty is not trustworthy, by the places of cycle and result: first order is wrong by more than
  /// 5 %.
  std::set<std::pair<std::size_t, std::size_t>> doubtfulUncertainties;
  std::shared_ptr<const Truth> truth;  ///< what was planted; null: nobody knows it, or it is not to be told
};

}  // namespace probewright::records
