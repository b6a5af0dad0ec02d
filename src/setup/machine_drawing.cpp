#include "setup/machine_drawing.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <string_view>

#include "machine/machine_file.hpp"
#include "machine/machine_text.hpp"
#include "setup/machine_body_keys.hpp"
#include "setup/probe_drawing.hpp"
#include "setup/setup.hpp"
#include "setup/solid_warnings.hpp"
#include "simulation/solid_triangles.hpp"
#include "simulation/virtual_machine.hpp"
#include "simulation/world.hpp"

namespace probewright::setup {

namespace {

using reports::Vector3f;

std::vector<Vector3f> pointsOf(const std::vector<float>& values) {
  std::vector<Vector3f> points;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    points.emplace_back(values[i], values[i + 1], values[i + 2]);
  return points;
}

reports::Mesh meshOf(const simulation::Solid& solid, const Pose& pose, const std::string& name) {
  const simulation::DrawingMesh drawing = simulation::solidTriangles(solid);
  reports::Mesh mesh;
  mesh.name = name;
  mesh.role = reports::MeshRole::Fixture;
  mesh.sceneFromMesh = pose;
  mesh.positions = pointsOf(drawing.positions);
  mesh.normals = pointsOf(drawing.normals);
  mesh.triangles = drawing.indices;
  for (const auto& line : drawing.featureEdges) {
    const auto points = pointsOf(line);
    for (std::size_t i = 1; i < points.size(); ++i)
      mesh.featureEdges.insert(mesh.featureEdges.end(), {points[i - 1], points[i]});
  }
  return mesh;
}

/// What ISO 841 says of axes of these names: where the tool goes, as seen from the workpiece, when they go to plus.
struct StandardAxis {
  std::string_view name;
  machine::AxisKind kind;
  Vector3 direction;
  const char* text;
};
const std::array<StandardAxis, 6>& standardAxes() {
  using enum machine::AxisKind;
  static const std::array<StandardAxis, 6> axes = {{{"X", Linear, Vector3::UnitX(), "moves towards +X"},
                                                    {"Y", Linear, Vector3::UnitY(), "moves towards +Y"},
                                                    {"Z", Linear, Vector3::UnitZ(), "moves towards +Z"},
                                                    {"A", Rotary, Vector3::UnitX(), "turns right-handed about +X"},
                                                    {"B", Rotary, Vector3::UnitY(), "turns right-handed about +Y"},
                                                    {"C", Rotary, Vector3::UnitZ(), "turns right-handed about +Z"}}};
  return axes;
}

Diagnostics remarksOf(const machine::MachineDescription& machine, const std::string& file) {
  Diagnostics remarks;
  const auto look = [&](const std::vector<machine::ChainElement>& chain, double sign, const char* advice) {
    for (const machine::ChainElement& element : chain) {
      if (!element.axis) continue;
      const machine::Axis& axis = machine.axes[*element.axis];
      for (const StandardAxis& standard : standardAxes()) {
        if (axis.name != standard.name || axis.kind != standard.kind) continue;
        const double along = sign * element.direction.dot(standard.direction);
        if (along > 0.5) continue;  // axes may lean, as that of a nutating head
        remarks.push_back({Severity::Warning,
                           {file, 0, 0},
                           fmt::format("with {} going to plus the tool, seen from the workpiece, does not go where ISO "
                                       "841 has it: there it {}{}",
                                       axis.name, standard.text, along < -0.5 ? "; here it is the opposite" : ""),
                           {},
                           advice,
                           {}});
      }
    }
  };
  look(machine.tableChain, -1,
       "an axis that carries the workpiece has the direction in which the workpiece itself goes, against that of the "
       "tool; change the signs of its direction if the machine is not like this");
  look(machine.spindleChain, 1, "change the signs of its direction if the machine is not like this");
  return remarks;
}

}  // namespace

machine::Link linkOf(const simulation::PlacedSolid& solid, const machine::MachineDescription& machine) {
  const bool onBed = solid.role == simulation::SolidRole::ToolProbe && machine.mainSpindle;
  return onBed ? machine::Link{} : machine::tableLink(machine);
}

reports::MachineScene machineSceneOf(const simulation::Truth& truth, Drawn drawn) {
  reports::MachineScene scene;
  scene.machine = truth.machine;
  // What stands on a table stands upright; a turner sees X upwards and Z to the right.
  for (const simulation::PlacedSolid& solid : truth.solids)
    if (solid.ofMachine && (solid.tableFromSolid.linear() * Vector3::UnitZ()).y() > 0.7) scene.up = Vector3::UnitY();
  if (truth.machine.mainSpindle) scene.up = Vector3::UnitX();
  for (const simulation::MachineBody& body : truth.bodies)
    scene.bodies.push_back({body.link, meshOf(*body.solid, body.linkFromSolid, body.name)});
  for (const simulation::PlacedSolid& solid : truth.solids) {
    if (solid.ofMachine || drawn == Drawn::WhatLiesOnTheTableToo)
      scene.bodies.push_back({linkOf(solid, truth.machine), meshOf(*solid.solid, solid.tableFromSolid, solid.name)});
  }
  return scene;
}

std::shared_ptr<const reports::MachineReplay> machineReplayOf(const simulation::Truth& truth,
                                                              const simulation::PathRecord& path) {
  auto replay = std::make_shared<reports::MachineReplay>();
  replay->scene = machineSceneOf(truth);
  if (replay->scene.bodies.empty()) return nullptr;
  std::map<int, std::int32_t> probes;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const simulation::PathPoint& point = path.points[i];
    std::int32_t probe = -1;
    if (point.tool >= 0 && truth.tools[static_cast<std::size_t>(point.tool)].kind == simulation::ToolKind::Probe) {
      const auto [known, isNew] = probes.try_emplace(point.tool, static_cast<std::int32_t>(replay->probes.size()));
      if (isNew) replay->probes.push_back(drawnProbe(truth.tools[static_cast<std::size_t>(point.tool)]));
      probe = known->second;
    }
    if (probe != (replay->changes.empty() ? -1 : replay->changes.back().tool))
      replay->changes.push_back({static_cast<std::uint32_t>(i), probe});
  }
  return replay;
}

