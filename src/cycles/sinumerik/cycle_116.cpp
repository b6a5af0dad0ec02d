#include "cycles/sinumerik/cycle_116.hpp"

#include "metrology/elements.hpp"
#include "metrology/fits.hpp"

namespace probewright::cycles::sinumerik {

CircleThroughPoints circleThroughPoints(std::span<const Vector2> points) {
  if (points.size() == 3) {
    const auto circle = metrology::circleThrough(points[0], points[1], points[2]);
    if (!circle) return {.error = 61316};
    return {.centre = circle->centre, .radius = circle->radius};
  }
  if (points.size() != 4) return {.error = 61317};
  const auto fit = metrology::fitCircle(points);
  if (!fit) return {.error = 61316};
  return {.centre = fit->shape.centre, .radius = fit->shape.radius};
}

}  // namespace probewright::cycles::sinumerik
