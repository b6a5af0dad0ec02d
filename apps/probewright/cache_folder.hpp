#pragma once

#include <filesystem>
#include <string>

namespace probewright::app {

/// The folder that keeps imported parts: `option` where the command line names one, else $PROBEWRIGHT_CACHE, else
/// probewright in $XDG_CACHE_HOME or ~/.cache. "off" in either of the first two, or no home: empty, nothing is kept.
std::filesystem::path cacheFolder(const std::string& option);

}  // namespace probewright::app
