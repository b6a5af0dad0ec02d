#include "simulation/drawing_mesh.hpp"

#include "simulation/cad_solid.hpp"
#include "simulation/mesh_solid.hpp"

namespace probewright::simulation {

DrawingMesh drawingMesh(const Solid& solid) {
  if (const auto* mesh = dynamic_cast<const MeshSolid*>(&solid)) return mesh->drawing();
  if (const auto* cad = dynamic_cast<const CadSolid*>(&solid)) return cad->drawing();
  return {};
}

}  // namespace probewright::simulation
