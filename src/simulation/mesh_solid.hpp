#pragma once

#include <memory>

#include "simulation/drawing_mesh.hpp"
#include "simulation/import_watch.hpp"
#include "simulation/search_tree.hpp"
#include "simulation/solid.hpp"
#include "simulation/triangle_mesh.hpp"

namespace probewright::simulation {

/// A solid bounded by triangles. Contacts are exact on the triangles, on faces, edges and corners.
///
/// A mesh that is closed knows its inside: a ball that starts within the material makes contact at fraction 0, with the
/// normal against its way. An open mesh is a skin that can be touched from both sides.
class MeshSolid final : public Solid {
public:
  explicit MeshSolid(TriangleMesh mesh, Instructions instructions = bestInstructions());
  /// The same, watched: throws ImportStopped.
  MeshSolid(TriangleMesh mesh, ImportWatch& watch);

  Bounds bounds() const override { return tree_.bounds(); }
  std::optional<BallContact> firstContact(const Vector3& from, const Vector3& to, double radius) const override;
  std::optional<BallContact> firstCapsuleContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                 double radius) const override;
  std::optional<BallContact> firstCylinderContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                  double radius) const override;

  bool isClosed() const { return closed_; }
  std::size_t triangleCount() const { return mesh_.triangles.size(); }
  DrawingMesh drawing() const;

private:
  void prepare(ImportWatch* watch, Instructions instructions);
  bool isInside(const Vector3& point) const;
  /// A capsule on a way along its own axis meets what a ball meets that starts at its tail. Nothing if its way is not
  /// of that kind, or if it overlaps something at the start; a meeting that is not found if its way is free.
  std::optional<Meeting> meetingAlongAxis(const Way& way, const Vector3& axis, double radius) const;

  TriangleMesh mesh_;
  SearchTree tree_;
  bool closed_ = false;
};

/// An STL file as a solid. Ends with a mistake once `import.stop` is asked.
Result<std::unique_ptr<Solid>> readStl(const std::filesystem::path& path, const ImportOptions& import = {});

}  // namespace probewright::simulation
