#pragma once

#include <bitset>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "control/heidenhain/q_parameters.hpp"
#include "control/journal.hpp"
#include "control/operator_panel.hpp"
#include "execution/interpreter.hpp"
#include "records/run_info.hpp"
#include "simulation/setup.hpp"
#include "simulation/virtual_machine.hpp"

/// A program, a world and a control put together: what the command line does, and what tests of cycles go through.
namespace probewright::session {

/// The program influences of a SINUMERIK control's operating area.
enum class ProgramMode {
  Normal,
  DryRun,       ///< DRY: paths at the dry run feed; measuring cycles are skipped
  ProgramTest,  ///< PRT: the axes stand; measuring cycles are skipped
};

/// How a run is to go on; the defaults are those of the command line.
struct RunOptions {
  std::optional<control::ControlKind> control;  ///< without it: the setup's, or what the program tells
  bool strict = false;                          ///< refuse machining cycles that are not simulated
  control::OnStop onStop = control::OnStop::Continue;
  std::function<bool(const std::string& text)> ask;
  /// What a semi-automatic cycle asks for, by the name of the question; they take precedence over those of the setup.
  std::map<std::string, std::string> answers;
  /// Asked what neither the file nor the setup answers.
  std::function<std::optional<std::string>(const control::Question& question)> answer;
  std::uint64_t stepLimit = 50'000'000;
  /// Bytes of memory that events, results, writes and files of a run may take: an endless loop that leaves something
  /// behind ends there; 0: any.
  std::uint64_t recordLimit = std::uint64_t{128} << 20U;
  /// Why the run cannot leave a file of this name, if it cannot.
  std::function<std::optional<Diagnostic>(const std::string& name)> whyNoFile;
  std::vector<language::Breakpoint> breakpoints;
  std::stop_token stop;
  /// Levels of block skip that the operator has switched on; HEIDENHAIN controls have level 0 only.
  std::bitset<10> skipLevels;
  std::int64_t wallClock = 0;  ///< seconds since 1970 (UTC) when the program starts, for logs
  bool recordPath = true;
  /// SINUMERIK only.
  ProgramMode mode = ProgramMode::Normal;
  /// SINUMERIK only: block search with calculation. The axes stand and measuring cycles are skipped up to this line of
  /// the main program; there they go straight to where the program stands, and the program goes on.
  std::optional<std::uint64_t> searchLine;
  control::DialogLanguage language = control::DialogLanguage::English;  ///< of logs and screens
  std::vector<std::string> measuringLogs;  ///< SINUMERIK: logs of all measurements; a table if the name ends in .csv
  bool showAllResults = false;             ///< screens of results even where nothing asks for them
  /// Told from time to time how many blocks have been carried out.
  std::function<void(std::uint64_t blocks)> progress;
  /// How files of parts are imported; `stop` above stops that, too.
  simulation::ImportOptions import;
};

/// What a run leaves behind.
struct RunOutcome {
  control::ControlKind control = control::ControlKind::TNC640;
  control::Journal journal;
  records::RunInfo info;                                ///< without version and output files
  language::RunResult result;                           ///< how the interpreter ended
  Diagnostics diagnostics;                              ///< mistakes found before the program could start
  std::map<std::string, std::string> files;             ///< what the control wrote: tables as changed, logs; by name
  std::vector<std::filesystem::path> inputs;            ///< what the program read and called
  std::unique_ptr<simulation::VirtualMachine> machine;  ///< as it is at the end; null if it could not be built
  /// Machine coordinates (which are the table's at the start posture) from the workpiece system at the end.
  std::optional<Pose> machineFromWorkpiece;
  double ballRadius = 0;
  /// The Q parameters of a HEIDENHAIN control at the end.
  std::optional<control::heidenhain::QParameters> qParameters;
};

/// Reads the program, builds the machine of the setup and the control's beliefs, runs. Everything that can go wrong is
/// in the outcome; info.exit says what kind of end it was.
RunOutcome runProgram(const std::filesystem::path& program, const simulation::Setup& setup, const RunOptions& options);

/// The same with a program in memory; `name` names it in messages, programs that it calls are looked for in its folder.
RunOutcome runText(const std::string& name, std::string text, const simulation::Setup& setup,
                   const RunOptions& options);

}  // namespace probewright::session
