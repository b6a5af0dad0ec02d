#pragma once

#include <Interface_InterfaceModel.hxx>

namespace probewright::simulation {

/// Gives faces of STEP that lie on a torus that meets itself (DEGENERATE_TOROIDAL_SURFACE) the arc that makes their
/// part of it, the outer or the inner one, turned about the axis: OpenCASCADE takes no notice of the part, and where no
/// seam tells, it would take the outer one for the inner, or lose faces that end at the axis.
void turnArcs(const Handle(Interface_InterfaceModel) & model);

}  // namespace probewright::simulation
