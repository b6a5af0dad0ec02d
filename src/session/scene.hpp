#pragma once

#include "reports/scene.hpp"
#include "session/run.hpp"

namespace probewright::session {

/// What the report draws of a run: the solids of the world, the path as it truly was, the true place of every touch.
reports::Scene sceneOf(const RunOutcome& outcome);

}  // namespace probewright::session
