#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {
namespace {

constexpr std::array parameters408 =
    joined(joined(parameters::widthCentre, parameters::heightsAndTravel), parameters::widthTransfer);

constexpr CycleDefinition definition = {
    .number = 408,
    .name = "408",
    .title = "SLOT CENTER REF PT",
    .family = CycleFamily::Preset,
    .summary =
        "Measures the width of a slot by a touch on each wall and sets the preset to its centre line. On the iTNC 530 "
        "a function of feature content level 3.",
    .parameters = parameters408,
    .results = parameters::widthResults,
};

void run(Context& context, const Arguments&) { presetWidth(context, Side::Inside); }

}  // namespace

extern const Entry cycle408 = {
    .definition = definition, .conditions = {.under = Transformed::ByRotation, .featureLevel = 3}, .run = run};

}  // namespace probewright::cycles::heidenhain
