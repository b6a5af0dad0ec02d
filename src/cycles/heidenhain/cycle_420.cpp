#include <cmath>

#include "control/alarm.hpp"
#include "cycles/heidenhain/call_rules.hpp"
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

constexpr Example examples[] = {{"Q266", 30}};

constexpr CycleDefinition definition = {
    .number = 420,
    .name = "420",
    .title = "MEASURE ANGLE",
    .family = CycleFamily::Inspection,
    .summary = "Measures the angle of an edge to the main axis, or of a surface along the touch probe axis.",
    .parameters = parameters420,
    .results = results420,
    .examples = examples,
};

bool same(double one, double other) { return std::abs(one - other) <= 1e-4; }

void rules(CallRules& call) {
  edgeRules(call);
  // The older control takes all other points for those of a B axis.
  const auto points = call.numbers({263, 265, 264, 266});
  if (call.kind() != ControlKind::TNC640 || call.number(272) != 3 || !points) return;
  if (same((*points)[0], (*points)[1]) || same((*points)[2], (*points)[3])) return;
  call.refuse("Angle not determined", 266,
              "With Q272 = 3 the points must lie along the main or the minor axis: A and B are angles about them",
              "make Q263 and Q265, or Q264 and Q266, equal");
}

void run(Context& context, const Arguments&) {
  const bool sameMain = same(context.q(263), context.q(265));
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

extern const Entry cycle420 = {.definition = definition, .logTerms = logTerms, .rules = rules, .run = run};

}  // namespace probewright::cycles::heidenhain