namespace {

/// A setup names a machine, a machine file has axes.
bool isSetup(const std::string& path) {
  const auto text = machine::machineText(path);
  Diagnostics ignored;
  const auto root = text ? parseToml(text->text, text->file, ignored) : std::nullopt;
  return root && !root->contains("axis") && !root->contains("table_chain") && !root->contains("spindle_chain") &&
         (root->contains("machine") || root->contains("part") || root->contains("tool") || root->contains("control"));
}

std::optional<simulation::World> worldOf(const std::string& nameOrPath, Diagnostics& diagnostics) {
  if (isSetup(nameOrPath)) {
    auto setup = readSetup(nameOrPath, diagnostics);
    if (!setup) return std::nullopt;
    return std::move(setup->world);
  }
  const auto description = machine::readMachine(nameOrPath, diagnostics);
  if (!description) return std::nullopt;
  simulation::World world;
  world.file = nameOrPath;
  world.truth.machine = *description;
  world.truth.start = description->toolChange;
  world.table = machine::readTableBody(nameOrPath).value_or(std::nullopt);
  std::vector<std::filesystem::path> inputs;
  readBodiesOf(nameOrPath, *description, diagnostics, world.bodies, inputs);
  if (hasErrors(diagnostics)) return std::nullopt;
  return world;
}

}  // namespace

std::optional<MachineWorld> readMachineWorld(const std::string& nameOrPath, Diagnostics& diagnostics,
                                             const simulation::ImportOptions& import) {
  const auto world = worldOf(nameOrPath, diagnostics);
  if (!world) return std::nullopt;
  auto machine = simulation::buildMachine(*world, import);
  if (!machine) {
    diagnostics.push_back(std::move(machine.error()));
    return std::nullopt;
  }
  warnOfSolids((*machine)->truth(), nameOrPath, diagnostics);
  warnOfBodies(**machine, nameOrPath, diagnostics);
  return MachineWorld{(*machine)->truth(), remarksOf(world->truth.machine, nameOrPath)};
}

}  // namespace probewright::setup
