#include "simulation/ball_on_face.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/cad_contact.hpp"
#include "simulation/surface_steps.hpp"

namespace probewright::simulation {

BallOnFace::BallOnFace(const CadFace& face, const Way& way, double radius, Meeting& best)
    : face_(face), surface_(**face.freeform), way_(way), radius_(radius), best_(best) {}

double BallOnFace::gapAt(double when, const Vector2& at) const {
  return (way_.at(when) - surface_.at(at).point).norm() - radius_;
}

bool BallOnFace::meetsAtStart(Vector2 nearest, const Vector2& extent) {
  if (!projectOntoSurface(surface_, way_.start, extent, nearest)) return false;
  const double gap = gapAt(0, nearest);
  if (!(gap < -kTouchTolerance && gap < best_.when && face_.domain.contains(nearest))) return false;
  meet(gap, nearest);
  return true;
}

bool BallOnFace::accept(double when, const Vector2& at) {
  constexpr double kBeforeStart = 1e-7, kApart = 1e-7;  // mm
  if (when < -kBeforeStart || when > way_.length || when >= best_.when || !face_.domain.contains(at)) return true;
  if (std::abs(gapAt(when, at)) > kApart) return false;
  // A ball that touches at the start within the tolerance and would graze only has nothing to meet.
  constexpr double kAnywhere = 1e6, kFurther = 1e-3;  // parameters; radii
  Vector2 later = at;
  const double end = std::min(way_.length, std::max(when, 0.0) + kFurther * radius_);
  if (projectOntoSurface(surface_, way_.at(end), Vector2(kAnywhere, kAnywhere), later) &&
      gapAt(end, later) >= -kTouchTolerance)
    return true;
  meet(std::max(0.0, when), at);
  return true;
}

void BallOnFace::meet(double when, const Vector2& at) {
  const SurfacePoint s = surface_.at(at);
  const Vector3 normal = s.u.cross(s.v);
  keep(best_, when, s.point,
       normal.norm() > 0 ? Vector3(normal.normalized() * (face_.reversed ? -1 : 1)) : Vector3::Zero());
}

}  // namespace probewright::simulation
