#include <cmath>

#include "control/alarm.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/object_probing.hpp"
#include "cycles/heidenhain/rotation_parameters.hpp"
#include "cycles/heidenhain/rotation_transfer.hpp"
#include "metrology/fits.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice geometryChoices[] = {
    {0, "two holes"}, {1, "two studs"}, {2, "first a hole, then a stud"}, {3, "first a stud, then a hole"}};

constexpr std::array diameter1 = {nominalText(1116, "Q1116", "diameter of the first object", 0, 9999.9999)};
constexpr std::array diameter2 = {nominalText(1117, "Q1117", "diameter of the second object", 0, 9999.9999)};

constexpr std::array circles = {
    option(1115, "Q1115", "kind of the two objects", geometryChoices),
    Parameter{.name = "Q423",
              .address = 423,
              .meaning = "number of touches on each circle",
              .kind = ValueKind::Integer,
              .minimum = 3,
              .maximum = 8},
    angle(325, "Q325", "angle of the first touch from the main axis"),
    angle(1119, "Q1119", "angle over which the touches are spread, negative: clockwise", -359.999, 360),
};

constexpr std::array parameters1411 = joined(joined(joined(position1, diameter1), joined(position2, diameter2)),
                                             joined(circles, joined(travelAndReaction, transferOf2)));

constexpr ResultDefinition results1411[] = {
    {"Q950", "first measured centre, main axis", result::actual(of::centre1.number(1))},
    {"Q951", "first measured centre, minor axis", result::actual(of::centre2.number(1))},
    {"Q952", "first measured centre, tool axis", result::actual(of::centre3.number(1))},
    {"Q953", "second measured centre, main axis", result::actual(of::centre1.number(2))},
    {"Q954", "second measured centre, minor axis", result::actual(of::centre2.number(2))},
    {"Q955", "second measured centre, tool axis", result::actual(of::centre3.number(2))},
    {"Q964", {"measured ", "angle in the working plane"}, result::actual(of::angle).main()},
    {"Q965", "the same as an angle of the rotary table", result::actual(of::tableAngle)},
    {"Q966", "first measured diameter", result::actual(of::diameter.number(1)).main()},
    {"Q967", "second measured diameter", result::actual(of::diameter.number(2)).main()},
    {"Q980", {"deviation of the ", "first centre, main axis"}, result::difference(of::centre1.number(1))},
    {"Q981", {"deviation of the ", "first centre, minor axis"}, result::difference(of::centre2.number(1))},
    {"Q982", {"deviation of the ", "first centre, tool axis"}, result::difference(of::centre3.number(1))},
    {"Q983", {"deviation of the ", "second centre, main axis"}, result::difference(of::centre1.number(2))},
    {"Q984", {"deviation of the ", "second centre, minor axis"}, result::difference(of::centre2.number(2))},
    {"Q985", {"deviation of the ", "second centre, tool axis"}, result::difference(of::centre3.number(2))},
    {"Q994", {"deviation of the ", "angle"}, result::difference(of::angle).main()},
    {"Q995", "the same as an angle of the rotary table", result::difference(of::tableAngle)},
    {"Q996", {"deviation of the ", "first diameter"}, result::difference(of::diameter.number(1))},
    {"Q997", {"deviation of the ", "second diameter"}, result::difference(of::diameter.number(2))},
    {"Q183", "workpiece: -1 not monitored, 0 good, 1 rework, 2 scrap", result::status},
};

Side sideOf(int geometry, std::size_t object) {
  const bool stud = geometry == 1 || (geometry == 2 && object == 1) || (geometry == 3 && object == 0);
  return stud ? Side::Outside : Side::Inside;
}

/// The touches are spread over the angle from end to end; over a full circle the last does not meet the first.
double stepAngle(Context& context) {
  const double whole = context.q(1119);
  const int count = context.option(423);
  return std::abs(whole) == 360 ? whole / count : whole / (count - 1);
}

/// What a text says of a diameter: not "?", and nothing measured by hand.
bool isKnownDiameter(const Argument& diameter) {
  if (!diameter.isText) return diameter.number > 0;
  const auto text = metrology::parseDimension(diameter.text);
  // Texts that say nothing are refused as such.
  if (!text) return true;
  return !text->unknownPosition && !text->actual && text->actualParameter.empty() && text->nominal > 0;
}

