#pragma once

#include "base/toml_table.hpp"
#include "simulation/solid_recipe.hpp"
#include "simulation/tool_touch_probe.hpp"

/// The tool touch probes of a setup file.
namespace probewright::setup {

struct SetupToolProbe {
  simulation::TrueToolProbe probe;
  simulation::SolidRecipe recipe;  ///< of the same contact, to be drawn and to be run into
};

/// One [tool_probe].
SetupToolProbe readToolProbe(TomlReader& reader);

}  // namespace probewright::setup
