#pragma once

#include <Interface_InterfaceModel.hxx>
#include <Standard_Transient.hxx>

/// Entities of files that OpenCASCADE takes for something else than the standards mean.
namespace probewright::simulation {

/// Clears the faults of entities of which only texts are wrong: some systems leave out names and descriptions, `$`,
/// which the standard demands, and nothing of a shape depends on them. To be called before anything else looks for
/// faults.
void acceptMissingTexts(const Handle(Interface_InterfaceModel) & model);

/// A placement that mirrors or scales, of STEP, or that scales, of IGES; null if there is none. OpenCASCADE takes a
/// scale for its inverse or none and a mirror for a rotation.
Handle(Standard_Transient) misreadPlacement(const Handle(Interface_InterfaceModel) & model);

/// A face of STEP on the offset of a cone; null if there is none. OpenCASCADE loses its edges, and the probe would
/// pass.
Handle(Standard_Transient) unreadableOffset(const Handle(Interface_InterfaceModel) & model);

/// A face of STEP on a surface of revolution that is bounded by a single vertex; null if there is none. OpenCASCADE
/// takes it for unbounded there.
Handle(Standard_Transient) unreadableApex(const Handle(Interface_InterfaceModel) & model);

/// Gives faces of STEP that lie on the offset of a plane, cylinder, sphere or torus the plane, cylinder, sphere or
/// torus itself: OpenCASCADE does not find their edges on the offset.
void takePlainOffsets(const Handle(Interface_InterfaceModel) & model);

/// Offset surfaces of IGES lie to the side of a vector at the middle of their basis, and to that of the borders of
/// their faces; OpenCASCADE offsets along the normal. Nothing may have been built yet.
void turnOffsets(const Handle(Interface_InterfaceModel) & model);

/// Lengths of an IGES model over the true ones, which OpenCASCADE does not look at; 1 for other files.
double scaleOf(const Handle(Interface_InterfaceModel) & model);

}  // namespace probewright::simulation
