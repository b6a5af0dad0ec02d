#include "simulation/cad_cones.hpp"

#include <StepGeom_Axis1Placement.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_ConicalSurface.hxx>
#include <StepGeom_Line.hxx>
#include <StepGeom_OffsetSurface.hxx>
#include <StepGeom_SurfaceOfRevolution.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepGeom_Vector.hxx>
#include <StepShape_EdgeLoop.hxx>
#include <StepShape_FaceBound.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_Loop.hxx>
#include <StepShape_OrientedEdge.hxx>
#include <StepShape_VertexLoop.hxx>
#include <StepShape_VertexPoint.hxx>
#include <cmath>
#include <optional>

#include "simulation/cad_units.hpp"
#include "simulation/step_places.hpp"

namespace probewright::simulation {
namespace {

Handle(StepGeom_Surface) cone(const Handle(StepGeom_Axis2Placement3d) & axes, double radius, double semiAngle) {
  const Handle(StepGeom_ConicalSurface) made = new StepGeom_ConicalSurface;
  made->Init(noName(), axes, radius, semiAngle);
  return Handle(StepGeom_Surface)(made.get());
}

/// The offset of a cone is the same cone farther along its axis; null where the entity does not say enough.
Handle(StepGeom_Surface) movedCone(const StepGeom_ConicalSurface& basis, double distance, double unit) {
  const Handle(StepGeom_Axis2Placement3d) axes = basis.Position();
  if (axes.IsNull()) return nullptr;
  const auto place = vectorOf(axes->Location());
  const auto axis = axes->HasAxis() ? unitOf(axes->Axis()) : Vector3(Vector3::UnitZ());
  const double slope = std::sin(basis.SemiAngle() * unit);
  if (!place || !axis || std::abs(slope) < 1e-9) return nullptr;
  const Handle(StepGeom_Axis2Placement3d) there = new StepGeom_Axis2Placement3d;
  there->Init(noName(), pointAt(*place - distance / slope * *axis), axes->HasAxis(), axes->Axis(),
              axes->HasRefDirection(), axes->RefDirection());
  return cone(there, basis.Radius(), basis.SemiAngle());
}

Handle(StepGeom_Line) lineOf(Handle(StepGeom_Curve) curve) {
  while (const auto trimmed = Handle(StepGeom_TrimmedCurve)::DownCast(curve))
    curve = trimmed->BasisCurve();
  return Handle(StepGeom_Line)::DownCast(curve);
}

/// A place on an edge of a face that is also bounded by a mere vertex; nothing for other faces.
std::optional<Vector3> edgeBesideVertex(const StepShape_FaceSurface& face) {
  std::optional<Vector3> place;
  bool hasVertex = false;
  for (int k = 1; k <= face.NbBounds(); ++k) {
    const Handle(StepShape_FaceBound) bound = face.BoundsValue(k);
    if (bound.IsNull() || bound->Bound().IsNull()) continue;
    hasVertex = hasVertex || bound->Bound()->IsKind(STANDARD_TYPE(StepShape_VertexLoop));
    const auto loop = Handle(StepShape_EdgeLoop)::DownCast(bound->Bound());
    if (loop.IsNull() || loop->NbEdgeList() == 0 || loop->EdgeListValue(1).IsNull()) continue;
    const auto vertex = Handle(StepShape_VertexPoint)::DownCast(loop->EdgeListValue(1)->EdgeStart());
    if (!vertex.IsNull()) place = vectorOf(Handle(StepGeom_CartesianPoint)::DownCast(vertex->VertexGeometry()));
  }
  return hasVertex ? place : std::nullopt;
}

struct TurnedLine {
  Handle(StepGeom_Surface) cone;
  bool isTurnedOver = false;  ///< its normal, outwards, is against that of the surface of revolution
};

/// The cone that a line makes when it turns about an axis, on that side of the apex where `place` lies; null where it
/// makes something else.
TurnedLine turnedLine(const StepGeom_SurfaceOfRevolution& surface, const Vector3& place, double unit) {
  const Handle(StepGeom_Line) line = lineOf(surface.SweptCurve());
  const Handle(StepGeom_Axis1Placement) axes = surface.AxisPosition();
  if (line.IsNull() || line->Dir().IsNull() || axes.IsNull()) return {};
  const auto start = vectorOf(line->Pnt()), centre = vectorOf(axes->Location());
  const auto way = unitOf(line->Dir()->Orientation());
  const auto axis = axes->HasAxis() ? unitOf(axes->Axis()) : Vector3(Vector3::UnitZ());
  if (!start || !centre || !way || !axis) return {};
  const double rise = way->dot(*axis), semiAngle = std::atan2((*way - rise * *axis).norm(), std::abs(rise));
  constexpr double flat = 1e-6;
  if (semiAngle < flat || semiAngle > std::numbers::pi / 2 - flat) return {};
  // Where the line is nearest to the axis: at the apex, if it meets it at all.
  const Vector3 out = *start - *centre, across = out - out.dot(*axis) * *axis, climb = *way - rise * *axis;
  const Vector3 apex = *start - across.dot(climb) / climb.squaredNorm() * *way;
  const Vector3 onAxis = *centre + (apex - *centre).dot(*axis) * *axis;
  const double height = (place - onAxis).dot(*axis);
  if ((apex - onAxis).norm() > 1e-6 * std::abs(height) || height == 0) return {};
  const Vector3 up = height > 0 ? *axis : Vector3(-*axis);
  const Handle(StepGeom_Axis2Placement3d) there = new StepGeom_Axis2Placement3d;
  there->Init(noName(), pointAt(onAxis + std::abs(height) * up), Standard_True, along(up), Standard_False, nullptr);
  return {cone(there, std::abs(height) * std::tan(semiAngle), semiAngle / unit), rise < 0};
}

}  // namespace

void takePlainCones(const Handle(Interface_InterfaceModel) & model) {
  std::optional<double> unit;
  bool isKnown = false;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model->Value(i));
    if (face.IsNull() || model->IsErrorEntity(i)) continue;
    const auto offset = Handle(StepGeom_OffsetSurface)::DownCast(face->FaceGeometry());
    const auto basis = Handle(StepGeom_ConicalSurface)::DownCast(offset.IsNull() ? Handle(StepGeom_Surface)()
                                                                                 : offset->BasisSurface());
    const auto turned = Handle(StepGeom_SurfaceOfRevolution)::DownCast(face->FaceGeometry());
    if (basis.IsNull() && turned.IsNull()) continue;
    if (!isKnown) unit = angleUnit(model);
    isKnown = true;
    if (!unit) return;
    if (!basis.IsNull()) {
      const Handle(StepGeom_Surface) moved = movedCone(*basis, offset->Distance(), *unit);
      if (!moved.IsNull()) face->SetFaceGeometry(moved);
    } else if (const auto place = edgeBesideVertex(*face)) {
      const TurnedLine made = turnedLine(*turned, *place, *unit);
      if (made.cone.IsNull()) continue;
      face->SetFaceGeometry(made.cone);
      if (made.isTurnedOver) face->SetSameSense(!face->SameSense());
    }
  }
}

}  // namespace probewright::simulation
