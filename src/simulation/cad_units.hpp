#pragma once

#include <Interface_InterfaceModel.hxx>
#include <Standard_Transient.hxx>
#include <optional>

/// The units of a STEP file.
namespace probewright::simulation {

/// A shape whose lengths have no unit that can be read; null if there is none. OpenCASCADE takes them as mm or m.
Handle(Standard_Transient) withoutLengthUnit(const Handle(Interface_InterfaceModel) & model);

/// The file's unit of angles in radians; nothing if it has several or none.
std::optional<double> angleUnit(const Handle(Interface_InterfaceModel) & model);

}  // namespace probewright::simulation
