#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/hole_measurement.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/rotary_alignment.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters402[] = {
    coordinate(268, "Q268", "centre of the first stud, main axis"),
    coordinate(269, "Q269", "centre of the first stud, minor axis"),
    length(313, "Q313", "approximate diameter of the first stud, rather too large"),
    coordinate(261, "Q261", "measuring height at the first stud"),
    coordinate(270, "Q270", "centre of the second stud, main axis"),
    coordinate(271, "Q271", "centre of the second stud, minor axis"),
    length(314, "Q314", "approximate diameter of the second stud, rather too large"),
    coordinate(315, "Q315", "measuring height at the second stud"),
    setUpClearance,
    clearanceHeight,
    moveToClearance,
    referenceAngle,
    standard(tableRow, 0),
    compensation,
    setToZero,
};

constexpr Example examples[] = {{"Q270", 60}};

constexpr CycleDefinition definition = {
    .number = 402,
    .name = "402",
    .title = "ROT OF 2 STUDS",
    .family = CycleFamily::Misalignment,
    .summary =
        "Measures the centres of two studs and compensates the angle of the line through them by a basic rotation or "
        "the rotary table.",
    .parameters = parameters402,
    .results = {},
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  requireCompensation(context);
  resetBasicRotation(context);
  const PartPoint first = measureStudCentre(context, {context.q(268), context.q(269)}, context.q(313), context.q(261));
  const PartPoint second = measureStudCentre(context, {context.q(270), context.q(271)}, context.q(314), context.q(315));
  compensateByRotationOrTable(context, angleOf(first.inPlane(), second.inPlane()));
}

}  // namespace

extern const Entry cycle402 = {
    .definition = definition, .conditions = {.tilted = control::onITNC530}, .rules = twoHoleRules, .run = run};

}  // namespace probewright::cycles::heidenhain
