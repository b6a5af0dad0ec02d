#include "cycles/heidenhain/corner_measurement.hpp"

#include <fmt/format.h>

#include <cmath>

#include "control/alarm.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/heidenhain/transfer.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {

MeasuredCorner measureCorner(Context& context, const CornerTouches& planned, Side side) {
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
    if ((planned[i].surface - planned[i + 1].surface).norm() >= 1e-6) continue;
    throw control::Alarm(
        "Corner not determined",
        fmt::format("Two touches of one side are to be made at the same point ({})", i == 0 ? "Q326" : "Q327"),
        "enlarge the distance");
  }
  auto& prober = context.prober();
  const double extra = context.q(320);
  std::vector<probing::RoutedTouch> plan = {{planned[0]}, {planned[1]}, {planned[2]}, {planned[3]}};
  if (side == Side::Outside) {
    plan[2].via = Vector2(prober.prePosition(planned[2], extra).x(), prober.prePosition(planned[1], extra).y());
  }
  const auto touches = probing::probePoints(prober, plan,
                                            {.measuring = context.q(261),
                                             .clearance = context.q(260),
                                             .extraClearance = extra,
                                             .between = betweenOf(context)});

  const auto sideThrough = [&](const EvaluatedTouch& a, const EvaluatedTouch& b, const PlaneWay& direction) {
    const Vector2 along = (b.ballCentre - a.ballCentre).inPlane();
    if (along.norm() < 1e-6) {
      throw control::Alarm("Corner not determined", "Two touches of one side coincide", "enlarge Q326 and Q327");
    }
    noteLine(context.channel().journal(), std::array<Vector2, 2>{a.ballCentre.inPlane(), b.ballCentre.inPlane()},
             {a.record, b.record});
    Vector2 normal = Vector2(-along.y(), along.x()).normalized();
    if (normal.dot(direction.inPlane()) < 0) normal = -normal;
    return metrology::Line2{a.ballCentre.inPlane() + normal * prober.ballRadius({normal.x(), normal.y(), 0}),
                            along.normalized()};
  };
  const metrology::Line2 first = sideThrough(touches[0], touches[1], planned[0].direction);
  const metrology::Line2 second = sideThrough(touches[2], touches[3], planned[2].direction);
  const auto corner = metrology::intersection(first, second);
  if (!corner) throw control::Alarm("Corner not determined", corner.error().message, corner.error().advice);
  return {{corner->x(), corner->y(), context.q(261)}, first};
}

void presetCorner(Context& context, const MeasuredCorner& corner) {
  context.result(151, corner.point.x());
  context.result(152, corner.point.y());
  NewPreset preset;
  preset.measured = corner.point;
  preset.wish = {context.q(331), context.q(332)};
  if (context.option(304) == 1) {
    const Vector2 along =
        corner.firstSide.direction.x() < 0 ? Vector2(-corner.firstSide.direction) : corner.firstSide.direction;
    preset.rotation = degreesFromRadians(std::atan2(along.y(), along.x()));
  }
  finishPreset(context, preset);
}

}  // namespace probewright::cycles::heidenhain
