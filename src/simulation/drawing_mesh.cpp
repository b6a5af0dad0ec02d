#include "simulation/drawing_mesh.hpp"

#include "simulation/mesh_solid.hpp"

namespace probewright::simulation {

DrawingMesh drawingMesh(const Solid& solid) {
  if (const auto* mesh = dynamic_cast<const MeshSolid*>(&solid)) return mesh->drawing();
  return {};
}

}  // namespace probewright::simulation
