#include "simulation/border_sides.hpp"

#include <BRep_Tool.hxx>
#include <Geom_Line.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <set>

namespace probewright::simulation {

BorderSides::BorderSides(const TopoDS_Face& face, const Handle(Poly_Triangulation) & mesh,
                         const TopLoc_Location& location) {
  if (mesh.IsNull() || !mesh->HasUVNodes()) return;
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
    if (onSurface.IsNull()) continue;
    const gp_Pnt2d node = mesh->UVNode(polygon->Node(1));
    const Handle(Geom2d_Curve) otherSide = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), forward, from, to);
    const double begin = polygon->Parameter(1);
    if (otherSide->Value(begin).Distance(node) < onSurface->Value(begin).Distance(node)) onSurface = otherSide;
    for (int i = 1; i < polygon->NbNodes(); ++i) {
      Side side{edges_.size(), polygon->Parameter(i), polygon->Parameter(i + 1)};
      const std::pair<int, int> nodes = std::minmax({polygon->Node(i), polygon->Node(i + 1)});
      if (nodes.first != polygon->Node(i)) std::swap(side.from, side.to);
      if (!sides_.try_emplace(nodes, side).second) twice.insert(nodes);
    }
    edges_.push_back({curve, onSurface});
  }
  for (const auto& nodes : twice)
    sides_.erase(nodes);
}

std::optional<BorderSides::Side> BorderSides::between(int node, int other) const {
  const auto found = sides_.find(std::minmax({node, other}));
  if (found == sides_.end()) return std::nullopt;
  const Side& side = found->second;
  return node < other ? side : Side{side.edge, side.to, side.from};
}

std::optional<BorderSides::Point> BorderSides::middle(const Side& side, double deviation) const {
  const Edge& edge = edges_[side.edge];
  const auto at = [&](double t) {
    const gp_Pnt p = edge.curve->Value(t);
    return Vector3(p.X(), p.Y(), p.Z());
  };
  const double t = (side.from + side.to) / 2;
  const Vector3 point = at(t);
  if (!((point - (at(side.from) + at(side.to)) / 2).norm() > deviation)) return std::nullopt;
  const gp_Pnt2d uv = edge.onSurface->Value(t);
  return Point{point, Vector2(uv.X(), uv.Y())};
}

}  // namespace probewright::simulation
