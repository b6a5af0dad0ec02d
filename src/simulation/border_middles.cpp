#include "simulation/border_middles.hpp"

#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Line.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <set>

namespace probewright::simulation {

BorderMiddles::BorderMiddles(const TopoDS_Face& face, const Handle(Poly_Triangulation) & mesh,
                             const TopLoc_Location& location, double deviation) {
  std::set<std::pair<int, int>> twice;  // two edges with a side between the same nodes: no telling whose it is
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  for (TopExp_Explorer edges(forward, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    double first = 0, last = 0, from = 0, to = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    if (curve.IsNull() || curve->IsKind(STANDARD_TYPE(Geom_Line)) || BRep_Tool::Degenerated(edge)) continue;
    const Handle(Poly_PolygonOnTriangulation) polygon = BRep_Tool::PolygonOnTriangulation(edge, mesh, location);
    if (polygon.IsNull() || !polygon->HasParameters()) continue;
    // Of a seam, on the side that the polygon is on.
    Handle(Geom2d_Curve) onSurface = BRep_Tool::CurveOnSurface(edge, forward, from, to);
    if (onSurface.IsNull() || !mesh->HasUVNodes()) continue;
    const gp_Pnt2d node = mesh->UVNode(polygon->Node(1));
    const Handle(Geom2d_Curve) otherSide = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), forward, from, to);
    const double begin = polygon->Parameter(1);
    if (otherSide->Value(begin).Distance(node) < onSurface->Value(begin).Distance(node)) onSurface = otherSide;
    const auto at = [&](double t) {
      const gp_Pnt p = curve->Value(t);
      return Vector3(p.X(), p.Y(), p.Z());
    };
    for (int i = 1; i < polygon->NbNodes(); ++i) {
      const double t0 = polygon->Parameter(i), t1 = polygon->Parameter(i + 1), t = (t0 + t1) / 2;
      const Vector3 point = at(t);
      if (!((point - (at(t0) + at(t1)) / 2).norm() > deviation)) continue;
      const gp_Pnt2d uv = onSurface->Value(t);
      const std::pair<int, int> side = std::minmax({polygon->Node(i), polygon->Node(i + 1)});
      if (!middles_.try_emplace(side, Middle{point, Vector2(uv.X(), uv.Y())}).second) twice.insert(side);
    }
  }
  for (const auto& side : twice)
    middles_.erase(side);
}

const BorderMiddles::Middle* BorderMiddles::between(int node, int other) const {
  const auto found = middles_.find(std::minmax({node, other}));
  return found == middles_.end() ? nullptr : &found->second;
}

}  // namespace probewright::simulation
