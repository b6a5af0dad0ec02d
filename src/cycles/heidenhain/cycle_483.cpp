#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr ResultDefinition results483[] = {lengthDeviation, radiusDeviation, newStatus};

constexpr CycleDefinition definition = {
    .number = 483,
    .name = "483",
    .title = "MEASURE TOOL",
    .family = CycleFamily::Tool,
    .summary = bothSummary,
    .parameters = newToolForm,
    .results = results483,
};

void run(Context& context, const Arguments&) { measureTool(context, newRequest(context), ToolDimensions::Both); }

}  // namespace

extern const Entry cycle483 = {.definition = definition, .conditions = toolConditions, .rules = toolRules, .run = run};

}  // namespace probewright::cycles::heidenhain
