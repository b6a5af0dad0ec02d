#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr ResultDefinition results32[] = {radiusDeviation, oldStatus};

constexpr CycleDefinition definition = {
    .number = 32,
    .name = "32",
    .title = "TOOL RADIUS",
    .family = CycleFamily::Tool,
    .summary = radiusSummary,
    .parameters = oldToolForm,
    .results = results32,
};

void run(Context& context, const Arguments&) { measureTool(context, oldRequest(context), ToolDimensions::Radius); }

}  // namespace

extern const Entry cycle32 = {.definition = definition, .conditions = toolConditions, .rules = toolRules, .run = run};

}  // namespace probewright::cycles::heidenhain
