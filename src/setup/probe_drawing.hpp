#pragma once

#include "reports/scene.hpp"
#include "simulation/truth.hpp"

namespace probewright::setup {

/// A touch probe as a report draws it in the head: balls, styli and body, all that collides. Spindle frame, the spindle
/// at 0 degrees.
reports::Mesh drawnProbe(const simulation::TrueTool& tool);

}  // namespace probewright::setup
