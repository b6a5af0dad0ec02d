#pragma once

#include <optional>

#include "base/toml_table.hpp"
#include "camera/true_camera.hpp"
#include "simulation/world.hpp"

namespace probewright::setup {

/// [camera] of a setup file; nothing if there is none. `world` has the machine, whose axes stand in its overview
/// position, and the solids that surfaces may name.
std::optional<camera::TrueCamera> readCamera(TomlReader& root, const simulation::World& world);

}  // namespace probewright::setup
