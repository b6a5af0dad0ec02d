#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "setup/setup.hpp"

namespace probewright::setup {

/// Whether `tables` of a setup may name this folder although it is not there: one that the run is to make.
using MayBeMissing = std::function<bool(const std::filesystem::path& folder)>;

/// As readSetup(), on another machine than the setup names: that of the machine file or LinuxCNC configuration
/// `machine`; empty: on that of the setup. Where `mayBeMissing` says so of a folder of tables that is not there, the
/// control begins without tables, with a note.
std::optional<Setup> readSetupOn(const std::filesystem::path& machine, const std::filesystem::path& path,
                                 Diagnostics& diagnostics, const MayBeMissing& mayBeMissing = {},
                                 const session::ControlFamilies& families = session::knownFamilies());

}  // namespace probewright::setup
