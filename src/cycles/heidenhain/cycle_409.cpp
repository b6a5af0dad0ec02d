#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {
namespace {

constexpr std::array parameters409 =
    joined(joined(parameters::widthCentre, parameters::heights), parameters::widthTransfer);

constexpr CycleDefinition definition = {
    .number = 409,
    .name = "409",
    .title = "RIDGE CENTER REF PT",
    .family = CycleFamily::Preset,
    .summary =
        "Measures the width of a ridge by a touch on each wall and sets the preset to its centre line. On the iTNC 530 "
        "a function of feature content level 3.",
    .parameters = parameters409,
    .results = parameters::widthResults,
};

void run(Context& context, const Arguments&) { presetWidth(context, Side::Outside); }

}  // namespace

extern const Entry cycle409 = {
    .definition = definition, .conditions = {.under = Transformed::ByRotation, .featureLevel = 3}, .run = run};

}  // namespace probewright::cycles::heidenhain
