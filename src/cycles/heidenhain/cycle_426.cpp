#include <utility>

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/tool_monitoring.hpp"
#include "cycles/heidenhain/width_inspection.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters426 = {
    coordinate(263, "Q263", "first touch, main axis"),
    coordinate(264, "Q264", "first touch, minor axis"),
    coordinate(265, "Q265", "second touch, main axis"),
    coordinate(266, "Q266", "second touch, minor axis"),
    measuringAxis2,
    measuringHeight,
    setUpClearance,
    clearanceHeight,
    length(311, "Q311", "nominal width"),
    limit(288, "Q288", "largest permissible width; 0 with Q289 = 0: not monitored"),
    limit(289, "Q289", "smallest permissible width"),
    measuringLog,
    toleranceStop,
    monitoredTool,
};

constexpr LogTerm logTerms[] = {
    {"Ridge Width Measuring", "Измерение ребра снаружи", "Mätning kam utvändigt"},
};

constexpr CycleDefinition definition = {
    .number = 426,
    .name = "426",
    .title = "MEASURE RIDGE WIDTH",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures the width of a ridge by a touch on each side and compares it with limits; can correct the tool that "
        "made it.",
    .parameters = parameters426,
    .results = parameters::widthInspectionResults,
};

void run(Context& context, const Arguments&) {
  requireMonitoredTool(context);
  const int axis = context.option(272) - 1;
  PartPoint plus(context.q(263), context.q(264), context.q(261));
  PartPoint minus(context.q(265), context.q(266), context.q(261));
  // The first stroke goes in the negative direction: it belongs to the face with the larger coordinate. Points given
  // the other way round, as in the printed example, would let the probe start inside the ridge.
  if (plus[axis] < minus[axis]) std::swap(plus, minus);
  const auto touches = probing::probePoints(
      context.prober(), {{{plus, probing::axisDirection(axis, -1)}}, {{minus, probing::axisDirection(axis, 1)}}},
      {.measuring = context.q(261),
       .clearance = context.q(260),
       .extraClearance = context.q(320),
       .between = probing::Between::AtClearanceHeight});
  finishWidthInspection(context, touches[0].surface[axis], touches[1].surface[axis], Side::Outside,
                        "Ridge Width Measuring");
}

}  // namespace

extern const Entry cycle426 = {.definition = definition, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain
