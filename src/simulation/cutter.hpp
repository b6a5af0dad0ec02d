#pragma once

#include <optional>
#include <vector>

#include "geometry/primitives.hpp"
#include "machine/machine.hpp"

/// Cutting tools as they truly are.
///
/// Frame of a cutter: Z is its axis, from the tip to the holder, with 0 at the end as drawn; X and Y as the spindle's
/// at spindle angle 0. Angles count about Z, from X to Y; a spindle that turns clockwise (M3) turns the cutter the
/// other way.
namespace probewright::simulation {

/// A tooth, and how it differs from the drawing. Run-out and wear move the whole edge.
struct TrueTooth {
  double angle = 0;       ///< degrees, of the edge at the end of the tool
  double radial = 0;      ///< mm of run-out; outwards is positive
  double axial = 0;       ///< mm of run-out; a longer tooth is positive
  double radialWear = 0;  ///< mm that the edge has lost at the circumference
  double axialWear = 0;   ///< mm that it has lost at the end
  double broken = 0;      ///< mm, measured along the axis from the end, that have broken off
};

/// The insert of a turning tool: the circle of its nose and the two straight edges that touch it, in a plane through
/// the tool's axis, or beside it by its eccentricity.
struct TrueInsert {
  double noseRadius = 0.8;  ///< mm
  double wear = 0;          ///< mm that nose and edges have lost, at right angles to the edge
  /// degrees in the plane, from X towards Z of the tool turned by `orientation`: where the outward normals of the two
  /// edges point. The nose is the arc between them, over the shorter way.
  double firstNormal = -90;
  double secondNormal = 180;
  double edgeLength = 10;  ///< mm, of each of the edges
  double orientation = 0;  ///< degrees about the tool's axis, from X to the plane of the insert
  /// mm, from nose and edges across the plane, as the eccentricity counts across; its flank recedes there by
  /// `clearance` (degrees). 0: edges only.
  double thickness = 0;
  double clearance = 7;
};

/// What cuts, and what carries it.
struct TrueCutter {
  /// None: a body that is round about its axis, as a pin for calibrating.
  std::vector<TrueTooth> teeth;
  double cornerRadius = 0;                 ///< mm; the tool's radius makes a ball
  double pointAngle = 180;                 ///< degrees, of the cone at the end: of drills below 180
  double helix = 0;                        ///< degrees; a right-hand helix is positive
  double cutLength = 0;                    ///< mm, of the edges along the axis; 0: up to the holder
  double shankRadius = 0;                  ///< mm, above the edges; 0: the radius of the tool
  double holderRadius = 0;                 ///< mm; 0 for none
  double holderLength = 0;                 ///< mm, from the spindle nose down
  Vector2 eccentricity = Vector2::Zero();  ///< mm, of the tool's axis from the spindle's; turns with the spindle.
                                           ///< Of an insert: of its tip, along its plane and across
  /// How the spindle turns when the tool cuts; None: it cuts in no direction.
  machine::Rotation cutting = machine::Rotation::Clockwise;
  std::optional<TrueInsert> insert;  ///< of a turning tool; it has no teeth
};

/// The eccentricity at spindle angle 0, along X and Y of the tool.
inline Vector2 offsetOf(const TrueCutter& cutter) {
  if (!cutter.insert) return cutter.eccentricity;
  return Eigen::Rotation2Dd(radiansFromDegrees(cutter.insert->orientation)) * cutter.eccentricity;
}

}  // namespace probewright::simulation
