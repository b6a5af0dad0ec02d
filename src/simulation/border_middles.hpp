#pragma once

#include <Poly_Triangulation.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Face.hxx>
#include <map>
#include <utility>

#include "geometry/primitives.hpp"

namespace probewright::simulation {

/// Points halfway along the sides that the triangles of a face have on its bent edges. A mesh with few points along its
/// edges is made in a fraction of the time, and one point more on each side brings them four times as near: faces
/// beside each other get the same points.
class BorderMiddles {
public:
  struct Middle {
    Vector3 point;       ///< on the edge
    Vector2 parameters;  ///< there on the face's surface
  };

  /// Of the sides that leave their edge by more than `deviation` (mm). `location` is that of the mesh.
  BorderMiddles(const TopoDS_Face& face, const Handle(Poly_Triangulation) & mesh, const TopLoc_Location& location,
                double deviation);

  /// Between two nodes of the mesh; null if their side is not one.
  const Middle* between(int node, int other) const;

private:
  std::map<std::pair<int, int>, Middle> middles_;
};

}  // namespace probewright::simulation
