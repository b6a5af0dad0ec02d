#include "simulation/body_mesh.hpp"

#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "simulation/solid_triangles.hpp"

namespace probewright::simulation {

namespace {

std::shared_ptr<const BodyMesh> meshOf(const Solid& solid) {
  const DrawingMesh drawing = solidTriangles(solid);
  std::vector<Vector3> points;
  for (std::size_t i = 0; i + 2 < drawing.positions.size(); i += 3)
    points.emplace_back(drawing.positions[i], drawing.positions[i + 1], drawing.positions[i + 2]);
  std::vector<fcl::Triangle> corners;
  for (std::size_t i = 0; i + 2 < drawing.indices.size(); i += 3)
    corners.emplace_back(drawing.indices[i], drawing.indices[i + 1], drawing.indices[i + 2]);
  auto mesh = std::make_shared<BodyMesh>();
  mesh->beginModel(static_cast<int>(corners.size()), static_cast<int>(points.size()));
  mesh->addSubModel(points, corners);
  mesh->endModel();
  return mesh;
}

/// Meshes by their solids; those of solids that are gone go when the next one comes.
class Meshes {
public:
  std::shared_ptr<const BodyMesh> find(const std::shared_ptr<const Solid>& solid) {
    const std::lock_guard lock(mutex_);
    const auto found = meshes_.find(solid);
    return found == meshes_.end() ? nullptr : found->second;
  }

  /// The one that was first stays.
  std::shared_ptr<const BodyMesh> add(const std::shared_ptr<const Solid>& solid, std::shared_ptr<const BodyMesh> mesh) {
    const std::lock_guard lock(mutex_);
    std::erase_if(meshes_, [](const auto& entry) { return entry.first.expired(); });
    return meshes_.try_emplace(solid, std::move(mesh)).first->second;
  }

private:
  std::mutex mutex_;
  std::map<std::weak_ptr<const Solid>, std::shared_ptr<const BodyMesh>, std::owner_less<>> meshes_;
};

}  // namespace

std::shared_ptr<const BodyMesh> bodyMesh(const std::shared_ptr<const Solid>& solid) {
  static Meshes meshes;
  if (auto known = meshes.find(solid)) return known;
  // Not under the lock: who makes triangles on many threads may come back here for another trial on one of them.
  return meshes.add(solid, meshOf(*solid));
}

}  // namespace probewright::simulation
