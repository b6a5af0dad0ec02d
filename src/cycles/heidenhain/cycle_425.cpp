#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/tool_monitoring.hpp"
#include "cycles/heidenhain/width_inspection.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters425 = {
    coordinate(328, "Q328", "starting point, main axis"),
    coordinate(329, "Q329", "starting point, minor axis"),
    coordinate(310, "Q310", "offset of the second touch across the measuring axis"),
    measuringAxis2,
    measuringHeight,
    clearanceHeight,
    length(311, "Q311", "nominal width"),
    limit(288, "Q288", "largest permissible width; 0 with Q289 = 0: not monitored"),
    limit(289, "Q289", "smallest permissible width"),
    measuringLog,
    toleranceStop,
    monitoredTool,
    later(standard(setUpClearance, 0), 5),
    later(standard(moveToClearance, 0), 5),
};

constexpr LogTerm logTerms[] = {
    {"Slot Width Measuring", "Измерение ширины внутри", "Mätning invändig bredd"},
};

constexpr CycleDefinition definition = {
    .number = 425,
    .name = "425",
    .title = "MEASURE INSIDE WIDTH",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures the width of a slot by a touch on each wall and compares it with limits; can correct the tool that "
        "made it.",
    .parameters = parameters425,
    .results = parameters::widthInspectionResults,
};

void run(Context& context, const Arguments&) {
  requireMonitoredTool(context);
  const int axis = context.option(272) - 1;
  const int across = 1 - axis;
  auto& prober = context.prober();
  BallCentre start(context.q(328), context.q(329), context.q(261));
  prober.approach(start, context.q(260));
  const EvaluatedTouch plus = prober.stroke(probing::axisDirection(axis, 1));

  const double offset = context.q(310);
  if (offset != 0) {
    if (context.option(301) == 1) prober.moveSouthPoleTo(context.q(260));
    start[across] += offset;
    prober.moveInPlane(start);
    prober.moveHeightTo(start[2]);
  }
  // Wide slots are crossed at positioning speed up to the pre-position of the second wall.
  PartPoint wall = partAt(start);
  wall[axis] = plus.surface[axis] - context.q(311);
  const PlannedTouch second{wall, probing::axisDirection(axis, -1)};
  const BallCentre preposition = prober.prePosition(second, context.q(320));
  if (preposition[axis] < start[axis]) prober.moveTo(preposition);
  const EvaluatedTouch minus = prober.touch(second);
  prober.moveSouthPoleTo(context.q(260));
  finishWidthInspection(context, plus.surface[axis], minus.surface[axis], Side::Inside, "Slot Width Measuring");
}

}  // namespace

extern const Entry cycle425 = {.definition = definition, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain
