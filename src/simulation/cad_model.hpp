#pragma once

#include <Geom_Curve.hxx>
#include <TopoDS_Shape.hxx>
#include <optional>
#include <vector>

#include "simulation/cad_face.hpp"
#include "simulation/search_tree.hpp"

/// A boundary representation prepared for contact queries: exact faces and edges, and a tessellation to find them by.
namespace probewright::simulation {

struct CadEdge {
  enum class Kind { Line, Circle, Curve };
  Kind kind = Kind::Curve;
  Handle(Geom_Curve) curve;
  double first = 0;  ///< parameters of the ends
  double last = 0;
  Vector3 start = Vector3::Zero();
  Vector3 end = Vector3::Zero();
  // A circle:
  Vector3 centre = Vector3::Zero();
  Matrix3 axes = Matrix3::Identity();
  double radius = 0;
  // A kink of a surface, which counts within the face's domain only:
  std::optional<std::uint32_t> within;  ///< the face
  bool acrossU = false;                 ///< u is the same all along, else v
  double kinkAt = 0;                    ///< that u or v
};

/// A triangle of a face's tessellation, or a chord of an edge: what the search tree finds.
struct CadElement {
  enum class Kind : std::uint8_t { Face, Edge };
  Triangle corners;                   ///< of a chord: its ends, the last twice
  std::array<Vector2, 3> parameters;  ///< on the surface; of a chord: the curve parameters of its ends in x
  double growth = 0;                  ///< the exact shape lies within this distance
  std::uint32_t owner = 0;            ///< index of the face or edge
  Kind kind = Kind::Face;
  bool onFace = true;  ///< stands for a part of the face; else it only helps to find the face

  bool isTriangle() const { return kind == Kind::Face && onFace; }
};

struct CadModel {
  TopoDS_Shape shape;
  std::vector<CadFace> faces;
  std::vector<CadEdge> edges;
  std::vector<CadElement> elements;  ///< in the order of the tree
  SearchTree tree;
  Bounds bounds;        ///< of the exact shape, to within the deflection
  bool closed = false;  ///< some of its faces bound solids, so that a point is inside or outside
};

/// The shape with faces cut along the kinks of their surfaces, which OpenCASCADE tessellates for hours.
TopoDS_Shape withoutKinks(const TopoDS_Shape& shape);

/// Everything but the tree and the order of the elements: faces, edges, elements. Throws as cadModel() does.
CadModel cadFaces(const TopoDS_Shape& shape, double deflection);

/// Prepares a shape; tessellates it unless it has triangles that are fine enough. Throws Standard_Failure or
/// std::runtime_error where that is impossible.
CadModel cadModel(const TopoDS_Shape& shape, double deflection);

}  // namespace probewright::simulation
