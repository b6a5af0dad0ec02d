#include <fmt/format.h>

#include "control/alarm.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/corner_measurement.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

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
           joined(std::array{basicRotation}, centreTransfer));

constexpr ResultDefinition results414[] = {
    {"Q151", {"actual ", "corner, main axis"}, result::actual(of::corner1).main()},
    {"Q152", {"actual ", "corner, minor axis"}, result::actual(of::corner2).main()},
};

constexpr Example examples[] = {{"Q296", 10}, {"Q297", 10}, {"Q326", 20}, {"Q327", 20}};

constexpr CycleDefinition definition = {
    .number = 414,
    .name = "414",
    .title = "PRESET OUTSIDE CORNER",
    .family = CycleFamily::Preset,
    .summary =
        "Measures two sides of an outside corner by two touches each and sets the preset to their intersection; can "
        "set a basic rotation from the first side.",
    .parameters = parameters414,
    .results = results414,
    .examples = examples,
};

void rules(CallRules& call) {
  // The third point tells on which sides of the corner the material lies.
  for (const auto& [first, third] : {std::pair{263U, 296U}, {264U, 297U}}) {
    const auto at = call.numbers({first, third});
    if (!at || (*at)[0] != (*at)[1]) continue;
    call.refuse("Corner not determined", third,
                "The first and the third touch share a coordinate: the corner may lie on either side",
                "choose the third touch (Q296, Q297) on the other side of the corner");
  }
  for (const std::uint32_t distance : {326U, 327U}) {
    if (call.number(distance) != 0) continue;
    call.refuse("Corner not determined", distance,
                fmt::format("Two touches of one side are to be made at the same point (Q{})", distance),
                "enlarge the distance");
  }
}

void run(Context& context, const Arguments&) {
  requireTransferTarget(context);
  const double height = context.q(261);
  const double towards1 = context.q(296) < context.q(263) ? 1 : -1;
  const double towards2 = context.q(297) > context.q(264) ? 1 : -1;
  const PartPoint first(context.q(263), context.q(264), height);
  const PartPoint third(context.q(296), context.q(297), height);
  const PlaneWay direction1 = probing::axisDirection(1, towards2);
  const PlaneWay direction2 = probing::axisDirection(0, towards1);
  // The distances count in the positive direction of their axes, whichever corner it is.
  const CornerTouches touches = {
      PlannedTouch{first, direction1},
      PlannedTouch{first + PlaneWay(context.q(326), 0, 0), direction1},
      PlannedTouch{third, direction2},
      PlannedTouch{third + PlaneWay(0, context.q(327), 0), direction2},
  };
  presetCorner(context, measureCorner(context, touches, Side::Outside));
}

}  // namespace

extern const Entry cycle414 = {
    .definition = definition, .conditions = {.under = Transformed::ByRotation}, .rules = rules, .run = run};

}  // namespace probewright::cycles::heidenhain
