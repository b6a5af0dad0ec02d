#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters411 = joined(joined(
                                                std::array{
                                                    coordinate(321, "Q321", "nominal centre in the main axis"),
                                                    coordinate(322, "Q322", "nominal centre in the minor axis"),
                                                    length(323, "Q323", "length of the stud along the main axis"),
                                                    length(324, "Q324", "length of the stud along the minor axis"),
                                                },
                                                heightsAndTravel),
                                            centreTransfer);

constexpr ResultDefinition results411[] = {
    {"Q151", "actual centre, main axis"},
    {"Q152", "actual centre, minor axis"},
    {"Q154", "actual length along the main axis"},
    {"Q155", "actual length along the minor axis"},
};

}  // namespace

const CycleDefinition cycle411Definition = {
    .number = 411,
    .name = "411",
    .title = "PRESET OUTS. RECTAN.",
    .family = CycleFamily::Preset,
    .summary = "Measures a rectangular stud by one touch on each side and sets the preset to its centre.",
    .parameters = parameters411,
    .results = results411,
};

void cycle411(Context& context, const Arguments&) {
  context.require({.rotationAllowed = true});
  const MeasuredRectangle rectangle = measureRectangle(context, {321, 322, 323, 324}, Side::Outside);
  context.result(151, rectangle.centre.x(), {.nominal = context.q(321)});
  context.result(152, rectangle.centre.y(), {.nominal = context.q(322)});
  context.result(154, rectangle.length1, {.nominal = context.q(323)});
  context.result(155, rectangle.length2, {.nominal = context.q(324)});
  finishPreset(context, {.measured = rectangle.centre, .wish = {context.q(331), context.q(332)}, .rotation = {}});
}

}  // namespace probewright::cycles::heidenhain
