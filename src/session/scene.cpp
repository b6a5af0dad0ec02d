#include "session/scene.hpp"

#include <algorithm>

#include "simulation/drawing_mesh.hpp"

namespace probewright::session {
namespace {

reports::Mesh meshOf(const simulation::PlacedSolid& placed) {
  const simulation::DrawingMesh drawing = simulation::drawingMesh(*placed.solid);
  reports::Mesh mesh;
  mesh.name = placed.name;
  switch (placed.role) {
    case simulation::SolidRole::Part:
      mesh.role = reports::MeshRole::Part;
      break;
    case simulation::SolidRole::Fixture:
      mesh.role = reports::MeshRole::Fixture;
      break;
    default:
      mesh.role = reports::MeshRole::Artefact;
      break;
  }
  mesh.sceneFromMesh = placed.tableFromSolid;
  const auto points = [](const std::vector<float>& flat) {
    std::vector<reports::Vector3f> list;
    list.reserve(flat.size() / 3);
    for (std::size_t i = 0; i + 2 < flat.size(); i += 3)
      list.emplace_back(flat[i], flat[i + 1], flat[i + 2]);
    return list;
  };
  mesh.positions = points(drawing.positions);
  mesh.normals = points(drawing.normals);
  mesh.triangles = drawing.indices;
  for (const std::vector<float>& line : drawing.featureEdges) {
    const auto corners = points(line);
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      mesh.featureEdges.push_back(corners[i]);
      mesh.featureEdges.push_back(corners[i + 1]);
    }
  }
  return mesh;
}

reports::MoveKind kindOf(simulation::PathKind kind) {
  switch (kind) {
    case simulation::PathKind::Measure:
      return reports::MoveKind::Measure;
    case simulation::PathKind::Rapid:
    case simulation::PathKind::ToolChange:
    case simulation::PathKind::Start:
      return reports::MoveKind::Rapid;
    default:
      return reports::MoveKind::Feed;
  }
}

}  // namespace

reports::Scene sceneOf(const RunOutcome& outcome) {
  reports::Scene scene;
  if (!outcome.machine) return scene;
  for (const auto& placed : outcome.machine->truth().solids)
    scene.meshes.push_back(meshOf(placed));

  const simulation::PathRecord& path = outcome.machine->path();
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    scene.path.points.push_back(path.points[i].tip.cast<float>());
    scene.path.seconds.push_back(static_cast<float>(path.points[i].seconds));
    if (i > 0) scene.path.kinds.push_back(kindOf(path.points[i].kind));
  }

  // Journal and path record tell of the same touches in the same order; the latched positions tie them together.
  std::size_t next = 0;
  for (std::size_t c = 0; c < outcome.journal.cycles.size(); ++c) {
    const auto& touches = outcome.journal.cycles[c].touches;
    for (std::size_t t = 0; t < touches.size(); ++t) {
      const auto isIt = [&](const simulation::PathTouch& touch) {
        return touch.kind == simulation::PathKind::Measure && touch.latched == touches[t].latched;
      };
      const auto found =
          std::find_if(path.touches.begin() + static_cast<std::ptrdiff_t>(next), path.touches.end(), isIt);
      if (found == path.touches.end()) continue;
      next = static_cast<std::size_t>(found - path.touches.begin()) + 1;
      scene.touches.push_back({static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(t),
                               found->ballCentre.cast<float>(), found->point.cast<float>()});
    }
  }
  scene.ballRadius = outcome.ballRadius;
  scene.sceneFromWorkpiece = outcome.machineFromWorkpiece;
  return scene;
}

}  // namespace probewright::session
