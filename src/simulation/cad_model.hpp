#pragma once

#include <Adaptor3d_Surface.hxx>
#include <Geom_Curve.hxx>
#include <TopoDS_Shape.hxx>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/cad_face.hpp"
#include "simulation/freeform_curve.hpp"
#include "simulation/search_tree.hpp"

/// A boundary representation prepared for contact queries: exact faces and edges, and a tessellation to find them by.
namespace probewright::simulation {

struct CadEdge {
  enum class Kind { Line, Circle, Curve };
  Kind kind = Kind::Curve;
  Handle(Geom_Curve) curve;
  std::shared_ptr<const LazyFreeformCurve> bounded;  ///< the same with bounds
  double first = 0;                                  ///< parameters of the ends
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
  bool onFace = true;        ///< stands for a part of the face; else it only helps to find the face
  std::uint8_t borders = 0;  ///< a bit for each side, from corner k to the next: beyond it no triangle follows
  std::uint8_t rest = 0;     ///< so that no byte of an element is without a value

  bool isBorder(std::size_t side) const { return (borders >> side & 1U) != 0; }
  void setBorder(std::size_t side, bool is) {
    borders = static_cast<std::uint8_t>((borders & ~(1U << side)) | (is ? 1U << side : 0U));
  }

  bool isTriangle() const { return kind == Kind::Face && onFace; }
};

struct CadModel {
  TopoDS_Shape shape;
  std::vector<CadFace> faces;
  std::vector<CadEdge> edges;
  std::vector<CadElement> elements;  ///< in the order of the tree
  SearchTree tree;
  Bounds bounds;         ///< of the exact shape, to within the deflection
  int closedBodies = 0;  ///< solids, so that a point is inside or outside
  /// mm: how far triangles may leave a face where bodies other than balls meet it. In shapes of more than four metres
  /// it grows with their size.
  double deflection = 0.01;
};

/// The samples of deviationOf may miss the place where the surface leaves the triangle most: it is counted so many
/// times. What that cannot be relied on for is in cad_deviation.hpp.
inline constexpr double kDeviationSafety = 1.5;

/// How far the surface leaves the triangle of an element, sampled.
double deviationOf(const CadElement& element, const CadFace& face);

/// mm: how near to its triangles a face with bent edges lies between an edge and its chords, where no triangle is.
double growthBesideBorders(double deflection);

/// Prepares a shape; tessellates it unless it has triangles that are fine enough. Throws Standard_Failure or
/// std::runtime_error where that is impossible, as those below do.
CadModel cadModel(const TopoDS_Shape& shape, double deflection);

// The same in steps, for two processes:

/// The exact faces and edges of a shape, which may have triangles or not.
CadModel exactModel(const TopoDS_Shape& shape, double deflection);

/// Appends the shape, and what takes long to find of its faces.
void appendShape(std::string& bytes, const CadModel& model);

/// The exact model of what appendShape() gave in a process of the same program. A stop ends it with a
/// std::runtime_error.
CadModel exactModel(std::string_view shape, double deflection, const std::stop_token& stop);

/// What takes long to make, once the shape of an exact model has triangles: elements, tree and bounds.
void addElements(CadModel& model);

/// Appends what addElements() has made, as it lies in memory.
void appendElements(std::string& bytes, const CadModel& model);

/// Gives an exact model what appendElements() gave for it in a process of the same program. Throws also where the bytes
/// are not of this shape.
void takeElements(CadModel& model, std::string_view elements);

}  // namespace probewright::simulation
