#include <cstdlib>

#include "control/alarm.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/object_probing.hpp"
#include "cycles/heidenhain/rotation_parameters.hpp"
#include "cycles/heidenhain/rotation_transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters1410 =
    joined(joined(joined(position1, position2), std::array{signedDirection}), joined(travelAndReaction, transferOf2));

constexpr std::array results1410 = joined(
    firstTwoPositions,
    std::array{ResultDefinition{"Q964", {"measured ", "angle in the working plane"}, result::actual(of::angle).main()},
               ResultDefinition{"Q965", "the same as an angle of the rotary table", result::actual(of::tableAngle)}},
    deviationsOfFirstTwo,
    std::array{
        ResultDefinition{"Q994", {"deviation of the ", "angle"}, result::difference(of::angle).main()},
        ResultDefinition{"Q995", "the same as an angle of the rotary table", result::difference(of::tableAngle)}},
    verdictOfRotation);

/// The operator may choose another direction than Q372.
void requireRotation(Context& context, int direction) {
  if (std::abs(direction) != 3 || context.option(1121) == 0) return;
  throw control::Alarm("Probing direction not permitted",
                       "Touches along the tool axis say nothing about the rotation in the working plane",
                       "probe along the main or minor axis (Q372), or set Q1121 = 0");
}

void rules(CallRules& call) {
  const auto direction = call.number(372);
  if (!direction) return;
  if (std::abs(*direction) == 3 && call.number(1121).value_or(0) != 0) {
    call.refuse("Probing direction not permitted", 372,
                "Touches along the tool axis say nothing about the rotation in the working plane",
                "probe along the main or minor axis (Q372), or set Q1121 = 0");
  }
  // Along the axis of probing the positions are where the edge is.
  if (std::abs(*direction) == 1) planeRotationRules(call, {1});
  if (std::abs(*direction) == 2) planeRotationRules(call, {0});
  if (std::abs(*direction) == 3) planeRotationRules(call, {0, 1});
}

constexpr LogTerm logTerms[] = {
    {"PROBING ON EDGE", "IZMERENIE GRANI", "AVKAENNING KANT"},
};

constexpr CycleDefinition definition = {
    .number = 1410,
    .name = "1410",
    .title = "PROBING ON EDGE",
    .family = CycleFamily::Misalignment,
    .summary =
        "Measures the misalignment of an edge by two touches; can take it over as basic rotation or into the rotary "
        "table, correct the preset and monitor tolerances.",
    .parameters = parameters1410,
    .results = results1410,
    .controls = control::onTNC640,
};

void run(Context& context, const Arguments&) {
  requireRotationCycle(context);
  requireAlignmentAxis(context);
  const int direction = context.option(372);
  const std::array nominal = {nominalPosition(context, 1, axisOf(direction)),
                              nominalPosition(context, 2, axisOf(direction))};

  // The operator may choose other directions than Q372.
  std::array<int, 2> directions = {direction, direction};
  std::array<MeasuredPosition, 2> found;
  std::vector<EvaluatedTouch> touched;
  std::optional<ObjectProbing> probing;
  for (std::size_t i = 0; i < 2; ++i) {
    PartPoint actual;
    if (nominal[i].known()) {
      actual = {*nominal[i].axes[0].actual, *nominal[i].axes[1].actual, *nominal[i].axes[2].actual};
    } else {
      if (!probing) probing.emplace(context, "point");
      const EvaluatedTouch touch = probing->touch(nominal[i], directions[i]);
      actual = touch.surface;
      touched.push_back(touch);
      requireRotation(context, directions[i]);
    }
    found[i] = measuredPosition(nominal[i], actual, axisOf(directions[i]));
  }
  if (probing) probing->leaveLastObject();
  if (touched.size() == 2) {
    noteLine(context.channel().journal(),
             std::array<Vector2, 2>{touched[0].surface.inPlane(), touched[1].surface.inPlane()}, placesOf(touched));
  }

  const PlaneRotation rotation = planeRotation(context, found[0], found[1]);
  RotationFindings findings(context);
  findings.add(nominal[0], found[0], directions[0]);
  findings.add(nominal[1], found[1], directions[1]);
  addAngles(findings, rotation);
  findings.finish();
  transferPlaneRotation(context, rotation, found[0], found[1]);
}

}  // namespace

extern const Entry cycle1410 = {.definition = definition,
                                .conditions = {.under = Transformed::ByShiftOrRotation, .mismatchWithTcpm = true},
                                .logTerms = logTerms,
                                .rules = rules,
                                .run = run};

}  // namespace probewright::cycles::heidenhain
