#include "simulation/cad_elementary.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <ElSLib.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_SurfaceOfLinearExtrusion.hxx>
#include <GeomAdaptor_SurfaceOfRevolution.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>
#include <gp_Circ.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <gp_Vec2d.hxx>
#include <vector>

#include "simulation/cad_face.hpp"
#include "simulation/cad_vectors.hpp"

namespace probewright::simulation {
namespace {

/// A face, and its surface before and after, both without the face's location.
struct Change {
  TopoDS_Face face;
  Handle(Geom_Surface) before, after;
  TopLoc_Location location;
  gp_Vec2d shift;  ///< of the parameters
};

/// The sphere or torus that a circle makes that is turned about an axis; null where it makes neither. `out` is a place
/// on the part of the circle that is turned. Tori that meet themselves remain arcs that are turned, as OpenCASCADE
/// cannot tell their two sheets.
Handle(Geom_Surface) turnedCircle(const gp_Circ& circle, const gp_Ax1& axis, const gp_Pnt& out) {
  constexpr double kNearly = 1e-9;
  const Vector3 along = vector(axis.Direction()), normal = vector(circle.Axis().Direction());
  const auto across = [&](const gp_Pnt& place) {
    const Vector3 arm = vector(place) - vector(axis.Location());
    return Vector3(arm - arm.dot(along) * along);
  };
  const Vector3 ring = across(circle.Location());
  const bool isSphere = ring.norm() <= kNearly * circle.Radius();
  if (!isSphere && !(ring.norm() > (1 + 1e-6) * circle.Radius())) return nullptr;
  const Vector3 x = (isSphere ? across(out) : ring).normalized(), z = normal.cross(x);
  const double sense = z.dot(along);
  if (!(std::abs(sense) > 1 - kNearly)) return nullptr;
  const Vector3 middle = vector(circle.Location()) - ring;
  const auto direction = [](const Vector3& v) { return gp_Dir(v.x(), v.y(), v.z()); };
  gp_Ax3 place(gp_Pnt(middle.x(), middle.y(), middle.z()), direction(sense > 0 ? along : -along), direction(x));
  // The angle about the axis grows as it did.
  if (sense < 0) place.YReverse();
  if (isSphere) return new Geom_SphericalSurface(place, circle.Radius());
  return new Geom_ToroidalSurface(place, ring.norm(), circle.Radius());
}

/// The cylinder, cone, sphere or torus that a surface is; null where it is none of them. `middle` lies on the part that
/// is used.
Handle(Geom_Surface) elementaryOf(const Handle(Geom_Surface) & surface, const gp_Pnt2d& middle) {
  if (const auto turned = Handle(Geom_SurfaceOfRevolution)::DownCast(surface)) {
    if (const auto circle = Handle(Geom_Circle)::DownCast(turned->BasisCurve()))
      return turnedCircle(circle->Circ(), turned->Axis(), circle->Value(middle.Y()));
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

/// By how much the parameters of a place on the surface after exceed those before; those of lines are the same.
gp_Vec2d shiftAt(const Change& change, const gp_Pnt2d& before) {
  const gp_Pnt place = change.before->Value(before.X(), before.Y());
  double u = before.X(), v = before.Y();
  if (const auto sphere = Handle(Geom_SphericalSurface)::DownCast(change.after))
    ElSLib::Parameters(sphere->Sphere(), place, u, v);
  if (const auto torus = Handle(Geom_ToroidalSurface)::DownCast(change.after))
    ElSLib::Parameters(torus->Torus(), place, u, v);
  return {u - before.X(), v - before.Y()};
}

/// True if all parameters of a face, shifted, have the places and the side of the normals that they had.
bool finds(Change& change) {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  BRepTools::UVBounds(change.face, u0, u1, v0, v1);
  const gp_Pnt2d middle((u0 + u1) / 2, (v0 + v1) / 2);
  change.after = elementaryOf(surfaceWithoutLimits(change.before), middle);
  if (change.after.IsNull()) return false;
  change.shift = shiftAt(change, middle);
  constexpr int kSteps = 4;
  constexpr double kSamePlace = 1e-7;  // mm
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const double u = u0 + (u1 - u0) * i / kSteps, v = v0 + (v1 - v0) * k / kSteps;
      const double nowU = u + change.shift.X(), nowV = v + change.shift.Y();
      if (!(change.after->Value(nowU, nowV).Distance(change.before->Value(u, v)) <= kSamePlace)) return false;
      GeomLProp_SLProps before(change.before, u, v, 1, kSamePlace), after(change.after, nowU, nowV, 1, kSamePlace);
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
    Change change{face, {}, {}, {}, {}};
    change.before = BRep_Tool::Surface(face, change.location);
    if (change.before.IsNull()) continue;
    if (finds(change)) changes.push_back(std::move(change));
  }
  return changes;
}

void carryOut(const Change& change) {
  const BRep_Builder builder;
  for (TopExp_Explorer edges(change.face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current().Oriented(TopAbs_FORWARD));
    double first = 0, last = 0;
    const auto shifted = [&](const TopoDS_Edge& side) -> Handle(Geom2d_Curve) {
      const auto curve = BRep_Tool::CurveOnSurface(side, change.before, change.location, first, last);
      if (curve.IsNull()) return nullptr;
      return Handle(Geom2d_Curve)::DownCast(curve->Translated(change.shift));
    };
    const Handle(Geom2d_Curve) curve = shifted(edge);
    if (curve.IsNull()) continue;
    const double tolerance = BRep_Tool::Tolerance(edge);
    if (BRep_Tool::IsClosed(edge, change.before, change.location)) {
      const Handle(Geom2d_Curve) other = shifted(TopoDS::Edge(edge.Reversed()));
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
