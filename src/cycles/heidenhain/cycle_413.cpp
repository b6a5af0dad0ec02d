#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/context.hpp"

namespace probewright::cycles::heidenhain {

namespace {

constexpr CycleDefinition definition = {
    .number = 413,
    .name = "413",
    .title = "PRESET OUTS. CIRCLE",
    .family = CycleFamily::Preset,
    .summary = "Measures a circular stud by three or four touches and sets the preset to its centre.",
    .parameters = parameters::circlePreset,
    .results = parameters::circlePresetResults,
};

void run(Context& context, const Arguments&) { presetCircle(context, Side::Outside); }

}  // namespace

extern const Entry cycle413 = {.definition = definition, .conditions = {.under = Transformed::ByRotation}, .run = run};

}  // namespace probewright::cycles::heidenhain
