#include "camera/virtual_camera.hpp"

#include <algorithm>
#include <cmath>

#include "machine/links.hpp"

namespace probewright::camera {

using machine::CameraEnd;
using machine::CameraResult;
using machine::PictureResult;

VirtualCamera::VirtualCamera(const simulation::VirtualMachine& machine, TrueCamera camera)
    : machine_(machine), camera_(std::move(camera)), noise_(simulation::streamSeed(machine.truth().seed, "camera")) {}

CameraResult VirtualCamera::moveCover(bool open) {
  if (camera_.fault == CameraFault::CoverStuck && open != open_)
    return {CameraEnd::Failed, "the cover of the camera does not move"};
  open_ = open;
  return {};
}

CameraResult VirtualCamera::openCover() { return moveCover(true); }
CameraResult VirtualCamera::closeCover() { return moveCover(false); }

std::vector<simulation::PlacedSolid> VirtualCamera::bodies() const {
  const simulation::Truth& truth = machine_.truth();
  const machine::MachineDescription real = simulation::trueDescription(truth.machine, truth.errors);
  const machine::AxisPositions position = machine_.position();
  const machine::Link head = machine::headLink(real);
  const Pose tableFromBase = machine::baseFromTable(real, position).inverse();
  std::vector<simulation::PlacedSolid> placed;
  for (const simulation::MachineBody& body : truth.bodies) {
    if (body.link == head) continue;
    const Pose pose = tableFromBase * machine::baseFromLink(real, position, body.link) * body.linkFromSolid;
    placed.push_back({.solid = body.solid,
                      .tableFromSolid = pose,
                      .name = body.name,
                      .role = simulation::SolidRole::Fixture,
                      .ofMachine = true});
  }
  return placed;
}

/// Renders the scene if anything stands elsewhere than for the last picture.
void VirtualCamera::look() {
  const Pose tableFromSpindle = machine_.tableFromSpindle();
  const Pose place = tableFromSpindle * spindleFromCamera(camera_);
  const Pose tableFromBase = machine::baseFromTable(machine_.description(), machine_.position()).inverse();
  std::vector<Vector3> lamps;
  for (const Lamp& lamp : camera_.lamps)
    lamps.push_back((lamp.on == Mounted::Bed ? tableFromBase : tableFromSpindle) * lamp.position);
  if (!layers_.empty() && place.matrix() == place_.matrix() && lamps == lampPlaces_ &&
      (machine_.truth().bodies.empty() || position_ == machine_.position()))
    return;
  if (!scenery_) scenery_.emplace(machine_.truth().solids, camera_);
  position_ = machine_.position();
  if (!machine_.truth().bodies.empty()) scenery_->put(bodies());
  layers_ = scenery_->render(place, lamps);
  place_ = place;
  lampPlaces_ = std::move(lamps);
}

PictureResult VirtualCamera::takePicture() {
  if (camera_.fault == CameraFault::NoSignal) return {CameraEnd::Failed, {}, "the camera gives no signal"};
  const auto pixels = static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height);
  std::vector<float> light(pixels);
  std::normal_distribution<float> normal;
  if (open_) {
    look();
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      const float strength = i == 0 ? 1.0F : std::max(0.0F, 1 + static_cast<float>(camera_.flicker) * normal(noise_));
      for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        light[pixel] += strength * layers_[i][pixel];
    }
  }
  machine::Picture picture{camera_.width, camera_.height, {}};
  picture.grey.reserve(pixels);
  for (const float value : light) {
    const float grey = 255 * value + static_cast<float>(camera_.noise) * normal(noise_);
    picture.grey.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0F, 255.0F))));
  }
  return {CameraEnd::Done, std::move(picture), {}};
}

}  // namespace probewright::camera
