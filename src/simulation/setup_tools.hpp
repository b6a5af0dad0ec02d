#pragma once

#include "base/toml_table.hpp"
#include "simulation/setup.hpp"

/// The tools of a setup file: what they truly are, and what the control believes of them.
namespace probewright::simulation {

/// Every [[tool]] of `root` into `setup`.
void readTools(TomlReader& root, Setup& setup);

}  // namespace probewright::simulation
