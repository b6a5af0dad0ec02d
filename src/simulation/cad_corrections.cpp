#include "simulation/cad_corrections.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_OffsetSurface.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_ConicalSurface.hxx>
#include <StepGeom_CylindricalSurface.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_Line.hxx>
#include <StepGeom_OffsetSurface.hxx>
#include <StepGeom_Plane.hxx>
#include <StepGeom_SphericalSurface.hxx>
#include <StepGeom_SurfaceOfRevolution.hxx>
#include <StepGeom_ToroidalSurface.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepShape_FaceBound.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_Loop.hxx>
#include <StepShape_VertexLoop.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <XSControl_Reader.hxx>
#include <XSControl_WorkSession.hxx>
#include <cmath>

namespace probewright::simulation {
namespace {

gp_Vec vectorOf(const Handle(StepGeom_Direction) & direction, const gp_Vec& otherwise) {
  if (direction.IsNull() || direction->NbDirectionRatios() < 3) return otherwise;
  return {direction->DirectionRatiosValue(1), direction->DirectionRatiosValue(2), direction->DirectionRatiosValue(3)};
}

bool scalesOrMirrors(const StepGeom_CartesianTransformationOperator3d& placement) {
  if (placement.HasScale() && std::abs(placement.Scale() - 1) > 1e-9) return true;
  const gp_Vec x = vectorOf(placement.Axis1(), gp_Vec(1, 0, 0)), y = vectorOf(placement.Axis2(), gp_Vec(0, 1, 0));
  return x.Crossed(y).Dot(vectorOf(placement.Axis3(), x.Crossed(y))) < 0;
}

bool isLine(Handle(StepGeom_Curve) curve) {
  while (const auto trimmed = Handle(StepGeom_TrimmedCurve)::DownCast(curve))
    curve = trimmed->BasisCurve();
  return !curve.IsNull() && curve->IsKind(STANDARD_TYPE(StepGeom_Line));
}

Handle(TCollection_HAsciiString) noName() { return new TCollection_HAsciiString(""); }

/// A plane moved along its normal; null where it has none to move along.
Handle(StepGeom_Surface) movedPlane(const StepGeom_Plane& plane, double distance) {
  const Handle(StepGeom_Axis2Placement3d) axes = plane.Position();
  if (axes.IsNull() || axes->Location().IsNull() || axes->Location()->NbCoordinates() < 3) return nullptr;
  const gp_Vec normal = vectorOf(axes->HasAxis() ? axes->Axis() : nullptr, gp_Vec(0, 0, 1));
  if (normal.Magnitude() < 1e-12) return nullptr;
  const Handle(TColStd_HArray1OfReal) moved = new TColStd_HArray1OfReal(1, 3);
  for (int i = 1; i <= 3; ++i)
    moved->SetValue(i, axes->Location()->CoordinatesValue(i) + distance * normal.Normalized().Coord(i));
  const Handle(StepGeom_CartesianPoint) place = new StepGeom_CartesianPoint;
  place->Init(noName(), moved);
  const Handle(StepGeom_Axis2Placement3d) there = new StepGeom_Axis2Placement3d;
  there->Init(noName(), place, axes->HasAxis(), axes->Axis(), axes->HasRefDirection(), axes->RefDirection());
  const Handle(StepGeom_Plane) made = new StepGeom_Plane;
  made->Init(noName(), there);
  return Handle(StepGeom_Surface)(made.get());
}

/// What the offset of a surface is; null if that is not a plain surface, or one turned inside out.
Handle(StepGeom_Surface) plainOffset(const StepGeom_OffsetSurface& offset) {
  const double distance = offset.Distance();
  const Handle(StepGeom_Surface) basis = offset.BasisSurface();
  if (const auto plane = Handle(StepGeom_Plane)::DownCast(basis)) return movedPlane(*plane, distance);
  Handle(StepGeom_Surface) made;
  if (const auto cylinder = Handle(StepGeom_CylindricalSurface)::DownCast(basis)) {
    if (cylinder->Radius() + distance <= 0) return nullptr;
    const Handle(StepGeom_CylindricalSurface) grown = new StepGeom_CylindricalSurface;
    grown->Init(noName(), cylinder->Position(), cylinder->Radius() + distance);
    made = grown;
  } else if (const auto sphere = Handle(StepGeom_SphericalSurface)::DownCast(basis)) {
    if (sphere->Radius() + distance <= 0) return nullptr;
    const Handle(StepGeom_SphericalSurface) grown = new StepGeom_SphericalSurface;
    grown->Init(noName(), sphere->Position(), sphere->Radius() + distance);
    made = grown;
  } else if (const auto torus = Handle(StepGeom_ToroidalSurface)::DownCast(basis)) {
    const double tube = torus->MinorRadius() + distance;
    if (tube <= 0 || tube >= torus->MajorRadius() || torus->MinorRadius() >= torus->MajorRadius()) return nullptr;
    const Handle(StepGeom_ToroidalSurface) grown = new StepGeom_ToroidalSurface;
    grown->Init(noName(), torus->Position(), torus->MajorRadius(), tube);
    made = grown;
  }
  return made;
}

}  // namespace

Handle(Standard_Transient) misreadPlacement(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto placement = Handle(StepGeom_CartesianTransformationOperator3d)::DownCast(model->Value(i));
    if (!placement.IsNull() && !model->IsErrorEntity(i) && scalesOrMirrors(*placement))
      return Handle(Standard_Transient)(placement.get());
    const auto instance = Handle(IGESBasic_SingularSubfigure)::DownCast(model->Value(i));
    if (!instance.IsNull() && !model->IsErrorEntity(i) && std::abs(instance->ScaleFactor() - 1) > 1e-9)
      return Handle(Standard_Transient)(instance.get());
  }
  return nullptr;
}

