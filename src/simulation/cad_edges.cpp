#include "simulation/cad_edges.hpp"

#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_TEdge.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <cmath>

namespace probewright::simulation {
namespace {

constexpr double kOfReaders = 1e-5;  ///< mm: how exactly readers make curves in space of those on surfaces
constexpr double kOurs = 1e-7;       ///< mm

/// By how much the curve of an edge leaves the place that its curve on a surface gives at the same parameter; nothing
/// of that is known where there is no such curve: 0.
double endsApart(const TopoDS_Edge& edge) {
  double first = 0, last = 0, from = 0, to = 0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  Handle(Geom2d_Curve) onSurface;
  Handle(Geom_Surface) surface;
  TopLoc_Location place;
  BRep_Tool::CurveOnSurface(edge, onSurface, surface, place, from, to);
  if (onSurface.IsNull() || surface.IsNull() || from != first || to != last) return 0;
  double deviation = 0;
  constexpr int kPlaces = 40;
  for (int i = 0; i <= kPlaces; ++i) {
    const double t = first + (last - first) * i / kPlaces;
    const gp_Pnt2d uv = onSurface->Value(t);
    const gp_Pnt there = surface->Value(uv.X(), uv.Y()).Transformed(place.Transformation());
    deviation = std::max(deviation, curve->Value(t).Distance(there));
  }
  return deviation;
}

/// True if a reader has made the curve of the edge of that on a surface. Such edges have the readers' tolerance to the
/// last digit; those whose curve on a surface was made of the curve in space have what was measured.
bool isApproximated(const TopoDS_Edge& edge) {
  double first = 0, last = 0;
  const auto spline = Handle(Geom_BSplineCurve)::DownCast(BRep_Tool::Curve(edge, first, last));
  if (spline.IsNull() || spline->IsRational() || !BRep_Tool::SameParameter(edge)) return false;
  if (std::abs(BRep_Tool::Tolerance(edge) - kOfReaders) > 1e-12) return false;
  const double deviation = endsApart(edge);
  return deviation > kOurs && deviation <= 1.001 * kOfReaders;
}

/// True if the edge has a curve in space afterwards.
bool buildCurve(const TopoDS_Edge& edge, double tolerance) {
  constexpr int kDegree = 14, kPieces = 400;
  double first = 0, last = 0;
  return BRepLib::BuildCurve3d(edge, tolerance, GeomAbs_C1, kDegree, kPieces) &&
         !BRep_Tool::Curve(edge, first, last).IsNull();
}

}  // namespace

void sharpenEdges(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  const BRep_Builder builder;
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    double first = 0, last = 0;
    TopLoc_Location place;
    const Handle(Geom_Curve) before = BRep_Tool::Curve(edge, place, first, last);
    if (before.IsNull()) {
      if (!buildCurve(edge, kOurs)) buildCurve(edge, kOfReaders);
      continue;
    }
    if (!isApproximated(edge)) continue;
    const double deviation = endsApart(edge);
    builder.UpdateEdge(edge, Handle(Geom_Curve)(), place, 0);
    if (buildCurve(edge, kOurs) && endsApart(edge) < deviation) continue;
    builder.UpdateEdge(edge, before, place, 0);
  }
}

}  // namespace probewright::simulation
