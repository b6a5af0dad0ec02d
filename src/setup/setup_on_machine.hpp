#pragma once

#include "setup/setup.hpp"

namespace probewright::setup {

/// As readSetup(), on another machine than the setup names: that of the machine file or LinuxCNC configuration
/// `machine`; empty: on that of the setup.
std::optional<Setup> readSetupOn(const std::filesystem::path& machine, const std::filesystem::path& path,
                                 Diagnostics& diagnostics,
                                 const session::ControlFamilies& families = session::knownFamilies());

}  // namespace probewright::setup
