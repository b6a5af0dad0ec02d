#pragma once

#include <Poly_Triangulation.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Face.hxx>
#include <utility>
#include <vector>

/// Where the mesh of a face ends.
namespace probewright::simulation {

/// The sides of a mesh that belong to one triangle only.
class LooseSides {
public:
  explicit LooseSides(const Poly_Triangulation& mesh);

  /// Of the side between two nodes, in either order.
  bool contains(int node, int other) const;

private:
  std::vector<std::pair<int, int>> sides_;  ///< the smaller node first, in order
};

/// True if the mesh of a face ends where the chords of its edges run. Where chords cross each other, as in a narrow
/// place between bent edges, it ends elsewhere: a part of the face may have no triangles, and triangles may lie
/// beside the face. A mesh without chords, as a grid is, cannot be judged: true.
bool endsAtItsEdges(const TopoDS_Face& face, const Handle(Poly_Triangulation) & mesh, const TopLoc_Location& location);

}  // namespace probewright::simulation
