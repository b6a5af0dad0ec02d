#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_parameters.hpp"
#include "cycles/heidenhain/tool_probe_calibration.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters30[] = {
    coordinate(probe_word::height, "HEIGHT", "clearance height: coordinate in the tool axis where nothing can be hit")};

constexpr CycleDefinition definition = {
    .number = 30,
    .name = "30",
    .title = "CALIBRATE TT",
    .family = CycleFamily::Tool,
    .summary = calibrationSummary,
    .parameters = parameters30,
};

void run(Context& context, const Arguments&) { calibrateFittedToolProbe(context, context.q(probe_word::height)); }

}  // namespace

extern const Entry cycle30 = {.definition = definition, .conditions = toolConditions, .run = run};

}  // namespace probewright::cycles::heidenhain
