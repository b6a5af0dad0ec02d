#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/solid.hpp"

class TopoDS_Shape;

namespace probewright::simulation {

/// A solid as triangles and lines, for views. Not for measuring: curved faces are flattened.
struct DrawingMesh {
  std::vector<float> positions;        ///< x, y, z of each corner, mm, in the solid's frame
  std::vector<float> normals;          ///< outward unit normal of each corner
  std::vector<std::uint32_t> indices;  ///< three corners a triangle, counter-clockwise seen from outside

  /// Edges worth drawing as lines: x, y, z of each point, one inner vector a polyline.
  std::vector<std::vector<float>> featureEdges;
};

/// Which triangles a drawing of a shape has.
enum class DrawnWith : std::uint8_t {
  FewTriangles,  ///< as few as a view needs; of a large part those that it has: others would take about as long to make
  ItsTriangles,  ///< those that it has
};

/// The drawing of a shape that has triangles, which stays as it is.
DrawingMesh drawingOf(const TopoDS_Shape& shape, DrawnWith triangles);

/// A drawing as it lies in memory.
std::string toBytes(const DrawingMesh& drawing);
/// Empty if `bytes` are not a drawing.
DrawingMesh drawingFromBytes(std::string_view bytes);

/// The drawing of a CAD or mesh solid; empty for any other.
DrawingMesh drawingMesh(const Solid& solid);

}  // namespace probewright::simulation
