#pragma once

#include <TopoDS_Shape.hxx>

namespace probewright::simulation {

/// Gives edges that have a curve on a surface only one in space, and those for which OpenCASCADE's readers have made
/// one of theirs a better one: they approximate it to 1e-5 mm, this to 1e-7 mm.
void sharpenEdges(const TopoDS_Shape& shape);

}  // namespace probewright::simulation
