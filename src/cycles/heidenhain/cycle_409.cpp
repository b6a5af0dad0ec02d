#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice axisChoices[] = {{1, "main axis"}, {2, "minor axis"}};

constexpr std::array parameters409 = joined(
    joined(
        std::array{
            coordinate(321, "Q321", "nominal centre in the main axis"),
            coordinate(322, "Q322", "nominal centre in the minor axis"),
            length(311, "Q311", "width of the ridge"),
            option(272, "Q272", "axis across the ridge", axisChoices),
        },
        heights),
    joined(std::array{tableRow, coordinate(405, "Q405", "coordinate that the centre line gets in the measured axis")},
           transferAndToolAxis));

constexpr ResultDefinition results409[] = {
    {"Q166", "actual width"},
    {"Q157", "actual position of the centre line"},
};

}  // namespace

const CycleDefinition cycle409Definition = {
    .number = 409,
    .name = "409",
    .title = "RIDGE CENTER REF PT",
    .family = CycleFamily::Preset,
    .summary = "Measures the width of a ridge by a touch on each wall and sets the preset to its centre line.",
    .parameters = parameters409,
    .results = results409,
};

void cycle409(Context& context, const Arguments&) {
  context.require({.rotationAllowed = true});
  const int axis = context.option(272) - 1;
  const Vector2 centre(context.q(321), context.q(322));
  const MeasuredWidth measured = measureWidth(context, centre, context.q(311), axis, Side::Outside, true);
  context.result(166, measured.width, {.nominal = context.q(311)});
  context.result(157, measured.centre, {.nominal = centre[axis]});
  NewPreset preset;
  preset.measured = {centre.x(), centre.y(), measured.height};
  preset.measured[axis] = measured.centre;
  preset.wish[static_cast<std::size_t>(axis)] = context.q(405);
  finishPreset(context, preset);
}

}  // namespace probewright::cycles::heidenhain
