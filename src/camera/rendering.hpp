#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "camera/true_camera.hpp"
#include "simulation/truth.hpp"

/// What a camera sees of the solids that a probe touches: rays from each pixel to the nearest triangle, and from there
/// to the lamps.
namespace probewright::camera {

/// A picture for each source of light, as if it were alone and as bright as it should be: the ambient light first, then
/// the lamps in their order. Parts of white; the picture with all lamps is their sum.
using Layers = std::vector<std::vector<float>>;

/// All solids as triangles, in the table frame: parts, fixtures and gauges as they are drawn in reports, the table of
/// the machine, and its bodies. Curved faces are as flat as their triangles, and shaded as if they were not. Tools are
/// not seen.
class Scenery {
public:
  /// Throws std::runtime_error if Embree cannot allocate its memory.
  Scenery(std::span<const simulation::PlacedSolid> solids, const TrueCamera& camera);
  ~Scenery();

  /// Things that stand elsewhere than before, such as bodies of the machine: all of them anew. Their meshes are kept.
  void put(std::span<const simulation::PlacedSolid> moving);

  /// `lamps`: places of the camera's lamps, table frame. A pixel is the mean of four rays.
  Layers render(const Pose& tableFromCamera, std::span<const Vector3> lamps) const;

private:
  struct Shapes;
  struct Meshes;

  std::unique_ptr<Shapes> shapes_, moving_;
  std::unique_ptr<Meshes> meshes_;  ///< of what moves, by its solid
  TrueCamera camera_;
};

/// From the frame of the camera (x to the right of its pictures, y down, z ahead) to that of the spindle.
Pose spindleFromCamera(const TrueCamera& camera);

/// Where the ray through a place of the picture (pixels, from the upper left corner of the first) goes: camera frame,
/// z = 1. The distortion of the lens is taken out to 1e-9.
Vector3 rayThrough(const TrueCamera& camera, double x, double y);

/// The place in the picture of a point in the camera frame that lies ahead (z > 0).
Vector2 pixelOf(const TrueCamera& camera, const Vector3& point);

}  // namespace probewright::camera
