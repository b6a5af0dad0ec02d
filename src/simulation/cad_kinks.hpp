#pragma once

#include <TopoDS_Shape.hxx>

namespace probewright::simulation {

/// The shape with faces cut along the kinks of their surfaces, which OpenCASCADE tessellates for hours. As it is, where
/// it has no kinks that could be seen, or where OpenCASCADE cannot cut it: of a hole whose border runs along a kink it
/// makes a face.
TopoDS_Shape withoutKinks(const TopoDS_Shape& shape);

}  // namespace probewright::simulation
