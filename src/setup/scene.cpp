#include "setup/scene.hpp"

#include <algorithm>
#include <map>

#include "setup/camera_shots.hpp"
#include "setup/machine_drawing.hpp"
#include "setup/tool_drawing.hpp"
#include "simulation/drawing_mesh.hpp"

namespace probewright::setup {

namespace {

using reports::MeshRole;
using reports::MoveKind;
using reports::Vector3f;
using simulation::PathKind;

MeshRole roleOf(simulation::SolidRole role) {
  switch (role) {
    case simulation::SolidRole::Part:
      return MeshRole::Part;
    case simulation::SolidRole::Fixture:
      return MeshRole::Fixture;
    case simulation::SolidRole::Ring:
    case simulation::SolidRole::Sphere:
    case simulation::SolidRole::GaugeBlock:
    case simulation::SolidRole::ToolProbe:
      return MeshRole::Artefact;
  }
  return MeshRole::Artefact;
}

MoveKind moveOf(PathKind kind) {
  switch (kind) {
    case PathKind::Rapid:
      return MoveKind::Rapid;
    case PathKind::Feed:
    case PathKind::Retract:
      return MoveKind::Feed;
    case PathKind::Measure:
      return MoveKind::Measure;
    case PathKind::Start:
    case PathKind::ToolChange:
      return MoveKind::Jump;
  }
  return MoveKind::Jump;
}

std::vector<Vector3f> pointsOf(const std::vector<float>& coordinates) {
  std::vector<Vector3f> points;
  points.reserve(coordinates.size() / 3);
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
    points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  return points;
}

reports::Mesh meshOf(const simulation::PlacedSolid& placed) {
  const simulation::DrawingMesh drawing = simulation::drawingMesh(*placed.solid);
  reports::Mesh mesh;
  mesh.name = placed.name;
  mesh.role = roleOf(placed.role);
  mesh.sceneFromMesh = placed.tableFromSolid;
  mesh.positions = pointsOf(drawing.positions);
  mesh.normals = pointsOf(drawing.normals);
  mesh.triangles = drawing.indices;
  for (const auto& edge : drawing.featureEdges) {
    const auto points = pointsOf(edge);
    for (std::size_t i = 1; i < points.size(); ++i) {
      mesh.featureEdges.push_back(points[i - 1]);
      mesh.featureEdges.push_back(points[i]);
    }
  }
  return mesh;
}

reports::Path pathOf(const simulation::PathRecord& record) {
  reports::Path path;
  for (const simulation::PathPoint& point : record.points) {
    if (!path.points.empty()) path.kinds.push_back(moveOf(point.kind));
    path.points.push_back(point.tip.cast<float>());
    path.seconds.push_back(static_cast<float>(point.seconds));
    path.axes.push_back(point.axes);
  }
  // Most machines hold the probe upright all the time: nothing to say then.
  constexpr double upright = 1 - 1e-12;
  if (std::any_of(record.points.begin(), record.points.end(),
                  [](const simulation::PathPoint& point) { return point.shank.z() < upright; })) {
    for (const simulation::PathPoint& point : record.points)
      path.toolAxes.push_back(point.shank.cast<float>());
  }
  return path;
}

/// The cutters that a path is of, each once, by their places in Truth::tools.
class DrawnTools {
public:
  explicit DrawnTools(const simulation::Truth& truth) : truth_(truth) {}

  /// The place among the scene's tools; -1 for a touch probe, or none.
  std::int32_t of(int tool) {
    if (tool < 0 || static_cast<std::size_t>(tool) >= truth_.tools.size()) return -1;
    const simulation::TrueTool& shape = truth_.tools[static_cast<std::size_t>(tool)];
    if (shape.kind != simulation::ToolKind::Cutter) return -1;
    const auto [place, isNew] = places_.try_emplace(tool, static_cast<std::int32_t>(meshes.size()));
    if (isNew) meshes.push_back(drawnTool(shape));
    return place->second;
  }

  std::vector<reports::Mesh> meshes;

private:
  const simulation::Truth& truth_;
  std::map<int, std::int32_t> places_;
};

/// Finds the touches of a journal in a path, in the order in which they happened.
class TouchFinder {
public:
  TouchFinder(const simulation::PathRecord& path, DrawnTools& tools) : path_(path), tools_(tools) {}

