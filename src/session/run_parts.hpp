#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/diagnostic.hpp"
#include "base/folder_swap.hpp"
#include "control/operator_panel.hpp"
#include "execution/interpreter.hpp"
#include "session/control_family.hpp"
#include "session/host_files.hpp"
#include "session/run.hpp"

/// What the runs of all control families are made of.
namespace probewright::session {

class TraceRecorder;

/// The limits that `options` set to the interpreter; what belongs to the control alone, its family adds.
execution::InterpreterOptions interpreterOptions(const RunOptions& options);

/// Has the recorder told of each block, if the run is to be traced.
void recordBlocks(execution::InterpreterOptions& interpreter, TraceRecorder& trace, const RunOptions& options);

/// Sets what the panel shows, asks and stops at, and what names a program cannot give to its files: those of `tables`,
/// which every run leaves, and whatever the caller refuses. The panel must not outlive the request's beliefs and
/// options.
void setPanel(control::OperatorPanel& panel, const RunRequest& request, std::set<std::string> tables);

/// A run must be able to leave its tables: better said before it begins than at its end.
void refuseForeign(Diagnostics& diagnostics, const std::set<std::string>& tables, const RunOptions& options);

/// Holds the folder of tables from the check of a program on until the control has its data: another run may be about
/// to replace the tables. When the program runs again, the folder is held anew.
class FirstReading {
public:
  explicit FirstReading(const RunRequest& request) : held_(of(request)) {}

  FolderReading take(const RunRequest& request) {
    if (!held_) return of(request);
    FolderReading taken = std::move(*held_);
    held_.reset();
    return taken;
  }

private:
  static FolderReading of(const RunRequest& request) {
    return FolderReading::of(request.beliefs.tables, request.options.stop);
  }
  std::optional<FolderReading> held_;
};

/// Takes over how far the tool went in which time, and the journal; `counted`: mm of it on which the machine stood. The
/// last that is done with a control.
template <class Control>
void takeRecords(Control& control, RunOutcome& outcome, double counted = 0) {
  outcome.info.totalPathLength = control.channel.pathLength() - counted;
  outcome.info.totalSeconds = control.channel.seconds();
  outcome.journal = std::move(control.journal);
}

}  // namespace probewright::session
