#include "cycles/heidenhain/bolt_circle_measurement.hpp"

#include "control/alarm.hpp"
#include "cycles/heidenhain/hole_measurement.hpp"
#include "metrology/elements.hpp"

namespace probewright::cycles::heidenhain {

MeasuredCircle measureBoltCircle(Context& context) {
  const Vector2 centre(context.q(273), context.q(274));
  std::array<Vector2, 3> holes;
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = context.q(291 + static_cast<int>(i));
    const Vector2 nominal = centre + probing::directionAt(angle).inPlane() * context.q(262) / 2;
    holes[i] = measureHoleCentre(context, nominal, context.q(261)).inPlane();
  }
  const auto circle = metrology::circleThrough(holes[0], holes[1], holes[2]);
  if (!circle) throw control::Alarm("Circle not determined", circle.error().message, circle.error().advice);
  return {{circle->centre.x(), circle->centre.y(), context.q(261)}, 2 * circle->radius};
}

}  // namespace probewright::cycles::heidenhain
