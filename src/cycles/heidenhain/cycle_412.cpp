#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters412 =
    joined(joined(
               std::array{
                   coordinate(321, "Q321", "nominal centre in the main axis"),
                   coordinate(322, "Q322", "nominal centre in the minor axis"),
                   length(262, "Q262", "nominal diameter of the hole"),
                   angle(325, "Q325", "angle of the first touch from the main axis"),
                   angle(247, "Q247", "angle from touch to touch, negative: clockwise; at least 5 degrees", -120, 120),
               },
               heightsAndTravel),
           joined(centreTransfer, std::array{pointCount, traverse}));

constexpr ResultDefinition results412[] = {
    {"Q151", "actual centre, main axis"},
    {"Q152", "actual centre, minor axis"},
    {"Q153", "actual diameter"},
};

}  // namespace

const CycleDefinition cycle412Definition = {
    .number = 412,
    .name = "412",
    .title = "PRESET INSIDE CIRCLE",
    .family = CycleFamily::Preset,
    .summary = "Measures a hole or circular pocket by three or four touches and sets the preset to its centre.",
    .parameters = parameters412,
    .results = results412,
};

void cycle412(Context& context, const Arguments&) {
  context.require({.rotationAllowed = true});
  const MeasuredCircle circle = measureCircle(context, {321, 322, 262}, Side::Inside);
  context.result(151, circle.centre.x(), {.nominal = context.q(321)});
  context.result(152, circle.centre.y(), {.nominal = context.q(322)});
  context.result(153, circle.diameter, {.nominal = context.q(262)});
  finishPreset(context, {.measured = circle.centre, .wish = {context.q(331), context.q(332)}, .rotation = {}});
}

}  // namespace probewright::cycles::heidenhain
