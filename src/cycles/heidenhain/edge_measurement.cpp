#include "cycles/heidenhain/edge_measurement.hpp"

#include "control/alarm.hpp"
#include "cycles/fit_records.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {

void edgeRules(CallRules& call) {
  const auto axis = call.number(272);
  const auto main = call.numbers({263, 265}), minor = call.numbers({264, 266});
  // Along the measuring axis the points are where the edge is.
  const bool sameMain = axis == 1 || (main && (*main)[0] == (*main)[1]);
  const bool sameMinor = axis == 2 || (minor && (*minor)[0] == (*minor)[1]);
  if (axis && sameMain && sameMinor)
    call.refuse("Edge not determined", axis == 2 ? 265 : 266, "The two touches coincide", "move the points apart");
}

MeasuredEdge measureEdge(Context& context) {
  const double height = context.q(261);
  const PlaneWay direction = probing::axisDirection(context.option(272) - 1, context.option(267));
  const PlannedTouch first{{context.q(263), context.q(264), height}, direction};
  const PlannedTouch second{{context.q(265), context.q(266), height}, direction};
  const auto requireApart = [](const PlaneWay& along) {
    if (along.norm() >= 1e-6) return;
    throw control::Alarm("Edge not determined", "The two touches coincide", "move the points apart");
  };
  const auto touches = probing::probePoints(context.prober(), {{first}, {second}},
                                            {.measuring = height,
                                             .clearance = context.q(260),
                                             .extraClearance = context.q(320),
                                             .between = betweenOf(context)});
  MeasuredEdge edge{touches[0], touches[1], touches[1].ballCentre - touches[0].ballCentre};
  requireApart(edge.along);
  if (context.option(272) != 3) {
    noteLine(context.channel().journal(),
             std::array<Vector2, 2>{touches[0].ballCentre.inPlane(), touches[1].ballCentre.inPlane()},
             placesOf(touches));
  }
  return edge;
}

double undirected(double degrees) {
  const double angle = normalizedDegrees(degrees);
  if (angle > 90) return angle - 180;
  return angle <= -90 ? angle + 180 : angle;
}

}  // namespace probewright::cycles::heidenhain
