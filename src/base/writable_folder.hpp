#pragma once

#include <filesystem>

#include "base/diagnostic.hpp"

namespace probewright {

/// Fails, with the reason, if no files can be left in this folder. It may be missing, and folders above it as well:
/// then whether it can be made counts. Makes nothing. What changes later, such as a disk that fills, nobody knows here.
Result<void> checkWritable(const std::filesystem::path& folder);

}  // namespace probewright
