#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/cycles.hpp"

namespace probewright::cycles::heidenhain {

const CycleDefinition cycle413Definition = {
    .number = 413,
    .name = "413",
    .title = "PRESET OUTS. CIRCLE",
    .family = CycleFamily::Preset,
    .summary = "Measures a circular stud by three or four touches and sets the preset to its centre.",
    .parameters = parameters::circlePreset,
    .results = parameters::circlePresetResults,
};

void cycle413(Context& context, const Arguments&) { presetCircle(context, Side::Outside); }

}  // namespace probewright::cycles::heidenhain
