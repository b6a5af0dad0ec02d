#pragma once

#include "base/toml_table.hpp"
#include "geometry/primitives.hpp"
#include "simulation/solid_recipe.hpp"

/// The parts of a setup file that describe shapes and where they lie.
namespace probewright::simulation {

std::optional<Vector3> readVector(TomlReader& reader, std::string_view key);
std::optional<Vector2> readVector2(TomlReader& reader, std::string_view key);

/// [pose] of `owner`: x, y, z and the rotation a about X, then b about Y, then c about Z of the table.
Pose readPose(TomlReader& owner);

/// [[feature]] of `owner`; each shape knows its own keys only.
SolidRecipe readRecipe(TomlReader& owner);

}  // namespace probewright::simulation