void rules(CallRules& call) {
  if (const auto whole = call.number(1119); whole && std::abs(*whole) < 1e-6) {
    call.refuse("Angular length wrong", 1119, "Q1119 = 0 puts all touches into one place", "enter up to 360 degrees");
  }
  for (const std::uint32_t parameter : {1116U, 1117U}) {
    const auto diameter = call.value(parameter);
    if (!diameter || isKnownDiameter(*diameter)) continue;
    call.refuseUnlessBlank("Diameter wrong", {parameter}, "The diameter of an object must be known and larger than 0",
                           "enter it as a number, or as a text with a tolerance");
  }
  planeRotationRules(call, {0, 1});
}

constexpr LogTerm logTerms[] = {
    {"PROBING TWO CIRCLES", "IZMERENIJE DVUH OKRUZHNOSTEY", "AVKAENNING TVAA CIRKLAR"},
};

constexpr Example examples[] = {{"Q1119", 360}};

constexpr CycleDefinition definition = {
    .number = 1411,
    .name = "1411",
    .title = "PROBING TWO CIRCLES",
    .family = CycleFamily::Misalignment,
    .summary =
        "Measures the centres of two holes or studs and the misalignment of the line between them; can take it over as "
        "basic rotation or into the rotary table, correct the preset and monitor tolerances.",
    .parameters = parameters1411,
    .results = results1411,
    .controls = control::onTNC640,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  requireRotationCycle(context);
  requireAlignmentAxis(context);
  constexpr std::array<bool, 3> measured = {true, true, false};
  const std::array nominal = {nominalPosition(context, 1, measured), nominalPosition(context, 2, measured)};
  const std::array diameters = {nominalValue(context, 1116), nominalValue(context, 1117)};
  const double step = stepAngle(context);

  std::array<MeasuredPosition, 2> found;
  std::array<std::optional<double>, 2> foundDiameters;
  std::optional<ObjectProbing> probing;
  for (std::size_t i = 0; i < 2; ++i) {
    if (nominal[i].known()) {
      found[i] = measuredPosition(
          nominal[i], {*nominal[i].axes[0].actual, *nominal[i].axes[1].actual, *nominal[i].axes[2].actual}, measured);
      continue;
    }
    if (!probing) probing.emplace(context, "object");
    const Side side = sideOf(context.option(1115), i);
    const auto touches =
        probing->touchCircle(nominal[i], {*diameters[i].nominal, context.q(325)}, step, context.option(423), side);
    if (i == 0) {
      probing->leaveObject();
    } else {
      probing->leaveLastObject();
    }
    std::vector<Vector3> centres;
    centres.reserve(touches.size());
    for (const EvaluatedTouch& touch : touches)
      centres.push_back(touch.ballCentre.vector());
    const auto fit = metrology::fitCircleInPlane(centres, Vector3::UnitZ(), withCofactors);
    if (!fit) throw control::Alarm("Circle not determined", fit.error().message, fit.error().advice);
    context.channel().journal().fit(recordOf(*fit, placesOf(touches)));
    foundDiameters[i] = 2 * (fit->shape.radius + probing::outwards(side) * meanBallRadius(touches));
    found[i] = measuredPosition(nominal[i], PartPoint(fit->shape.centre), measured);
  }
  if (probing && nominal[1].known()) probing->leaveLastObject();

  const PlaneRotation rotation = planeRotation(context, found[0], found[1]);
  RotationFindings findings(context);
  for (std::size_t i = 0; i < 2; ++i) {
    const int ordinal = static_cast<int>(i) + 1;
    findings.add(nominal[i], found[i], 0);
    if (foundDiameters[i]) {
      findings.addDiameter(diameters[i], *foundDiameters[i], ordinal, sideOf(context.option(1115), i));
    }
  }
  addAngles(findings, rotation);
  findings.finish();
  transferPlaneRotation(context, rotation, found[0], found[1]);
}

}  // namespace

extern const Entry cycle1411 = {.definition = definition,
                                .conditions = {.under = Transformed::ByShiftOrRotation, .mismatchWithTcpm = true},
                                .logTerms = logTerms,
                                .rules = rules,
                                .run = run};

}  // namespace probewright::cycles::heidenhain
