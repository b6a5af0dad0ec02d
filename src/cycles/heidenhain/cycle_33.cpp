#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr ResultDefinition results33[] = {lengthDeviation, radiusDeviation, oldStatus};

constexpr CycleDefinition definition = {
    .number = 33,
    .name = "33",
    .title = "MEASURE TOOL",
    .family = CycleFamily::Tool,
    .summary = bothSummary,
    .parameters = oldToolForm,
    .results = results33,
};

void run(Context& context, const Arguments&) { measureTool(context, oldRequest(context), ToolDimensions::Both); }

}  // namespace

extern const Entry cycle33 = {.definition = definition, .conditions = toolConditions, .rules = toolRules, .run = run};

}  // namespace probewright::cycles::heidenhain
