#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr ResultDefinition results31[] = {lengthDeviation, oldStatus};

constexpr CycleDefinition definition = {
    .number = 31,
    .name = "31",
    .title = "TOOL LENGTH",
    .family = CycleFamily::Tool,
    .summary = lengthSummary,
    .parameters = oldToolForm,
    .results = results31,
};

void run(Context& context, const Arguments&) { measureTool(context, oldRequest(context), ToolDimensions::Length); }

}  // namespace

extern const Entry cycle31 = {.definition = definition, .conditions = toolConditions, .rules = toolRules, .run = run};

}  // namespace probewright::cycles::heidenhain
