#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_parameters.hpp"
#include "cycles/heidenhain/tool_probe_calibration.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters480[] = {clearanceHeight};

constexpr CycleDefinition definition = {
    .number = 480,
    .name = "480",
    .title = "CALIBRATE TT",
    .family = CycleFamily::Tool,
    .summary = calibrationSummary,
    .parameters = parameters480,
};

void run(Context& context, const Arguments&) { calibrateFittedToolProbe(context, context.q(260)); }

}  // namespace

extern const Entry cycle480 = {.definition = definition, .conditions = toolConditions, .run = run};

}  // namespace probewright::cycles::heidenhain
