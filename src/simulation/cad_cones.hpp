#pragma once

#include <Interface_InterfaceModel.hxx>

namespace probewright::simulation {

/// Gives faces of STEP that lie on the offset of a cone, or on a line turned about an axis that end at the cone's apex
/// without an edge, the conical surface that they are part of: OpenCASCADE loses the edges of the one and takes the
/// other for unbounded. What it cannot give stays as it is: where angles have several units in the file.
void takePlainCones(const Handle(Interface_InterfaceModel) & model);

}  // namespace probewright::simulation
