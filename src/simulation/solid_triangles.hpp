#pragma once

#include "simulation/drawing_mesh.hpp"

namespace probewright::simulation {

/// The surface of a solid as triangles, for bodies that move against each other: that of drawingMesh(), and of boxes
/// and round bars in analytic form one of their own, whose corners lie on the surface. Empty for any other solid.
DrawingMesh solidTriangles(const Solid& solid);

}  // namespace probewright::simulation
