#include "simulation/drawing_mesh.hpp"

#include "simulation/cad_solid.hpp"
#include "simulation/memory_text.hpp"
#include "simulation/mesh_solid.hpp"

namespace probewright::simulation {

std::string toBytes(const DrawingMesh& drawing) {
  std::string bytes;
  append(bytes, drawing.positions);
  append(bytes, drawing.normals);
  append(bytes, drawing.indices);
  append(bytes, drawing.featureEdges.size());
  for (const std::vector<float>& line : drawing.featureEdges)
    append(bytes, line);
  return bytes;
}

DrawingMesh drawingFromBytes(std::string_view bytes) {
  DrawingMesh drawing;
  std::size_t lines = 0;
  if (!take(bytes, drawing.positions) || !take(bytes, drawing.normals) || !take(bytes, drawing.indices) ||
      !take(bytes, lines) || lines > bytes.size())
    return {};
  drawing.featureEdges.resize(lines);
  for (std::vector<float>& line : drawing.featureEdges) {
    if (!take(bytes, line)) return {};
  }
  return drawing;
}

DrawingMesh drawingMesh(const Solid& solid) {
  if (const auto* mesh = dynamic_cast<const MeshSolid*>(&solid)) return mesh->drawing();
  if (const auto* cad = dynamic_cast<const CadSolid*>(&solid)) return cad->drawing();
  return {};
}

}  // namespace probewright::simulation
