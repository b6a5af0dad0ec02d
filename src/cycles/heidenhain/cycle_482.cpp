#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr ResultDefinition results482[] = {radiusDeviation, newStatus};

constexpr CycleDefinition definition = {
    .number = 482,
    .name = "482",
    .title = "TOOL RADIUS",
    .family = CycleFamily::Tool,
    .summary = radiusSummary,
    .parameters = newToolForm,
    .results = results482,
};

void run(Context& context, const Arguments&) { measureTool(context, newRequest(context), ToolDimensions::Radius); }

}  // namespace

extern const Entry cycle482 = {.definition = definition, .conditions = toolConditions, .rules = toolRules, .run = run};

}  // namespace probewright::cycles::heidenhain
