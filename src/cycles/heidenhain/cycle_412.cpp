#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/cycles.hpp"

namespace probewright::cycles::heidenhain {

const CycleDefinition cycle412Definition = {
    .number = 412,
    .name = "412",
    .title = "PRESET INSIDE CIRCLE",
    .family = CycleFamily::Preset,
    .summary = "Measures a hole or circular pocket by three or four touches and sets the preset to its centre.",
    .parameters = parameters::circlePreset,
    .results = parameters::circlePresetResults,
};

void cycle412(Context& context, const Arguments&) { presetCircle(context, Side::Inside); }

}  // namespace probewright::cycles::heidenhain
