#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/hole_measurement.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/rotary_alignment.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters401[] = {
    coordinate(268, "Q268", "centre of the first hole, main axis"),
    coordinate(269, "Q269", "centre of the first hole, minor axis"),
    coordinate(270, "Q270", "centre of the second hole, main axis"),
    coordinate(271, "Q271", "centre of the second hole, minor axis"),
    measuringHeight,
    clearanceHeight,
    referenceAngle,
    standard(tableRow, 0),
    compensation,
    setToZero,
};

constexpr Example examples[] = {{"Q270", 60}};

constexpr CycleDefinition definition = {
    .number = 401,
    .name = "401",
    .title = "ROT OF 2 HOLES",
    .family = CycleFamily::Misalignment,
    .summary =
        "Measures the centres of two holes and compensates the angle of the line through them by a basic rotation or "
        "the rotary table.",
    .parameters = parameters401,
    .results = {},
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  requireCompensation(context);
  resetBasicRotation(context);
  const PartPoint first = measureHoleCentre(context, {context.q(268), context.q(269)}, context.q(261));
  const PartPoint second = measureHoleCentre(context, {context.q(270), context.q(271)}, context.q(261));
  compensateByRotationOrTable(context, angleOf(first.inPlane(), second.inPlane()));
}

}  // namespace

extern const Entry cycle401 = {
    .definition = definition, .conditions = {.tilted = control::onITNC530}, .rules = twoHoleRules, .run = run};

}  // namespace probewright::cycles::heidenhain
