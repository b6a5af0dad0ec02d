#include <cmath>

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/edge_measurement.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters400[] = {
    coordinate(263, "Q263", "first touch, main axis"),
    coordinate(264, "Q264", "first touch, minor axis"),
    coordinate(265, "Q265", "second touch, main axis"),
    coordinate(266, "Q266", "second touch, minor axis"),
    measuringAxis2,
    probingDirection,
    measuringHeight,
    setUpClearance,
    clearanceHeight,
    moveToClearance,
    referenceAngle,
    standard(tableRow, 0),
};

constexpr Example examples[] = {{"Q266", 30}};

constexpr CycleDefinition definition = {
    .number = 400,
    .name = "400",
    .title = "BASIC ROTATION",
    .family = CycleFamily::Misalignment,
    .summary = "Measures the misalignment of an edge by two touches and compensates it by a basic rotation.",
    .parameters = parameters400,
    .results = {},
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  const int row = context.option(305);
  context.control().requireWritablePreset(row == 0 ? context.control().coordinates.preset.row : row);
  resetBasicRotation(context);
  const MeasuredEdge edge = measureEdge(context);
  const double measured = undirected(degreesFromRadians(std::atan2(edge.along.y(), edge.along.x())));
  setBasicRotation(context, undirected(measured - context.q(307)), row);
}

}  // namespace

extern const Entry cycle400 = {
    .definition = definition, .conditions = {.tilted = control::onITNC530}, .rules = edgeRules, .run = run};

}  // namespace probewright::cycles::heidenhain
