#include "cycles/heidenhain/circle_measurement.hpp"

#include "cycles/fit_records.hpp"

#include <cmath>

#include "control/alarm.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/tool_monitoring.hpp"
#include "cycles/heidenhain/transfer.hpp"
#include "metrology/fits.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {

double meanBallRadius(std::span<const EvaluatedTouch> touches) {
  double sum = 0;
  for (const EvaluatedTouch& touch : touches)
    sum += touch.ballRadius;
  return sum / static_cast<double>(touches.size());
}

MeasuredCircle measureCircle(Context& context, const CircleParameters& numbers, Side side, probing::Ending ending) {
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
  const auto optional = [&](int number, int otherwise) {
    const bool known = context.arguments().definition().parameter(static_cast<std::uint32_t>(number)) != nullptr;
    return known ? context.option(number) : otherwise;
  };
  task.count = optional(423, 4);
  task.side = side;
  task.traverse = optional(365, 1) == 0 ? Traverse::Straight : Traverse::Arc;
  const probing::Heights heights{.measuring = context.q(261),
                                 .clearance = context.q(260),
                                 .extraClearance = context.q(320),
                                 .between = betweenOf(context),
                                 .ending = ending};
  const auto touches = probing::probeCircle(context.prober(), task, heights);

  std::vector<Vector3> centres;
  for (const EvaluatedTouch& touch : touches)
    centres.push_back(touch.ballCentre.vector());
  const auto fit = metrology::fitCircleInPlane(centres, Vector3::UnitZ(), withCofactors);
  if (!fit) throw control::Alarm("Circle not determined", fit.error().message, fit.error().advice);
  context.channel().journal().fit(recordOf(*fit, placesOf(touches)));
  MeasuredCircle circle;
  circle.centre = PartPoint(fit->shape.centre);
  circle.diameter = 2 * (fit->shape.radius + probing::outwards(side) * meanBallRadius(touches));
  return circle;
}

void presetCircle(Context& context, Side side) {
  requireTransferTarget(context);
  const MeasuredCircle circle = measureCircle(context, {321, 322, 262}, side);
  context.result(151, circle.centre.x(), {.nominal = context.q(321)});
  context.result(152, circle.centre.y(), {.nominal = context.q(322)});
  context.result(153, circle.diameter, {.nominal = context.q(262)});
  finishPreset(context, {.measured = circle.centre, .wish = {context.q(331), context.q(332)}, .rotation = {}});
}

void inspectCircle(Context& context, Side side, const std::string& title, const std::string& feature, int maximum,
                   int minimum) {
  requireMonitoredTool(context);
  const MeasuredCircle circle = measureCircle(context, {273, 274, 262}, side);
  Inspection inspection{
      .title = title,
      .items = {inspectedPosition(151, 161, "Center in reference axis", context.q(273), circle.centre.x(),
                                  context.q(279)),
                inspectedPosition(152, 162, "Center in minor axis", context.q(274), circle.centre.y(), context.q(280)),
                inspectedDimension(153, 163, "Diameter", feature, context.q(262), circle.diameter, context.q(maximum),
                                   context.q(minimum), side)},
      .measured = {},
      .further = {{"Measuring height", context.q(261)}}};
  const double deviation = circle.diameter - context.q(262);
  finishInspection(
      context, inspection,
      {.monitored = deviation, .excess = -probing::outwards(side) * deviation / 2, .turned = deviation / 2});
}

}  // namespace probewright::cycles::heidenhain
