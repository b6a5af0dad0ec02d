#include "simulation/cad_units.hpp"

#include <Interface_ReportEntity.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <string_view>

namespace probewright::simulation {
namespace {

Handle(StepRepr_GlobalUnitAssignedContext) unitsOf(const Handle(Standard_Transient) & context) {
  if (const auto with = Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)::DownCast(context))
    return with->GlobalUnitAssignedContext();
  if (const auto with = Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(context))
    return with->GlobalUnitAssignedContext();
  return Handle(StepRepr_GlobalUnitAssignedContext)::DownCast(context);
}

/// True if a unit of length cannot be read: one wrong letter in METRE makes a thousand of a length.
bool hasFaultyLengthUnit(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    if (!model->IsErrorEntity(i)) continue;
    const Handle(Standard_Transient) entity = model->ReportEntity(i)->Concerned();
    if (!entity.IsNull() && std::string_view(entity->DynamicType()->Name()).ends_with("LengthUnit")) return true;
  }
  return false;
}

}  // namespace

Handle(Standard_Transient) withoutLengthUnit(const Handle(Interface_InterfaceModel) & model) {
  const bool isFaulty = hasFaultyLengthUnit(model);
  for (int i = 1; i <= model->NbEntities(); ++i) {
    // A context that cannot be read makes its shapes faulty; OpenCASCADE builds them all the same.
    const auto shape = Handle(StepShape_ShapeRepresentation)::DownCast(
        model->IsErrorEntity(i) ? model->ReportEntity(i)->Concerned() : model->Value(i));
    if (shape.IsNull() || shape->Items().IsNull()) continue;
    const Handle(StepRepr_GlobalUnitAssignedContext) units = unitsOf(shape->ContextOfItems());
    STEPConstruct_UnitContext context;
    if (!units.IsNull() && !units->Units().IsNull()) context.ComputeFactors(units);
    if (isFaulty || !context.LengthDone()) return model->Value(i);
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
