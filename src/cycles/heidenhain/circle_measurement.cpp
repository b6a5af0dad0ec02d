#include "cycles/heidenhain/circle_measurement.hpp"

#include <cmath>

#include "control/alarm.hpp"
#include "metrology/fits.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {

MeasuredCircle measureCircle(Context& context, const CircleParameters& numbers, Side side) {
  using probing::Between;
  using probing::Traverse;
  const double step = context.q(247);
  if (std::abs(step) < 5) {
    throw control::Alarm("Stepping angle too small", "Q247 must be at least 5 degrees in amount",
                         "enter a larger angle");
  }
  probing::CircleTask task;
  task.centre = {context.q(numbers.centre1), context.q(numbers.centre2)};
  task.diameter = context.q(numbers.diameter);
  task.startAngle = context.q(325);
  task.stepAngle = step;
  task.count = context.option(423);
  task.side = side;
  task.traverse = context.option(365) == 0 ? Traverse::Straight : Traverse::Arc;
  const probing::Heights heights{
      .measuring = context.q(261),
      .clearance = context.q(260),
      .extraClearance = context.q(320),
      .between = context.option(301) == 1 ? Between::AtClearanceHeight : Between::AtMeasuringHeight};
  const auto touches = probing::probeCircle(context.prober(), task, heights);

  std::vector<Vector3> centres;
  for (const EvaluatedTouch& touch : touches)
    centres.push_back(touch.ballCentre);
  const auto fit = metrology::fitCircleInPlane(centres, Vector3::UnitZ());
  if (!fit) throw control::Alarm("Circle not determined", fit.error().message, fit.error().advice);
  MeasuredCircle circle;
  circle.centre = fit->shape.centre;
  circle.diameter = 2 * (fit->shape.radius + probing::outwards(side) * context.ballRadius());
  return circle;
}

}  // namespace probewright::cycles::heidenhain
