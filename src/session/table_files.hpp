#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"

/// The control's own table files, in a folder that somebody names.
namespace probewright::session {

/// The files of the folder, in alphabetical order; none if `folder` is empty. What has the name of a table and is none
/// is a mistake.
std::vector<std::filesystem::path> tableFiles(const std::filesystem::path& folder, Diagnostics& diagnostics);

/// The text of a file; nothing if it cannot be read, which is a mistake.
std::optional<std::string> contents(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace probewright::session
