#include "cycles/sinumerik/circle_through_points.hpp"

#include "metrology/elements.hpp"
#include "metrology/fits.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Parameter parameters116[] = {
    {.name = "_CAL",
     .address = 0,
     .meaning = "array of 13 REAL: [0] 3 or 4 points, [1] to [8] their coordinates, pair by pair",
     .kind = ValueKind::Length,
     .controls = control::onSinumerik},
    {.name = "_MODE",
     .address = 1,
     .meaning = "variable of type INT for the number of the mistake",
     .kind = ValueKind::Integer,
     .maximum = 99999999,
     .controls = control::onSinumerik},
};

constexpr ResultDefinition results116[] = {
    {"_CAL[9]", "centre, 1st axis", result::actual(of::centre1).main()},
    {"_CAL[10]", "centre, 2nd axis", result::actual(of::centre2).main()},
    {"_CAL[11]", "radius", result::actual(of::radius).main()},
    {"_CAL[12]", "0: computed, 1: not", result::status},
    {"_MODE", "0, or 61316: no circle, 61317: the points are not three or four", result::status},
};

}  // namespace

const CycleDefinition cycle116Definition = {
    .number = 116,
    .name = "CYCLE116",
    .title = "Circle through points",
    .family = CycleFamily::Special,
    .summary = "Computes centre and radius of the circle through three or four points, without touching anything.",
    .parameters = parameters116,
    .results = results116,
    .controls = control::onSinumerik,
};

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
