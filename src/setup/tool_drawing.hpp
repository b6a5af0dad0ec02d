#pragma once

#include "reports/scene.hpp"
#include "simulation/truth.hpp"

namespace probewright::setup {

/// A cutter as a report draws it: its edges, shank and holder as a round body, and each cutting edge as a line. The end
/// of the tool on the spindle's axis is the origin, the shank lies along +Z, the spindle stands at 0 degrees.
reports::Mesh drawnTool(const simulation::TrueTool& tool);

}  // namespace probewright::setup
