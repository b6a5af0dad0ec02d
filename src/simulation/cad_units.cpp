#include "simulation/cad_units.hpp"

#include <Interface_Check.hxx>
#include <Interface_ReportEntity.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepShape_ShapeRepresentation.hxx>

namespace probewright::simulation {
namespace {

Handle(StepRepr_GlobalUnitAssignedContext) unitsOf(const Handle(Standard_Transient) & context) {
  if (const auto with = Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)::DownCast(context))
    return with->GlobalUnitAssignedContext();
  if (const auto with = Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(context))
    return with->GlobalUnitAssignedContext();
  return Handle(StepRepr_GlobalUnitAssignedContext)::DownCast(context);
}

/// True if one of the units cannot be read: one wrong letter in METRE makes a thousand of a length.
bool haveFaults(const StepRepr_GlobalUnitAssignedContext& units, const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= units.NbUnits(); ++i) {
    const int place = units.UnitsValue(i).IsNull() ? 0 : model->Number(units.UnitsValue(i));
    if (place == 0 || model->Check(place, Standard_True)->NbFails() > 0) return true;
  }
  return false;
}

}  // namespace

Handle(Standard_Transient) withoutLengthUnit(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    // A context that cannot be read makes its shapes faulty; OpenCASCADE builds them all the same.
    const auto shape = Handle(StepShape_ShapeRepresentation)::DownCast(
        model->IsErrorEntity(i) ? model->ReportEntity(i)->Concerned() : model->Value(i));
    if (shape.IsNull() || shape->Items().IsNull()) continue;
    const Handle(StepRepr_GlobalUnitAssignedContext) units = unitsOf(shape->ContextOfItems());
    STEPConstruct_UnitContext context;
    if (!units.IsNull() && !units->Units().IsNull()) context.ComputeFactors(units);
    if (!context.LengthDone() || haveFaults(*units, model)) return model->Value(i);
  }
  return nullptr;
}

std::optional<double> angleUnit(const Handle(Interface_InterfaceModel) & model) {
  std::optional<double> unit;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    if (model->IsErrorEntity(i)) continue;
    const Handle(StepRepr_GlobalUnitAssignedContext) units = unitsOf(model->Value(i));
    if (units.IsNull()) continue;
    STEPConstruct_UnitContext context;
    context.ComputeFactors(units);
    if (!context.PlaneAngleDone()) continue;
    if (unit && *unit != context.PlaneAngleFactor()) return std::nullopt;
    unit = context.PlaneAngleFactor();
  }
  return unit;
}

}  // namespace probewright::simulation
