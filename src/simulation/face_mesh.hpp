#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "simulation/mesh_limits.hpp"

/// Triangles on the faces of a shape, kept in the shape itself.
namespace probewright::simulation {

struct FaceMeshOptions {
  bool parallel = false;
  std::set<int> left;                ///< faces that are not to be tried: they get a grid at once
  bool leaveAll = false;             ///< every face that is not flat gets a grid at once
  int mostPoints = kMostMeshPoints;  ///< after which the mesher gives a face up
  /// Told when the mesher begins with a face, while it makes points of it, and when it is done with it; from several
  /// threads, if `parallel`.
  std::function<void(int face)> begins, goesOn, ends;
};

/// A face that the mesher cannot do.
struct GridFace {
  int face = 0;          ///< counted from 1, in the order in which an explorer meets the faces of the shape
  std::string kind;      ///< "B-spline surface"
  double deviation = 0;  ///< mm: how far the grid may leave the surface
  double cell = 0;       ///< mm: how far it may reach over the border of the face
};

/// mm, roughly: the diagonal of a box about a shape, and 0 where it has none.
double sizeOf(const TopoDS_Shape& shape);

/// mm: how far triangles may leave the faces of a shape of a size, 0 if that is unknown. What is asked for, unless the
/// shape is so large that this would be needlessly fine, or so small that it would be coarse.
double suitableDeflection(double asked, double size);

/// The faces of a shape that are different from each other, in the order in which an explorer meets them.
std::size_t faceCount(const TopoDS_Shape& shape);

/// True if every face has triangles that were made for this `deflection`, or a finer one.
bool isMeshed(const TopoDS_Shape& shape, double deflection);

/// Gives every face triangles, as the mesher of OpenCASCADE makes them: along its edges they leave it by about eight
/// times `deflection` (mm), within it by up to about sixty times as much (on some free forms even more), in shapes of
/// more than about three metres by a share of their size. Faces that it leaves without triangles are tried twice more,
/// with chords along the edges four and sixteen times as fine. Those that it gives up, or still leaves, get a grid of
/// cells over their parameters instead: on the surface, but reaching over the border by up to a cell. They are
/// returned, but for those whose cells are smaller than `deflection`, and for faces that have come to nothing: a border
/// to and fro on one straight line, or a surface that is only a line or a point.
std::vector<GridFace> meshFaces(const TopoDS_Shape& shape, double deflection, const FaceMeshOptions& options = {});

}  // namespace probewright::simulation
