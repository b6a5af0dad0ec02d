#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/file.hpp"
#include "base/folder_swap.hpp"

/// The folder that a run leaves its files in. Which of the files there are those of the last run, a list says that lies
/// among them: names and checksums. A file that is not in it, or has changed since, is somebody else's: it is never
/// overwritten and never removed. See docs/output-folder.md.
namespace probewright::app {

/// The name of the list.
inline constexpr const char* listName = ".probewright.json";

/// The files of the last run that are still as it left them.
std::set<std::string> leftByEarlierRun(const std::filesystem::path& folder);

/// Before anything is run: fails if a run could not leave its files there, and clears up what a run has left there that
/// was killed while it wrote. A folder that is missing is not made yet.
Result<void> prepareOutput(const std::filesystem::path& folder, const std::stop_token& stop);

/// Why a run cannot leave a file of this name there: something of this name is not of an earlier run.
std::optional<Diagnostic> whyNotWritable(const std::filesystem::path& folder, const std::string& name);

struct Output {
  std::filesystem::path folder;
  /// In the order to be written; what an earlier run left besides goes.
  std::vector<std::pair<std::string, Content>> files;
  /// What the run has read: not to be replaced, whatever the list says.
  std::set<FileIdentity> inputs;
};

/// Makes the folder, if it is missing, and writes the files of a run in one step: see swapFiles. Says on standard error
/// if it waits for another run.
Result<void> writeOutput(const Output& output, const std::stop_token& stop);

/// A run came to nothing: takes results.json and report.html of an earlier run away, so that nobody reads them as this
/// run's, and with them the tables and logs it left, unless they lie in `tables`, the folder that runs begin from.
/// What the run has read, `inputs`, stays.
Result<void> removeEarlierRun(const std::filesystem::path& folder, const std::filesystem::path& tables,
                              const std::set<FileIdentity>& inputs);

/// The same, but tables and logs stay.
Result<void> removeEarlierVerdict(const std::filesystem::path& folder, const std::set<FileIdentity>& inputs);

}  // namespace probewright::app
