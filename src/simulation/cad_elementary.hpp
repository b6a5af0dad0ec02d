#pragma once

#include <TopoDS_Shape.hxx>

namespace probewright::simulation {

/// Gives the faces of a shape cylinders and cones where their surfaces of revolution and of extrusion are nothing else,
/// as IGES and some CAD systems write them: their contacts are then closed forms, and meshes of few triangles do. Each
/// pair of parameters keeps its place to 1e-7 mm, and each face its side.
void takeElementarySurfaces(const TopoDS_Shape& shape);

/// The same, but leaves the shape itself as it is: a copy where it changes something.
TopoDS_Shape withElementarySurfaces(const TopoDS_Shape& shape);

}  // namespace probewright::simulation
