#include "simulation/loose_sides.hpp"

#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <map>

namespace probewright::simulation {

LooseSides::LooseSides(const Poly_Triangulation& mesh) {
  std::vector<std::pair<int, int>> all;
  all.reserve(3 * static_cast<std::size_t>(mesh.NbTriangles()));
  for (int i = 1; i <= mesh.NbTriangles(); ++i) {
    int a = 0, b = 0, c = 0;
    mesh.Triangle(i).Get(a, b, c);
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      all.push_back(std::minmax(from, to));
  }
  std::ranges::sort(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool isTwice = (i > 0 && all[i - 1] == all[i]) || (i + 1 < all.size() && all[i + 1] == all[i]);
    if (!isTwice) sides_.push_back(all[i]);
  }
}

bool LooseSides::contains(int node, int other) const {
  return std::ranges::binary_search(sides_, std::pair<int, int>(std::minmax(node, other)));
}

bool endsAtItsEdges(const TopoDS_Face& face, const Handle(Poly_Triangulation) & mesh, const TopLoc_Location& location) {
  const LooseSides loose(*mesh);
  std::map<const TopoDS_TShape*, int> uses;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next())
    ++uses[edges.Current().TShape().get()];
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    const bool isBorder = uses.at(edge.TShape().get()) == 1 && !BRep_Tool::Degenerated(edge);
    const Handle(Poly_PolygonOnTriangulation) chords = BRep_Tool::PolygonOnTriangulation(edge, mesh, location);
    if (!isBorder || chords.IsNull()) continue;
    for (int i = 1; i < chords->NbNodes(); ++i) {
      const int from = chords->Node(i), to = chords->Node(i + 1);
      if (from != to && !loose.contains(from, to)) return false;
    }
  }
  return true;
}

}  // namespace probewright::simulation