Handle(Standard_Transient) unreadableOffset(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model->Value(i));
    if (face.IsNull() || model->IsErrorEntity(i)) continue;
    const auto offset = Handle(StepGeom_OffsetSurface)::DownCast(face->FaceGeometry());
    if (!offset.IsNull() && offset->BasisSurface()->IsKind(STANDARD_TYPE(StepGeom_ConicalSurface)))
      return Handle(Standard_Transient)(offset.get());
  }
  return nullptr;
}

Handle(Standard_Transient) unreadableApex(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model->Value(i));
    if (face.IsNull() || model->IsErrorEntity(i) || face->FaceGeometry().IsNull()) continue;
    const auto turned = Handle(StepGeom_SurfaceOfRevolution)::DownCast(face->FaceGeometry());
    if (turned.IsNull() || !isLine(turned->SweptCurve())) continue;
    for (int k = 1; k <= face->NbBounds(); ++k) {
      const Handle(StepShape_FaceBound) bound = face->BoundsValue(k);
      if (!bound.IsNull() && !bound->Bound().IsNull() && bound->Bound()->IsKind(STANDARD_TYPE(StepShape_VertexLoop)))
        return Handle(Standard_Transient)(face.get());
    }
  }
  return nullptr;
}

void takePlainOffsets(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model->Value(i));
    if (face.IsNull() || model->IsErrorEntity(i)) continue;
    const auto offset = Handle(StepGeom_OffsetSurface)::DownCast(face->FaceGeometry());
    if (offset.IsNull()) continue;
    if (const Handle(StepGeom_Surface) plain = plainOffset(*offset); !plain.IsNull()) face->SetFaceGeometry(plain);
  }
}

void turnOffsets(XSControl_Reader& reader) {
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto offset = Handle(IGESGeom_OffsetSurface)::DownCast(model->Value(i));
    if (offset.IsNull() || model->IsErrorEntity(i) || offset->Surface().IsNull()) continue;
    reader.ClearShapes();
    if (!reader.TransferEntity(offset->Surface())) continue;
    for (TopExp_Explorer faces(reader.OneShape(), TopAbs_FACE); faces.More(); faces.Next()) {
      const BRepAdaptor_Surface surface(TopoDS::Face(faces.Current()));
      gp_Pnt middle;
      gp_Vec alongU, alongV;
      surface.D1((surface.FirstUParameter() + surface.LastUParameter()) / 2,
                 (surface.FirstVParameter() + surface.LastVParameter()) / 2, middle, alongU, alongV);
      if (alongU.Crossed(alongV).Dot(offset->OffsetIndicator()) < 0)
        offset->Init(offset->OffsetIndicator().XYZ(), -offset->Distance(), offset->Surface());
      break;
    }
  }
  reader.ClearShapes();
}

double scaleOf(const Handle(Interface_InterfaceModel) & model) {
  const auto iges = Handle(IGESData_IGESModel)::DownCast(model);
  if (iges.IsNull()) return 1;
  const double scale = iges->GlobalSection().Scale();
  return scale > 0 && std::abs(scale - 1) > 1e-9 ? scale : 1;
}

}  // namespace probewright::simulation
