#pragma once

#include <TopoDS_Shape.hxx>

namespace probewright::simulation {

/// Gives the faces of a shape cylinders, cones, spheres and tori where their surfaces of revolution and of extrusion
/// are nothing else, as IGES and some CAD systems write them: their contacts are then closed forms, and meshes of few
/// triangles do. Each place remains to 1e-7 mm, and each face has the side that it had.
void takeElementarySurfaces(const TopoDS_Shape& shape);

/// The same, but leaves the shape itself as it is: a copy where it changes something.
TopoDS_Shape withElementarySurfaces(const TopoDS_Shape& shape);

}  // namespace probewright::simulation
