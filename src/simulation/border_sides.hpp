#pragma once

#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Poly_Triangulation.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Face.hxx>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/primitives.hpp"

/// Triangles that follow the bent edges of a face more closely than its mesh does.
namespace probewright::simulation {

/// The sides of a mesh that lie on bent edges of its face. Points between their ends lie on the edge, so they are the
/// same in both faces that share it.
class BorderSides {
public:
  struct Point {
    Vector3 point;
    Vector2 parameters;  ///< on the surface of the face
  };
  /// A part of an edge, in the direction from the first corner to the second.
  struct Side {
    std::size_t edge = 0;
    double from = 0, to = 0;  ///< parameters of the edge

    Side firstHalf() const { return {edge, from, (from + to) / 2}; }
    Side secondHalf() const { return {edge, (from + to) / 2, to}; }
  };

  BorderSides(const TopoDS_Face& face, const Handle(Poly_Triangulation) & mesh, const TopLoc_Location& location);

  /// The side from a node to another one; nothing if it is not part of a bent edge.
  std::optional<Side> between(int node, int other) const;
  /// The point halfway along a side, if the straight line between its ends leaves it by more than `deviation`, mm.
  std::optional<Point> middle(const Side& side, double deviation) const;

private:
  struct Edge {
    Handle(Geom_Curve) curve;
    Handle(Geom2d_Curve) onSurface;
  };
  std::vector<Edge> edges_;
  std::map<std::pair<int, int>, Side> sides_;  ///< by their nodes, the smaller one first
};

}  // namespace probewright::simulation
