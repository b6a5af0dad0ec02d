#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {

const CycleDefinition cycle410Definition = {
    .number = 410,
    .name = "410",
    .title = "PRESET INSIDE RECTAN.",
    .family = CycleFamily::Preset,
    .summary = "Measures a rectangular pocket by one touch on each side and sets the preset to its centre.",
    .parameters = parameters::rectanglePreset,
    .results = parameters::rectanglePresetResults,
};

void cycle410(Context& context, const Arguments&) { presetRectangle(context, Side::Inside); }

}  // namespace probewright::cycles::heidenhain
