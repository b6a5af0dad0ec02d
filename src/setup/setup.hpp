#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "camera/true_camera.hpp"
#include "control/beliefs.hpp"
#include "records/job.hpp"
#include "session/control_family.hpp"
#include "simulation/world.hpp"

/// A setup: the world a program runs in (the truth) and what the control thinks of it (the beliefs), as one TOML file.
/// docs/setup-format.md describes every key with unit, range and default.
namespace probewright::setup {

/// The two never meet again: the simulation is built from `world`, the control gets `beliefs`.
struct Setup {
  std::vector<std::filesystem::path> inputs;  ///< the files it was read from and those it names, but not the tables
  simulation::World world;
  std::optional<camera::TrueCamera> camera;  ///< of the machine
  control::Beliefs beliefs;
  records::Job job;  ///< for the head of the report
};

/// The setup that `text` describes. Relative paths in it count from the folder of `file`. Mistakes go to `diagnostics`,
/// all of them; nothing is returned if there are any. `families`: of the controls that it may name.
std::optional<Setup> parseSetup(std::string_view text, const std::string& file, Diagnostics& diagnostics,
                                const session::ControlFamilies& families = session::knownFamilies());
std::optional<Setup> readSetup(const std::filesystem::path& path, Diagnostics& diagnostics,
                               const session::ControlFamilies& families = session::knownFamilies());

}  // namespace probewright::setup
