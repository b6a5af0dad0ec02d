#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr ResultDefinition results481[] = {lengthDeviation, newStatus};

constexpr CycleDefinition definition = {
    .number = 481,
    .name = "481",
    .title = "TOOL LENGTH",
    .family = CycleFamily::Tool,
    .summary = lengthSummary,
    .parameters = newToolForm,
    .results = results481,
};

void run(Context& context, const Arguments&) { measureTool(context, newRequest(context), ToolDimensions::Length); }

}  // namespace

extern const Entry cycle481 = {.definition = definition, .conditions = toolConditions, .rules = toolRules, .run = run};

}  // namespace probewright::cycles::heidenhain
