#pragma once

#include "base/toml_table.hpp"
#include "geometry/primitives.hpp"
#include "simulation/solid_recipe.hpp"

/// The parts of a setup file that describe shapes and where they lie.
namespace probewright::setup {

/// Lengths and places in setups, mm: nothing is longer or further away than 100 m.
inline constexpr double longest = 1e5;
inline constexpr double shortest = 1e-3;
inline constexpr NumberRange anyLength{shortest, longest};
inline constexpr NumberRange anyLengthOrNone{0, longest};
inline constexpr NumberRange anyPlace = NumberRange::within(longest);
inline constexpr NumberRange anyAngle = NumberRange::within(360);

std::optional<Vector3> readVector(TomlReader& reader, std::string_view key, NumberRange range = anyPlace);
std::optional<Vector2> readVector2(TomlReader& reader, std::string_view key, NumberRange range = anyPlace);

/// [pose] of `owner`: x, y, z and the rotation a about X, then b about Y, then c about Z of the table.
Pose readPose(TomlReader& owner);

/// The pose of these numbers, mm and degrees.
Pose poseOf(const Vector3& origin, double a, double b, double c);

/// [[feature]] of `owner`; each shape knows its own keys only.
simulation::SolidRecipe readRecipe(TomlReader& owner);

}  // namespace probewright::setup
