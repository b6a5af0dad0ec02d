#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {

const CycleDefinition cycle411Definition = {
    .number = 411,
    .name = "411",
    .title = "PRESET OUTS. RECTAN.",
    .family = CycleFamily::Preset,
    .summary = "Measures a rectangular stud by one touch on each side and sets the preset to its centre.",
    .parameters = parameters::rectanglePreset,
    .results = parameters::rectanglePresetResults,
};

void cycle411(Context& context, const Arguments&) { presetRectangle(context, Side::Outside); }

}  // namespace probewright::cycles::heidenhain
