#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {

namespace {

constexpr CycleDefinition definition = {
    .number = 410,
    .name = "410",
    .title = "PRESET INSIDE RECTAN.",
    .family = CycleFamily::Preset,
    .summary = "Measures a rectangular pocket by one touch on each side and sets the preset to its centre.",
    .parameters = parameters::rectanglePreset,
    .results = parameters::rectanglePresetResults,
};

void run(Context& context, const Arguments&) { presetRectangle(context, Side::Inside); }

}  // namespace

extern const Entry cycle410 = {.definition = definition, .conditions = {.under = Transformed::ByRotation}, .run = run};

}  // namespace probewright::cycles::heidenhain
