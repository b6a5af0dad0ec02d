#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"

namespace probewright {

/// The whole file as bytes.
Result<std::string> readFile(const std::filesystem::path& path);

/// Writes the file whole or not at all: writes a neighbour, flushes it to disk, renames it over `path`. A crash at any
/// instant leaves the old file or the new one. Creates missing folders.
Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// Writes files that belong together: all of them aside and flushed first, then renamed, in their order. If any cannot
/// be written, none is.
Result<void> writeFilesTogether(const std::vector<std::pair<std::filesystem::path, std::string_view>>& files);

}  // namespace probewright
