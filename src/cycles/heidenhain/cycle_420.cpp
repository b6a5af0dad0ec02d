#include <cmath>

#include "control/alarm.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/edge_measurement.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters420[] = {
    coordinate(263, "Q263", "first touch, main axis"),
    coordinate(264, "Q264", "first touch, minor axis"),
    coordinate(265, "Q265", "second touch, main axis"),
    coordinate(266, "Q266", "second touch, minor axis"),
    measuringAxis3,
    probingDirection,
    measuringHeight,
    setUpClearance,
    clearanceHeight,
    moveToClearance,
    measuringLog,
};

constexpr ResultDefinition results420[] = {
    {"Q150", {"measured ", "angle"}, result::actual(of::angle).main()},
};

constexpr LogTerm logTerms[] = {
    {"Angle Measuring", "Измерение угла", "Mätning vinkel"},
};

constexpr CycleDefinition definition = {
    .number = 420,
    .name = "420",
    .title = "MEASURE ANGLE",
    .family = CycleFamily::Inspection,
    .summary = "Measures the angle of an edge to the main axis, or of a surface along the touch probe axis.",
    .parameters = parameters420,
    .results = results420,
};

void run(Context& context, const Arguments&) {
  const bool sameMain = std::abs(context.q(263) - context.q(265)) <= 1e-4;
  const bool sameMinor = std::abs(context.q(264) - context.q(266)) <= 1e-4;
  // The older control takes all other points for those of a B axis.
  if (context.option(272) == 3 && !sameMain && !sameMinor && context.control().isTNC640()) {
    throw control::Alarm(
        "Angle not determined",
        "With Q272 = 3 the points must lie along the main or the minor axis: A and B are angles about them",
        "make Q263 and Q265, or Q264 and Q266, equal");
  }
  const MeasuredEdge edge = measureEdge(context);
  double measured = 0;
  if (context.option(272) != 3) {
    measured = undirected(degreesFromRadians(std::atan2(edge.along.y(), edge.along.x())));
  } else if (sameMain) {
    // Along the minor axis: the angle in the direction of the A axis.
    measured = undirected(degreesFromRadians(std::atan2(edge.along.z(), edge.along.y())));
  } else {
    measured = undirected(degreesFromRadians(std::atan2(-edge.along.z(), edge.along.x())));
  }
  context.result(150, measured);
  writeLog(context, {.title = "Angle Measuring",
                     .items = {},
                     .measured = {{"Measured angle", measured, ValueKind::Angle}},
                     .further = {{"Measuring height", context.q(261)}}});
}

}  // namespace

extern const Entry cycle420 = {.definition = definition, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain
