#pragma once

#include <filesystem>

#include "base/diagnostic.hpp"
#include "exchange/inspection.hpp"

namespace probewright::app {

/// Before anything is run: fails if values cannot be added to this record, which need not be there yet. Makes nothing.
Result<void> checkRecord(const std::filesystem::path& file);

/// Adds the measured values of a run to the record of many runs (exchange::recordWith), which it makes if there is
/// none. Two runs at once wait for one another; whatever happens, the file holds whole runs.
Result<void> appendToRecord(const std::filesystem::path& file, const exchange::Inspection& inspection);

}  // namespace probewright::app
