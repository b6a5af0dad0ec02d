#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"

/// The folder that a run leaves its files in, and what an earlier run left there.
namespace probewright::app {

/// What an earlier run of Probewright left in a folder: the files that its results.json lists and that are still
/// there. Nothing if there is no results.json of Probewright.
std::vector<std::filesystem::path> leftByEarlierRun(const std::filesystem::path& folder);

/// Writes the files of a run by their names in the folder, all of them or none, and removes what an earlier run left
/// there besides. Makes the folder.
Result<void> writeOutput(const std::filesystem::path& folder, const std::map<std::string, std::string>& files);

/// A run came to nothing: takes results.json and report.html of an earlier run away, so that nobody reads them as this
/// run's, and with them the tables and logs it left, unless they lie in `tables`, the folder that runs begin from.
void removeEarlierRun(const std::filesystem::path& folder, const std::filesystem::path& tables);

/// The same, but tables and logs stay.
void removeEarlierVerdict(const std::filesystem::path& folder);

}  // namespace probewright::app
