#pragma once

#include <TopoDS_Shape.hxx>

namespace probewright::simulation {

/// The shape with its faces cut into pieces that OpenCASCADE tessellates quickly: along the kinks of their surfaces, on
/// which it can spend hours, and splines of many spans between some of them, as its time grows with the third power of
/// the points on a border. As it is, where it has no kinks that could be seen and no long splines, or where OpenCASCADE
/// cannot cut it: of a hole whose border runs along a kink it makes a face.
TopoDS_Shape inPieces(const TopoDS_Shape& shape);

}  // namespace probewright::simulation
