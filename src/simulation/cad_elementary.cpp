#include "simulation/cad_elementary.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_SurfaceOfLinearExtrusion.hxx>
#include <GeomAdaptor_SurfaceOfRevolution.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <vector>

#include "simulation/cad_face.hpp"

namespace probewright::simulation {
namespace {

/// A face, and its surface before and after, both without the face's location.
struct Change {
  TopoDS_Face face;
  Handle(Geom_Surface) before, after;
  TopLoc_Location location;
};

/// The cylinder or cone that a surface is; null where it is neither.
Handle(Geom_Surface) elementaryOf(const Handle(Geom_Surface) & surface) {
  if (const auto turned = Handle(Geom_SurfaceOfRevolution)::DownCast(surface)) {
    const GeomAdaptor_SurfaceOfRevolution known(new GeomAdaptor_Curve(turned->BasisCurve()), turned->Axis());
    if (known.GetType() == GeomAbs_Cylinder) return new Geom_CylindricalSurface(known.Cylinder());
    if (known.GetType() == GeomAbs_Cone) return new Geom_ConicalSurface(known.Cone());
  }
  if (const auto pulled = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface)) {
    const GeomAdaptor_SurfaceOfLinearExtrusion known(new GeomAdaptor_Curve(pulled->BasisCurve()), pulled->Direction());
    if (known.GetType() == GeomAbs_Cylinder) return new Geom_CylindricalSurface(known.Cylinder());
  }
  return nullptr;
}

/// True if all parameters of a face have the places and the side of the normals that they had.
bool isSame(const Change& change) {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  BRepTools::UVBounds(change.face, u0, u1, v0, v1);
  constexpr int kSteps = 4;
  constexpr double kSamePlace = 1e-7;  // mm
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const double u = u0 + (u1 - u0) * i / kSteps, v = v0 + (v1 - v0) * k / kSteps;
      if (!(change.after->Value(u, v).Distance(change.before->Value(u, v)) <= kSamePlace)) return false;
      GeomLProp_SLProps before(change.before, u, v, 1, kSamePlace), after(change.after, u, v, 1, kSamePlace);
      const bool known = before.IsNormalDefined() && after.IsNormalDefined();
      if (known && !(before.Normal().Dot(after.Normal()) > 0)) return false;
    }
  }
  return true;
}

std::vector<Change> changesOf(const TopoDS_Shape& shape) {
  std::vector<Change> changes;
  TopTools_MapOfShape seen;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    // Instances share what is changed.
    const TopoDS_Face face = TopoDS::Face(faces.Current().Located(TopLoc_Location()).Oriented(TopAbs_FORWARD));
    if (!seen.Add(face)) continue;
    Change change{face, {}, {}, {}};
    change.before = BRep_Tool::Surface(face, change.location);
    if (change.before.IsNull()) continue;
    change.after = elementaryOf(surfaceWithoutLimits(change.before));
    if (!change.after.IsNull() && isSame(change)) changes.push_back(std::move(change));
  }
  return changes;
}

void carryOut(const Change& change) {
  const BRep_Builder builder;
  for (TopExp_Explorer edges(change.face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current().Oriented(TopAbs_FORWARD));
    double first = 0, last = 0;
    const auto curve = BRep_Tool::CurveOnSurface(edge, change.before, change.location, first, last);
    if (curve.IsNull()) continue;
    const double tolerance = BRep_Tool::Tolerance(edge);
    if (BRep_Tool::IsClosed(edge, change.before, change.location)) {
      const auto other =
          BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), change.before, change.location, first, last);
      builder.UpdateEdge(edge, curve, other, change.after, change.location, tolerance);
    } else {
      builder.UpdateEdge(edge, curve, change.after, change.location, tolerance);
    }
    builder.Range(edge, change.after, change.location, first, last);
  }
  builder.UpdateFace(change.face, change.after, change.location, BRep_Tool::Tolerance(change.face));
}

}  // namespace

void takeElementarySurfaces(const TopoDS_Shape& shape) {
  for (const Change& change : changesOf(shape))
    carryOut(change);
}

TopoDS_Shape withElementarySurfaces(const TopoDS_Shape& shape) {
  if (changesOf(shape).empty()) return shape;
  const TopoDS_Shape copy = BRepBuilderAPI_Copy(shape, Standard_False).Shape();
  takeElementarySurfaces(copy);
  return copy;
}

}  // namespace probewright::simulation
