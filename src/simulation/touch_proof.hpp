#pragma once

#include "simulation/cad_face.hpp"
#include "simulation/sweep.hpp"

/// What shows that a ball on its way touches nothing of a free-form surface, or nothing else.
namespace probewright::simulation {

/// A box of parameters.
struct ParameterBox {
  Vector2 low, high;
  Vector2 middle() const { return (low + high) / 2; }
  Vector2 half() const { return (high - low) / 2; }
};

/// A place where the ball touches the whole surface on its way.
struct SurfaceTouch {
  Vector2 at;
  double when = 0;
};

/// Two distances along a way.
struct Times {
  double from, to;
  double middle() const { return (from + to) / 2; }
  double half() const { return (to - from) / 2; }
};

/// What the way from the surface to the centre may change by, within `half` of a place of the surface and within some
/// time.
struct Shift {
  const SurfacePoint& at;
  Vector2 half;
  double growth;  ///< how far the surface leaves the plane there
  double time;

  /// As seen along a vector: the largest product of both.
  double along(const Vector3& v, const Vector3& direction) const {
    return std::abs(v.dot(at.u)) * half.x() + std::abs(v.dot(at.v)) * half.y() + growth * v.norm() +
           time * std::abs(v.dot(direction));
  }
};

/// Bounds of half of the second derivatives by the parameters of the square of the distance from the centre to the
/// surface: the least of those along each parameter, and the largest size of the mixed one.
struct Form {
  double uu, uv, vv;
  bool isConvex() const { return uu > 0 && vv > 0 && uu * vv > uv * uv; }
  /// The largest value of the inverse form for a slope.
  double ofInverse(double u, double v) const {
    return (vv * u * u + 2 * uv * u * v + uu * v * v) / (uu * vv - uv * uv);
  }
};

/// The form about a place of the surface, for ways from the surface to the centre that are `w` there and nowhere
/// longer than `longest`. What of the slopes lies along `without`, a direction or zero, does not count.
Form formAbout(const SurfacePoint& s, const SurfaceBends& b, const Shift& shift, const Vector3& w, double longest,
               const Vector3& direction, const Vector3& without);

bool hasKink(const FreeformSurface& surface, const ParameterBox& box);

/// What touches of a ball on its way show.
class TouchProof {
public:
  TouchProof(const FreeformSurface& surface, const Way& way, double radius)
      : surface_(surface), way_(way), radius_(radius) {}

  /// True if the ball touches nothing in the box before a touch; it touches nothing there before `soonest` as is known.
  /// With q from the touch to a place of the surface and h its height along the normal there, the ball is its radius R
  /// away from the place until the touch if q * q - 2 R h >= m q * q, where 2 m R is the ball's speed towards the touch
  /// times how long the ball is near. In the box q and h are bounded by their second derivatives.
  bool isClearBefore(const SurfaceTouch& touch, const ParameterBox& part, double soonest) const;

  /// True if the ball, which enters the surface at a touch, has not touched it before anywhere in the box at these
  /// times. Where the square of the distance from the centre to the surface is a convex function of both parameters,
  /// each centre has one nearest place in the box, the touch at its time, and its distance changes by the way's share
  /// along the way to it. Either that is less than zero all the time, or the square is a convex function of the time as
  /// well, so that the ball is nearer than its radius once, from the touch on.
  bool isOnlyTouch(const SurfaceTouch& touch, const ParameterBox& part, const Times& times) const;

private:
  const FreeformSurface& surface_;
  const Way& way_;
  double radius_;
};

}  // namespace probewright::simulation
