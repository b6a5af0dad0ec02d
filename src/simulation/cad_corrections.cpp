#include "simulation/cad_corrections.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_Boundary.hxx>
#include <IGESGeom_CurveOnSurface.hxx>
#include <IGESGeom_OffsetSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <IGESToBRep_CurveAndSurface.hxx>
#include <Interface_Check.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_ReportEntity.hxx>
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
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <Transfer_TransientProcess.hxx>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

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

bool lacksOnlyTexts(const Interface_Check& check) {
  for (int i = 1; i <= check.NbFails(); ++i) {
    if (!std::string_view(check.CFail(i)).ends_with("not a quoted String")) return false;
  }
  return check.NbFails() > 0;
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

void acceptMissingTexts(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    if (model->IsErrorEntity(i) && lacksOnlyTexts(*model->ReportEntity(i)->Check())) model->ClearReportEntity(i);
  }
}

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

namespace {

/// The shape of a single entity, made apart from the part: what the part's reader has once made it takes again, a
/// surface with its parameters in another scale than its borders in the file.
TopoDS_Shape lookedAt(const Handle(IGESData_IGESModel) & model, const Handle(IGESData_IGESEntity) & entity) {
  IGESToBRep_CurveAndSurface tool;
  tool.SetModel(model);
  const Handle(Transfer_TransientProcess) process = new Transfer_TransientProcess;
  process->SetModel(model);
  tool.SetTransferProcess(process);
  tool.SetEpsGeom(model->GlobalSection().Resolution() * tool.GetUnitFactor());
  return tool.TransferGeometry(entity);
}

/// The curves in space of the borders of faces on a surface.
std::vector<Handle(IGESData_IGESEntity)> bordersOn(const Handle(Interface_InterfaceModel) & model,
                                                   const Handle(IGESData_IGESEntity) & surface) {
  std::vector<Handle(IGESData_IGESEntity)> curves;
  const auto add = [&](const Handle(IGESGeom_CurveOnSurface) & border) {
    if (!border.IsNull() && !border->Curve3D().IsNull()) curves.push_back(border->Curve3D());
  };
  for (int i = 1; i <= model->NbEntities(); ++i) {
    if (model->IsErrorEntity(i)) continue;
    if (const auto face = Handle(IGESGeom_TrimmedSurface)::DownCast(model->Value(i)); !face.IsNull()) {
      if (face->Surface() != surface) continue;
      if (face->HasOuterContour()) add(face->OuterContour());
      for (int k = 1; k <= face->NbInnerContours(); ++k)
        add(face->InnerContour(k));
    }
    if (const auto border = Handle(IGESGeom_Boundary)::DownCast(model->Value(i)); !border.IsNull()) {
      if (border->Surface() != surface) continue;
      for (int k = 1; k <= border->NbModelSpaceCurves(); ++k)
        curves.push_back(border->ModelSpaceCurve(k));
    }
  }
  return curves;
}

/// On which side of its basis an offset surface lies by the borders of faces on it: along the normal 1, against it -1;
/// nothing where they do not tell.
std::optional<int> sideOfBorders(const Handle(IGESData_IGESModel) & model,
                                 const Handle(IGESGeom_OffsetSurface) & offset, const Handle(Geom_Surface) & basis) {
  int along = 0, against = 0;
  for (const Handle(IGESData_IGESEntity) & border : bordersOn(model, offset)) {
    const TopoDS_Shape shape = lookedAt(model, border);
    if (shape.IsNull()) continue;
    for (TopExp_Explorer edges(shape, TopAbs_EDGE); edges.More(); edges.Next()) {
      double first = 0, last = 0;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges.Current()), first, last);
      if (curve.IsNull()) continue;
      for (const double share : {0.1, 0.5, 0.9}) {
        const gp_Pnt place = curve->Value(first + share * (last - first));
        const GeomAPI_ProjectPointOnSurf feet(place, basis);
        if (feet.NbPoints() == 0) continue;
        double u = 0, v = 0;
        feet.LowerDistanceParameters(u, v);
        gp_Pnt foot;
        gp_Vec alongU, alongV;
        basis->D1(u, v, foot, alongU, alongV);
        const gp_Vec way(foot, place), normal = alongU.Crossed(alongV);
        constexpr double kUpright = 0.99;
        const double rise = way.Dot(normal);
        if (std::abs(rise) > kUpright * way.Magnitude() * normal.Magnitude()) ++(rise > 0 ? along : against);
      }
    }
  }
  if ((along == 0) == (against == 0)) return std::nullopt;
  return along > 0 ? 1 : -1;
}

}  // namespace

void turnOffsets(const Handle(Interface_InterfaceModel) & entities) {
  const auto model = Handle(IGESData_IGESModel)::DownCast(entities);
  for (int i = 1; !model.IsNull() && i <= model->NbEntities(); ++i) {
    const auto offset = Handle(IGESGeom_OffsetSurface)::DownCast(model->Value(i));
    if (offset.IsNull() || model->IsErrorEntity(i) || offset->Surface().IsNull()) continue;
    const TopoDS_Shape basis = lookedAt(model, offset->Surface());
    if (basis.IsNull()) continue;
    for (TopExp_Explorer faces(basis, TopAbs_FACE); faces.More(); faces.Next()) {
      const BRepAdaptor_Surface surface(TopoDS::Face(faces.Current()));
      // Some systems write the vector of another place; what runs on the surface tells better.
      if (const auto side = sideOfBorders(model, offset, BRep_Tool::Surface(TopoDS::Face(faces.Current())))) {
        if (*side * offset->Distance() < 0)
          offset->Init(offset->OffsetIndicator().XYZ(), -offset->Distance(), offset->Surface());
        break;
      }
      gp_Pnt middle;
      gp_Vec alongU, alongV;
      surface.D1((surface.FirstUParameter() + surface.LastUParameter()) / 2,
                 (surface.FirstVParameter() + surface.LastVParameter()) / 2, middle, alongU, alongV);
      if (alongU.Crossed(alongV).Dot(offset->OffsetIndicator()) < 0)
        offset->Init(offset->OffsetIndicator().XYZ(), -offset->Distance(), offset->Surface());
      break;
    }
  }
}

double scaleOf(const Handle(Interface_InterfaceModel) & model) {
  const auto iges = Handle(IGESData_IGESModel)::DownCast(model);
  if (iges.IsNull()) return 1;
  const double scale = iges->GlobalSection().Scale();
  return scale > 0 && std::abs(scale - 1) > 1e-9 ? scale : 1;
}

}  // namespace probewright::simulation
