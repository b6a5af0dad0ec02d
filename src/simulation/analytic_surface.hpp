#pragma once

#include "geometry/primitives.hpp"
#include "simulation/polynomial.hpp"
#include "simulation/sweep.hpp"

namespace probewright::simulation {

/// Where a point stands over a surface.
struct SurfaceFoot {
  double signedDistance = 0;  ///< mm, positive on the side `normal` points to
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::Zero();
  Vector2 parameters = Vector2::Zero();  ///< u and v as STEP and OpenCASCADE count them; angles in radians
  bool exists = false;
};

/// How far a point stands from a surface, as in SurfaceFoot.
struct SurfaceHeight {
  double signedDistance = 0;
  Vector3 normal = Vector3::Zero();
};

/// A plane, cylinder, cone, sphere or torus without borders. Of a cone it is one nappe, of a torus that meets itself
/// one of its two sheets.
struct AnalyticSurface {
  enum class Kind { Plane, Cylinder, Cone, Sphere, Torus };

  Kind kind = Kind::Plane;
  Vector3 origin = Vector3::Zero();
  Matrix3 axes = Matrix3::Identity();  ///< columns: the directions of u = 0, u = 90 degrees, and the axis
  double radius = 0;                   ///< of the cylinder, sphere, torus (axis to tube's middle), cone at the origin
  double tubeRadius = 0;               ///< of the torus
  double coneSine = 0;                 ///< of the angle between the cone's axis and its side
  double coneCosine = 1;
  /// The sheet on which the surface's own formula gives negative distances from the axis: the nappe beyond the apex,
  /// the lemon within a torus. `radius` and `coneSine` are then the formula's, with the sign changed.
  bool farSheet = false;

  /// True if the surface has a far sheet for some parameters v between low and high.
  bool reachesFarSheet(double lowV, double highV) const;
  bool reachesNearSheet(double lowV, double highV) const;
  AnalyticSurface otherSheet() const;

  /// The nearest point of the surface; on the axis of a round surface one of many.
  SurfaceFoot foot(const Vector3& p) const;
  /// A part of foot(), sooner: without the angles of the parameters.
  SurfaceHeight height(const Vector3& p) const;

  /// The distances along the way, ascending, at which a ball touches the surface from either side. Up to eight.
  struct Touches {
    std::array<double, 10> values{};
    std::size_t count = 0;
  };
  Touches touches(const Way& way, double radius) const;

private:
  struct Local;
  Local inOwnFrame(const Vector3& p) const;
};

/// True if the ball goes on into the surface after a touch, before it touches again at `next`: the gap may come back to
/// zero on the way, so one place in between does not tell.
template <class GapAndSlope>
bool goesIn(double when, double next, const GapAndSlope& gapAndSlope) {
  for (const double share : {0.5, 1.0, 0.1, 0.7, 0.01}) {
    if (gapAndSlope(when + share * (next - when)).first < -kTouchTolerance) return true;
  }
  return false;
}

/// Refines a distance along the way at which the gap is nearly zero. The gap must be known by value and slope.
template <class GapAndSlope>
double refineTouch(double when, const GapAndSlope& gapAndSlope) {
  for (int i = 0; i < 3; ++i) {
    const auto [gap, slope] = gapAndSlope(when);
    if (std::abs(slope) < 1e-9) break;
    const double step = gap / slope;
    if (std::abs(step) > 1e-3) break;
    when -= step;
    if (std::abs(step) < 1e-14) break;
  }
  return when;
}

/// The distances along the way at which a point comes to `distance` from a circle in the xy plane of the axes.
Roots circleDistanceRoots(const Vector3& localStart, const Vector3& localDirection, double length, double circleRadius,
                          double distance);

}  // namespace probewright::simulation
