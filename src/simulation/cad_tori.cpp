#include "simulation/cad_tori.hpp"

#include <StepGeom_Axis1Placement.hxx>
#include <StepGeom_Axis2Placement.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_Circle.hxx>
#include <StepGeom_DegenerateToroidalSurface.hxx>
#include <StepGeom_HArray1OfTrimmingSelect.hxx>
#include <StepGeom_SurfaceOfRevolution.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepGeom_TrimmingSelect.hxx>
#include <StepShape_FaceSurface.hxx>
#include <cmath>

#include "simulation/step_places.hpp"

namespace probewright::simulation {
namespace {

Handle(StepGeom_HArray1OfTrimmingSelect) at(const Vector3& place) {
  StepGeom_TrimmingSelect end;
  end.SetValue(pointAt(place));
  const Handle(StepGeom_HArray1OfTrimmingSelect) ends = new StepGeom_HArray1OfTrimmingSelect(1, 1);
  ends->SetValue(1, end);
  return ends;
}

/// Null where the entity does not say enough.
Handle(StepGeom_Surface) turnedArc(const StepGeom_DegenerateToroidalSurface& torus) {
  const Handle(StepGeom_Axis2Placement3d) axes = torus.Position();
  const double ring = torus.MajorRadius(), tube = torus.MinorRadius();
  if (axes.IsNull() || !(ring > 0) || !(tube > ring)) return nullptr;
  const auto centre = vectorOf(axes->Location());
  const auto axis = axes->HasAxis() ? unitOf(axes->Axis()) : Vector3(Vector3::UnitZ());
  if (!centre || !axis) return nullptr;
  const auto wanted = axes->HasRefDirection() ? unitOf(axes->RefDirection()) : std::nullopt;
  Vector3 out = wanted ? *wanted : Vector3(Vector3::UnitX());
  out -= out.dot(*axis) * *axis;
  out = out.norm() > 1e-9 ? Vector3(out.normalized()) : axis->unitOrthogonal();

  // Round the circle against the other axis, the arc goes from the lower place on the axis to the upper one.
  const Handle(StepGeom_Axis2Placement3d) middle = new StepGeom_Axis2Placement3d;
  middle->Init(noName(), pointAt(*centre + (torus.SelectOuter() ? ring : -ring) * out), Standard_True,
               along(out.cross(*axis)), Standard_True, along(out));
  StepGeom_Axis2Placement place;
  place.SetValue(middle);
  const Handle(StepGeom_Circle) circle = new StepGeom_Circle;
  circle->Init(noName(), place, tube);
  const double rise = std::sqrt(tube * tube - ring * ring);
  const Handle(StepGeom_TrimmedCurve) arc = new StepGeom_TrimmedCurve;
  arc->Init(noName(), circle, at(*centre - rise * *axis), at(*centre + rise * *axis), Standard_True,
            StepGeom_tpCartesian);
  const Handle(StepGeom_Axis1Placement) about = new StepGeom_Axis1Placement;
  about->Init(noName(), axes->Location(), Standard_True, along(*axis));
  const Handle(StepGeom_SurfaceOfRevolution) made = new StepGeom_SurfaceOfRevolution;
  made->Init(noName(), arc, about);
  return Handle(StepGeom_Surface)(made.get());
}

}  // namespace

void turnArcs(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model->Value(i));
    if (face.IsNull() || model->IsErrorEntity(i)) continue;
    const auto torus = Handle(StepGeom_DegenerateToroidalSurface)::DownCast(face->FaceGeometry());
    if (torus.IsNull()) continue;
    const Handle(StepGeom_Surface) turned = turnedArc(*torus);
    if (!turned.IsNull()) face->SetFaceGeometry(turned);
  }
}

}  // namespace probewright::simulation
