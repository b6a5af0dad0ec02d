#pragma once

#include <Geom_Surface.hxx>
#include <memory>
#include <optional>

#include "geometry/primitives.hpp"

namespace probewright::simulation {

/// A place of a surface with its derivatives.
struct SurfacePoint {
  Vector3 point, u, v, uu, uv, vv;
};

/// The largest sizes of the derivatives of a surface in a box of its parameters.
struct SurfaceBends {
  double u = 0, v = 0;
  double uu = 0, uv = 0, vv = 0;
  double uuu = 0, uuv = 0, uvv = 0, vvv = 0;  ///< without bound where second derivatives jump

  SurfaceBends& widen(const SurfaceBends& other);
  /// Makes the bounds smaller where those of third derivatives allow it, for a box that extends so far from a place.
  void narrow(const SurfacePoint& place, const Vector2& half);

  /// How far a surface leaves the plane that touches it in the middle of a box with these half sizes.
  double fromPlane(const Vector2& half) const {
    return (uu * half.x() * half.x() + 2 * uv * half.x() * half.y() + vv * half.y() * half.y()) / 2;
  }
  /// How far a surface leaves a triangle between three of its points, from the differences of their parameters:
  /// seen from the point with the shares a, b, c, that is at most half of the mean square of the ways to the corners,
  /// ab * B(p) + bc * B(q) + ca * B(r), where ab + bc + ca <= 1/3.
  double fromTriangle(const Vector2& p, const Vector2& q, const Vector2& r) const;
};

/// How a surface curves about one of its points, seen along a unit vector that is normal to it there. Of its numerator
/// less the point times its denominator, the weight: the bounds of what it rises along the normal, and of all of it.
struct SurfaceCurving {
  double riseUu = -1e300, riseUv = 0, riseVv = -1e300;  ///< the largest second derivatives, the mixed one by its size
  double uu = 0, uv = 0, vv = 0;                        ///< the largest sizes of the second derivatives
  double leastWeight = 1, mostWeight = 1;
};

/// A surface as the search for contacts needs it.
class FreeformSurface {
public:
  virtual ~FreeformSurface() = default;
  virtual SurfacePoint at(const Vector2& parameters) const = 0;
  virtual Vector3 pointAt(const Vector2& parameters) const { return at(parameters).point; }
  virtual SurfaceBends bends(const Vector2& low, const Vector2& high) const = 0;
  /// In a box of parameters that it covers. Nothing where that is not known, or takes long to find.
  virtual std::optional<SurfaceCurving> curving(const Vector2& /*low*/, const Vector2& /*high*/,
                                                const Vector3& /*point*/, const Vector3& /*normal*/) const {
    return std::nullopt;
  }
  /// The weight at a place; 1 of surfaces that have none.
  virtual double weightAt(const Vector2& /*parameters*/) const { return 1; }
  /// True if the bends of a box hold: it does not reach beyond the ends of a spline.
  virtual bool covers(const Vector2& low, const Vector2& high) const = 0;
  /// A place within an interval where first derivatives may jump, across u or v. Bends of boxes that have one within do
  /// not bound how far the surface leaves a plane.
  virtual std::optional<double> kinkAcrossU(double low, double high) const = 0;
  virtual std::optional<double> kinkAcrossV(double low, double high) const = 0;
};

/// Splines and what is turned or drawn of splines, circles, ellipses and lines has proven bends; those of offsets and
/// of rarer surfaces are taken from samples in the box from `low` to `high`.
std::unique_ptr<const FreeformSurface> freeformSurface(const Handle(Geom_Surface) & surface, const Vector2& low,
                                                       const Vector2& high);

/// The largest weight of a spline's poles divided by the smallest; 1 of surfaces that have none.
double weightRatio(const Handle(Geom_Surface) & surface);

}  // namespace probewright::simulation
