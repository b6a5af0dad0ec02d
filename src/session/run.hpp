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
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/beliefs.hpp"
#include "control/control_kind.hpp"
#include "control/journal.hpp"
#include "control/operator_panel.hpp"
#include "execution/interpreter.hpp"
#include "machine/machine.hpp"
#include "records/run_info.hpp"
#include "records/run_trace.hpp"

/// A program on a control that has beliefs and a machine. What the machine is, and what is true of it, is not known
/// here.
namespace probewright::session {

class ControlFamilies;
class HostFiles;

/// Program influences of the operating area, of families that have them.
enum class ProgramMode {
  Normal,
  DryRun,       ///< DRY: paths at the dry run feed; measuring cycles are skipped
  ProgramTest,  ///< PRT: the axes stand; measuring cycles are skipped
};

/// How a run is to go on; the defaults are those of the command line.
struct RunOptions {
  std::optional<control::ControlKind> control;  ///< without it: the setup's, or what the program tells
  const ControlFamilies* families = nullptr;    ///< that the control is one of; null: knownFamilies()
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
  std::stop_token stop;
  /// Levels of block skip that the operator has switched on; HEIDENHAIN controls have level 0 only.
  std::bitset<10> skipLevels;
  std::int64_t wallClock = 0;  ///< seconds since 1970 (UTC) when the program starts, for logs
  ProgramMode mode = ProgramMode::Normal;
  /// SINUMERIK: block search with calculation; HEIDENHAIN: mid-program startup. The axes stand and measuring cycles are
  /// skipped up to this line of the main program; there they go to where the program stands (HEIDENHAIN: the axis along
  /// the tool up before the others, down after them), and the program goes on.
  std::optional<std::uint64_t> searchLine;
  control::DialogLanguage language = control::DialogLanguage::English;  ///< of logs and screens
  std::vector<std::string> measuringLogs;  ///< SINUMERIK: logs of all measurements; a table if the name ends in .csv
  bool showAllResults = false;             ///< screens of results even where nothing asks for them
  bool trace = false;                      ///< record where the program stands, for a replay
  bool files = true;                       ///< leave the control's tables and logs in the outcome
  /// Told from time to time how many blocks have been carried out.
  std::function<void(std::uint64_t blocks)> progress;
};

/// What a run leaves behind of program and control.
struct RunOutcome {
  control::ControlKind control = control::ControlKind::TNC640;
  control::Journal journal;
  records::RunInfo info;        ///< without version, output files, and what only the builder of the machine knows
  execution::RunResult result;  ///< how the interpreter ended
  Diagnostics diagnostics;      ///< mistakes found before the program could start
  std::map<std::string, std::string> files;   ///< what the control wrote: tables as changed, logs; by name
  std::vector<std::filesystem::path> inputs;  ///< what the program read and called
  /// Machine coordinates (which are the table's at the start posture) from the workpiece system at the end.
  std::optional<Pose> machineFromWorkpiece;
  double ballRadius = 0;
  /// The machine as the control computes with it at the end; nothing if the program did not begin.
  std::optional<machine::MachineDescription> believedMachine;
  records::RunTrace trace;  ///< empty if RunOptions::trace was not asked for
  /// The number that a variable of the control has at the end, by the name that programs write: "Q151", "R5". NaN for
  /// names of nothing. Null if the program did not begin.
  std::function<double(std::string_view name)> variable;
};

/// A program that is opened and read through for mistakes, for the control that it is for. It runs once, as long as
/// beliefs and options live.
struct PreparedProgram {
  const control::Beliefs* beliefs = nullptr;
  const RunOptions* options = nullptr;
  std::filesystem::path path;  ///< of a program in memory its name
  std::string text;
  std::optional<control::ControlKind> control;  ///< nothing if it could not be opened
  Diagnostics diagnostics;                      ///< with errors it does not run
  std::optional<Diagnostic> note;               ///< what a reader of its mistakes should know
  std::function<void(machine::Machine& machine, HostFiles& files, RunOutcome& outcome)> runOn;
};

PreparedProgram prepareProgram(const std::filesystem::path& program, const control::Beliefs& beliefs,
                               const RunOptions& options);
/// The same with a program in memory; `name` names it in messages, programs that it calls are looked for in its folder.
PreparedProgram prepareText(const std::string& name, std::string text, const control::Beliefs& beliefs,
                            const RunOptions& options);

/// Runs it. Everything that can go wrong is in the outcome; info.exit says what kind of end it was.
RunOutcome run(PreparedProgram prepared, machine::Machine& machine);

/// The outcome of a program that does not run because of its diagnostics: before there is a machine.
RunOutcome notRun(PreparedProgram prepared);

/// Both steps, for a machine that is there already.
RunOutcome run(const std::filesystem::path& program, const control::Beliefs& beliefs, machine::Machine& machine,
               const RunOptions& options);
RunOutcome runText(const std::string& name, std::string text, const control::Beliefs& beliefs,
                   machine::Machine& machine, const RunOptions& options);

}  // namespace probewright::session
