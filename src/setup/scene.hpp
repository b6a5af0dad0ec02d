#pragma once

#include "control/journal.hpp"
#include "reports/scene.hpp"
#include "setup/simulated_run.hpp"
#include "simulation/path_record.hpp"
#include "simulation/truth.hpp"

namespace probewright::setup {

/// What the report draws of a run: the solids of the world, the path as it truly was, the true place of every touch
/// and of every collision, and what the camera saw.
reports::Scene sceneOf(const SimulatedRun& run);

/// What somebody at the machine could draw of the run: the touches where the control believes them to be, and what the
/// camera saw. Nothing of it comes from the world.
reports::Scene believedSceneOf(const SimulatedRun& run);

/// The same as `sceneOf` without ball and workpiece coordinate system. A touch of the journal is found in the path by
/// the axis positions that the control was told; one without contact is shown where its measuring move ended.
reports::Scene sceneOf(const control::Journal& journal, const simulation::Truth& truth,
                       const simulation::PathRecord& path);

}  // namespace probewright::setup
