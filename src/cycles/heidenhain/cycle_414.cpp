#include <cmath>

#include "control/alarm.hpp"
#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"
#include "metrology/elements.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice rotationChoices[] = {{0, "no"}, {1, "yes"}};

constexpr std::array parameters414 =
    joined(joined(
               std::array{
                   coordinate(263, "Q263", "first touch, main axis"),
                   coordinate(264, "Q264", "first touch, minor axis"),
                   length(326, "Q326", "distance from the first to the second touch in the main axis"),
                   coordinate(296, "Q296", "third touch, main axis"),
                   coordinate(297, "Q297", "third touch, minor axis"),
                   length(327, "Q327", "distance from the third to the fourth touch in the minor axis"),
               },
               heightsAndTravel),
           joined(std::array{option(304, "Q304", "compensate the misalignment by a basic rotation", rotationChoices)},
                  centreTransfer));

constexpr ResultDefinition results414[] = {
    {"Q151", "actual corner, main axis"},
    {"Q152", "actual corner, minor axis"},
};

}  // namespace

const CycleDefinition cycle414Definition = {
    .number = 414,
    .name = "414",
    .title = "PRESET OUTSIDE CORNER",
    .family = CycleFamily::Preset,
    .summary =
        "Measures two sides of an outside corner by two touches each and sets the preset to their intersection; can "
        "set a basic rotation from the first side.",
    .parameters = parameters414,
    .results = results414,
};

void cycle414(Context& context, const Arguments&) {
  context.require({.rotationAllowed = true});
  const double height = context.q(261);
  // The third point tells on which sides of the corner the material lies.
  const double towards1 = context.q(296) < context.q(263) ? 1 : -1;
  const double towards2 = context.q(297) > context.q(264) ? 1 : -1;
  const Vector3 first(context.q(263), context.q(264), height);
  const Vector3 third(context.q(296), context.q(297), height);
  // The first side runs along the main axis away from the corner, the second along the minor axis.
  const Vector3 second = first + Vector3(towards1 * context.q(326), 0, 0);
  const Vector3 fourth = third + Vector3(0, towards2 * context.q(327), 0);
  const Vector3 direction1 = probing::axisDirection(1, towards2);
  const Vector3 direction2 = probing::axisDirection(0, towards1);
  const PlannedTouch plan1{first, direction1}, plan2{second, direction1}, plan3{third, direction2},
      plan4{fourth, direction2};
  auto& prober = context.prober();
  const double extra = context.q(320);
  // Along the measuring height the way from the first to the second side leads around the corner.
  const Vector2 aroundCorner(prober.prePosition(plan3, extra).x(), prober.prePosition(plan2, extra).y());
  const auto touches =
      probing::probePoints(prober, {{plan1}, {plan2}, {plan3, aroundCorner}, {plan4}},
                           {.measuring = height,
                            .clearance = context.q(260),
                            .extraClearance = extra,
                            .between = context.option(301) == 1 ? probing::Between::AtClearanceHeight
                                                                : probing::Between::AtMeasuringHeight});

  // Lines through the ball centres, moved by the ball radius towards the material, hold at any skew.
  const auto side = [&](const EvaluatedTouch& a, const EvaluatedTouch& b, const Vector3& direction) {
    const Vector2 p = a.ballCentre.head<2>();
    const Vector2 along = (b.ballCentre - a.ballCentre).head<2>();
    if (along.norm() < 1e-6) {
      throw control::Alarm("Corner not determined", "Two touches of one side coincide", "enlarge Q326 and Q327");
    }
    Vector2 normal(-along.y(), along.x());
    normal.normalize();
    if (normal.dot(direction.head<2>()) < 0) normal = -normal;
    return metrology::Line2{p + normal * context.ballRadius(), along.normalized()};
  };
  const metrology::Line2 side1 = side(touches[0], touches[1], direction1);
  const metrology::Line2 side2 = side(touches[2], touches[3], direction2);
  const auto corner = metrology::intersection(side1, side2);
  if (!corner) throw control::Alarm("Corner not determined", corner.error().message, corner.error().advice);

  context.result(151, corner->x());
  context.result(152, corner->y());
  NewPreset preset;
  preset.measured = {corner->x(), corner->y(), height};
  preset.wish = {context.q(331), context.q(332)};
  if (context.option(304) == 1) {
    const Vector2 along = side1.direction.x() < 0 ? Vector2(-side1.direction) : side1.direction;
    preset.rotation = degreesFromRadians(std::atan2(along.y(), along.x()));
  }
  finishPreset(context, preset);
}

}  // namespace probewright::cycles::heidenhain
