#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {

namespace {

constexpr CycleDefinition definition = {
    .number = 411,
    .name = "411",
    .title = "PRESET OUTS. RECTAN.",
    .family = CycleFamily::Preset,
    .summary = "Measures a rectangular stud by one touch on each side and sets the preset to its centre.",
    .parameters = parameters::rectanglePreset,
    .results = parameters::rectanglePresetResults,
};

void run(Context& context, const Arguments&) { presetRectangle(context, Side::Outside); }

}  // namespace

extern const Entry cycle411 = {.definition = definition, .conditions = {.under = Transformed::ByRotation}, .run = run};

}  // namespace probewright::cycles::heidenhain
