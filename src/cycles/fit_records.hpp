#pragma once

#include <span>

#include "control/journal.hpp"
#include "metrology/fits.hpp"

/// What cycles leave of their fits in the record. A shape that passes through every point has no residuals to tell of,
/// but its cofactors say how it follows an error of the touches.
namespace probewright::cycles {

/// The fit of a cycle asks for this: the covariance then holds the cofactors, those of points that are exact to 1 mm.
inline constexpr metrology::FitOptions withCofactors{.pointDeviation = 1.0};

control::FitRecord recordOf(const metrology::Line2Fit& fit, std::vector<std::size_t> touches);
control::FitRecord recordOf(const metrology::Circle2Fit& fit, std::vector<std::size_t> touches);
/// Of a circle in a plane whose direction is known: fitCircleInPlane().
control::FitRecord recordOf(const metrology::CircleFit& fit, std::vector<std::size_t> touches);
control::FitRecord recordOf(const metrology::PlaneFit& fit, std::vector<std::size_t> touches);
control::FitRecord recordOf(const metrology::SphereFit& fit, std::vector<std::size_t> touches);

/// The places of touches (anything with a `record`) in the cycle's record.
template <class Touches>
std::vector<std::size_t> placesOf(const Touches& touches) {
  std::vector<std::size_t> places;
  places.reserve(touches.size());
  for (const auto& touch : touches)
    places.push_back(touch.record);
  return places;
}

/// Lays a line, plane or sphere through points for the record alone: the cycle has evaluated them in its own way.
/// Points that no such shape passes through leave nothing.
void noteLine(control::Journal& journal, std::span<const Vector2> points, std::vector<std::size_t> touches);
void notePlane(control::Journal& journal, std::span<const Vector3> points, std::vector<std::size_t> touches);
void noteSphere(control::Journal& journal, std::span<const Vector3> points, std::vector<std::size_t> touches);

}  // namespace probewright::cycles
