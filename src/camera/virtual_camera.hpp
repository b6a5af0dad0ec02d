#pragma once

#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "camera/rendering.hpp"
#include "camera/true_camera.hpp"
#include "machine/camera.hpp"
#include "simulation/virtual_machine.hpp"

namespace probewright::camera {

/// The camera of a virtual machine. What it sees is where it truly is: with the errors of the machine's axes. Lamps
/// flicker and pixels are noisy, by the seed of the world. A picture from the same place is computed once and gets new
/// noise each time.
class VirtualCamera final : public machine::Camera {
public:
  /// `machine` outlives the camera.
  VirtualCamera(const simulation::VirtualMachine& machine, TrueCamera camera);

  std::optional<machine::AxisPositions> overviewPosition() const override { return camera_.overview; }
  machine::CameraResult openCover() override;
  machine::CameraResult closeCover() override;
  bool coverOpen() const override { return open_; }
  machine::PictureResult takePicture() override;

private:
  machine::CameraResult moveCover(bool open);
  void look();
  /// The bodies of the machine as they stand; the camera does not see the head that carries it.
  std::vector<simulation::PlacedSolid> bodies() const;

  const simulation::VirtualMachine& machine_;
  TrueCamera camera_;
  std::optional<Scenery> scenery_;
  Pose place_ = Pose::Identity();  ///< of `layers_`
  std::vector<Vector3> lampPlaces_;
  machine::AxisPositions position_;  ///< of the machine then
  Layers layers_;
  std::mt19937_64 noise_;
  bool open_ = false;
};

}  // namespace probewright::camera
