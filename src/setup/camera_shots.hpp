#pragma once

#include <vector>

#include "reports/scene.hpp"
#include "session/run.hpp"

namespace probewright::setup {

/// The cycles whose images the report shows: of more the oldest are left out.
inline constexpr std::size_t mostCameraShots = 40;

/// What the cycles of a run saw with the camera: of each the image that it took last, as far as the control has kept
/// it, with the average of the point's reference images and with the errors of its last evaluation.
std::vector<reports::CameraShot> cameraShots(const session::RunOutcome& outcome);

}  // namespace probewright::setup
