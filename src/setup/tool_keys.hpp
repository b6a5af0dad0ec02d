#pragma once

#include "base/toml_table.hpp"
#include "control/beliefs.hpp"
#include "simulation/world.hpp"

/// The tools of a setup file: [[tool]] tells of each what it truly is and, by keys of their own, what the control
/// believes of it.
namespace probewright::setup {

/// Every [[tool]] of `root` into `world` and `beliefs`.
void readTools(TomlReader& root, simulation::World& world, control::Beliefs& beliefs);

}  // namespace probewright::setup