  /// Fills the positions of `found`; false if the path knows nothing of the touch.
  bool find(const control::TouchRecord& touch, reports::SceneTouch& found) {
    if (touch.outcome != "touched") return findMiss(touch, found);
    for (std::size_t i = next_; i < path_.touches.size(); ++i) {
      const simulation::PathTouch& candidate = path_.touches[i];
      if (candidate.kind != PathKind::Measure || !(candidate.latched == touch.latched)) continue;
      found.ballCentre = candidate.ballCentre.cast<float>();
      found.surface = candidate.point.cast<float>();
      found.tool = tools_.of(path_.points[candidate.pathPoint].tool);
      found.toolAxis = path_.points[candidate.pathPoint].shank.cast<float>();
      next_ = i + 1;
      return true;
    }
    return false;
  }

private:
  bool findMiss(const control::TouchRecord& touch, reports::SceneTouch& found) {
    constexpr double clockTolerance = 1e-6;
    const auto after =
        std::upper_bound(path_.points.begin(), path_.points.end(), touch.seconds + clockTolerance,
                         [](double seconds, const simulation::PathPoint& point) { return seconds < point.seconds; });
    const auto last = std::find_if(std::make_reverse_iterator(after), path_.points.rend(),
                                   [](const simulation::PathPoint& point) { return point.kind == PathKind::Measure; });
    if (last == path_.points.rend()) return false;
    found.ballCentre = found.surface = last->tip.cast<float>();
    found.tool = tools_.of(last->tool);
    found.toolAxis = last->shank.cast<float>();
    return true;
  }

  const simulation::PathRecord& path_;
  DrawnTools& tools_;
  std::size_t next_ = 0;
};

/// A contact that was not measured: on the way, or with anything but what the probe feels with.
bool isCollision(const simulation::PathTouch& touch) {
  const bool withoutSignal = touch.part != "ball" && touch.latched == machine::AxisPositions{};
  return touch.kind != PathKind::Measure || withoutSignal;
}

}  // namespace

reports::Scene sceneOf(const control::Journal& journal, const simulation::Truth& truth,
                       const simulation::PathRecord& path) {
  reports::Scene scene;
  for (const auto& placed : truth.solids) {
    reports::Mesh mesh = meshOf(placed);
    if (!mesh.triangles.empty()) scene.meshes.push_back(std::move(mesh));
  }
  scene.path = pathOf(path);
  DrawnTools tools(truth);
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const std::int32_t tool = tools.of(path.points[i].tool);
    if (tool != (scene.path.tools.empty() ? -1 : scene.path.tools.back().tool))
      scene.path.tools.push_back({static_cast<std::uint32_t>(i), tool});
  }
  for (const simulation::PathTouch& touch : path.touches) {
    if (isCollision(touch)) scene.collisions.push_back({touch.point.cast<float>(), touch.part, touch.solid});
  }
  TouchFinder finder(path, tools);
  for (std::uint32_t cycle = 0; cycle < journal.cycles.size(); ++cycle) {
    const auto& touches = journal.cycles[cycle].touches;
    for (std::uint32_t touch = 0; touch < touches.size(); ++touch) {
      reports::SceneTouch found;
      found.cycle = cycle;
      found.touch = touch;
      if (finder.find(touches[touch], found)) scene.touches.push_back(found);
    }
  }
  scene.tools = std::move(tools.meshes);
  scene.machine = machineReplayOf(truth, path);
  return scene;
}

reports::Scene sceneOf(const SimulatedRun& run) {
  if (!run.machine) return {};
  reports::Scene scene = sceneOf(run.outcome.journal, run.machine->truth(), run.machine->path());
  scene.camera = cameraShots(run.outcome);
  scene.ballRadius = run.outcome.ballRadius;
  scene.lathe = run.machine->description().mainSpindle.has_value();
  scene.sceneFromWorkpiece = run.outcome.machineFromWorkpiece;
  return scene;
}

reports::Scene believedSceneOf(const SimulatedRun& run) {
  if (!run.machine) return {};
  reports::Scene scene;
  scene.camera = cameraShots(run.outcome);
  scene.ballRadius = run.outcome.ballRadius;
  scene.lathe = run.machine->description().mainSpindle.has_value();
  scene.sceneFromWorkpiece = run.outcome.machineFromWorkpiece;
  for (std::uint32_t cycle = 0; cycle < run.outcome.journal.cycles.size(); ++cycle) {
    const auto& touches = run.outcome.journal.cycles[cycle].touches;
    for (std::uint32_t touch = 0; touch < touches.size(); ++touch) {
      const control::TouchRecord& record = touches[touch];
      if (record.outcome != "touched") continue;
      const Eigen::Affine3d tableFromProgram = record.programFromTable.inverse();
      scene.touches.push_back({cycle, touch, (tableFromProgram * record.ballCentre).cast<float>(),
                               (tableFromProgram * record.surface).cast<float>()});
    }
  }
  return scene;
}

}  // namespace probewright::setup
