#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "simulation/analytic_solids.hpp"
#include "simulation/truth.hpp"

/// The edges of a cutter as curves, and how near they come to a solid.
namespace probewright::simulation {

/// A piece of a meridian, (radius, height) in mm, and how it winds about the tool's axis. In the frame of the cutter.
struct EdgePiece {
  enum class Kind { Line, Arc };
  Kind kind = Kind::Line;
  Vector2 from = Vector2::Zero(), to = Vector2::Zero();  ///< of a line
  Vector2 centre = Vector2::Zero();                      ///< of an arc
  double radius = 0, fromAngle = 0, toAngle = 0;         ///< of an arc; radians from the radius towards the height
  double angle = 0;                                      ///< radians about the axis, where the height is `datum`
  double winding = 0;                                    ///< radians per mm of height
  double datum = 0;
  bool turned = false;  ///< all angles: a surface that is round about the axis
  double across = 0;    ///< mm, at right angles to the plane of the meridian

  /// Radius and height at `share` (0 to 1) of the piece.
  Vector2 meridian(double share) const;
  /// The point there; `about` more radians about the axis.
  Vector3 at(double share, double about = 0) const;
  double length() const;  ///< mm; of the curve
};

/// Where an edge comes nearest to a solid.
struct EdgeDistance {
  double gap = std::numeric_limits<double>::infinity();  ///< mm; negative within the solid
  Vector3 place = Vector3::Zero();                       ///< of the edge, frame of the solid
  Vector3 normal = Vector3::UnitZ();                     ///< of the solid there, outward
};

/// How far the flank of an insert reaches across its plane, mm: as far as its nose is a cone that has a radius.
double flankDepth(const TrueInsert& insert);

class CuttingEdges {
public:
  explicit CuttingEdges(const TrueTool& tool);

  /// Edges that touch one by one: teeth, or one for a body that is round and for an insert.
  std::size_t count() const { return edges_.size(); }
  /// True if the tool is the same at every angle of the spindle.
  bool round() const { return round_ && eccentricity_.isZero(0); }
  /// The greatest distance of a point of the edges from the spindle's axis, mm.
  double reach() const { return reach_; }

  /// The cutter's frame in the spindle's, the spindle turned to `degrees`.
  Pose spindleFromCutter(double degrees) const;

  /// Exact to about 1e-10 mm.
  EdgeDistance nearest(std::size_t edge, const Pose& solidFromCutter, const DistanceSolid& solid) const;
  /// At most as far as any edge is from the solid at any angle of the spindle.
  double leastGap(const Pose& solidFromSpindle, const DistanceSolid& solid) const;
  /// The same of one edge.
  double leastGap(std::size_t edge, const Pose& solidFromSpindle, const DistanceSolid& solid) const;

private:
  EdgeDistance nearestOfInsert(const Pose& solidFromCutter, const DistanceSolid& solid) const;

  std::vector<std::vector<EdgePiece>> edges_;
  std::vector<EdgePiece> envelope_;                ///< of all edges at all angles
  std::vector<std::vector<EdgePiece>> envelopes_;  ///< of each edge
  std::optional<TrueInsert> insert_;
  Pose spindleFromTool_ = Pose::Identity();
  Vector2 eccentricity_ = Vector2::Zero();
  double reach_ = 0;
  bool round_ = false;
};

}  // namespace probewright::simulation
