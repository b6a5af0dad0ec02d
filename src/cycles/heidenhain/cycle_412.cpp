#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/context.hpp"

namespace probewright::cycles::heidenhain {

namespace {

constexpr CycleDefinition definition = {
    .number = 412,
    .name = "412",
    .title = "PRESET INSIDE CIRCLE",
    .family = CycleFamily::Preset,
    .summary = "Measures a hole or circular pocket by three or four touches and sets the preset to its centre.",
    .parameters = parameters::circlePreset,
    .results = parameters::circlePresetResults,
};

void run(Context& context, const Arguments&) { presetCircle(context, Side::Inside); }

}  // namespace

extern const Entry cycle412 = {.definition = definition, .conditions = {.under = Transformed::ByRotation}, .run = run};

}  // namespace probewright::cycles::heidenhain
