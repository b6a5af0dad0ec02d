#pragma once

#include <optional>

#include "control/journal.hpp"
#include "reports/scene.hpp"
#include "simulation/path_record.hpp"
#include "simulation/truth.hpp"

namespace probewright::app {

/// What a report draws of a run on the virtual machine: the true parts and path, and where each touch of the journal
/// really was. A touch is found in the path by the axis positions that the control was told; one without contact is
/// shown where its measuring move ended. `tableFromWorkpiece`: the workpiece coordinate system at the end, as the
/// control believes; nothing leaves it out.
reports::Scene sceneOfRun(const control::Journal& journal, const simulation::Truth& truth,
                          const simulation::PathRecord& path, const std::optional<Pose>& tableFromWorkpiece = {});

}  // namespace probewright::app
