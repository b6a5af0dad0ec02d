#pragma once

#include <cstdint>
#include <vector>

#include "simulation/solid.hpp"

namespace probewright::simulation {

/// A solid as triangles and lines, for views. Not for measuring: curved faces are flattened.
struct DrawingMesh {
  std::vector<float> positions;        ///< x, y, z of each corner, mm, in the solid's frame
  std::vector<float> normals;          ///< outward unit normal of each corner
  std::vector<std::uint32_t> indices;  ///< three corners a triangle, counter-clockwise seen from outside

  /// Edges worth drawing as lines: x, y, z of each point, one inner vector a polyline.
  std::vector<std::vector<float>> featureEdges;
};

/// The drawing of a CAD or mesh solid; empty for any other. Triangles of CAD leave the surface by about 0.05 mm.
DrawingMesh drawingMesh(const Solid& solid);

}  // namespace probewright::simulation
