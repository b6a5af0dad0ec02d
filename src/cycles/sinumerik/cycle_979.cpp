#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/number_text.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/measuring_method.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "metrology/fits.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice features979[] = {{1, "hole"}, {2, "circular spigot"}};
constexpr Choice points979[] = {{0, "three points"}, {1, "four points"}};
constexpr CodeDigit variant979[] = {{1, 1, "feature", features979},
                                    {3, 1, "task", parameters::measureOrCorrect},
                                    {4, 1, "points", points979},
                                    {5, 1, "method", parameters::method}};

constexpr Parameter parameters979[] = {
    parameters::variant(variant979),
    parameters::zeroOffset(1),
    parameters::toolToCorrect(2),
    parameters::dataSet(3),
    parameters::length(4, "S_SETV", "set value of the diameter"),
    parameters::measuringPath(5),
    parameters::safeArea(6),
    parameters::length(7, "S_CPA", "set value of the centre, 1st axis"),
    parameters::length(8, "S_CPO", "set value of the centre, 2nd axis"),
    parameters::angle(9, "S_STA1", "angle of the first point from the 1st axis"),
    parameters::angle(10, "S_INCA", "angle from point to point; negative: clockwise"),
    parameters::repetitions(11),
    parameters::toolName(12),
    parameters::dlNumber(13),
    parameters::zeroOffsetRange(14),
    parameters::dimensionalDifference(15),
    parameters::upperTolerance(16),
    parameters::lowerTolerance(17),
    parameters::meanRange(18),
    parameters::weight(19),
    parameters::memories(20),
    parameters::reserved(21),
    parameters::plane(22),
    parameters::tolerance(23),
};

constexpr auto results979 = joined(
    std::array<ResultDefinition, 9>{
        {{"_OVR[0]", {"set value of the ", "diameter"}, result::set(of::diameter)},
         {"_OVR[1]", {"set value of the ", "centre, 1st axis"}, result::set(of::centre1)},
         {"_OVR[2]", {"set value of the ", "centre, 2nd axis"}, result::set(of::centre2)},
         {"_OVR[4]", {"actual value of the ", "diameter"}, result::actual(of::diameter).main()},
         {"_OVR[5]", {"actual value of the ", "centre, 1st axis"}, result::actual(of::centre1).main()},
         {"_OVR[6]", {"actual value of the ", "centre, 2nd axis"}, result::actual(of::centre2).main()},
         {"_OVR[16]", {"difference of the ", "diameter"}, result::difference(of::diameter)},
         {"_OVR[17]", {"difference of the ", "centre, 1st axis"}, result::difference(of::centre1)},
         {"_OVR[18]", {"difference of the ", "centre, 2nd axis"}, result::difference(of::centre2)}}},
    parameters::correctionResults);

constexpr Requirement requirements[] = {
    {"S_SETV", Need::Positive},
    {"S_INCA", Need::NotZero},
    {"S_STA1", Need::Within, nullptr, -360, 360},
    {"S_INCA", Need::Within, variant::has<4, 0>, -120, 120},
    {"S_INCA", Need::Within, variant::has<4, 1>, -90, 90},
};

/// Grooves and ribs at an angle are measured by CYCLE977 today, about the place where the probe stands.
int grooveOrRib(OldCall& call) {
  const control::WorkingPlane plane = call.control().workingPlane();
  const Vector2 here = plane.planeFromXyz(call.control().channel.position()).inPlane();
  const Vector2 beside = here - Vector2(call.length("_CPA"), call.length("_CPO"));
  constexpr double near = 1e-4;  // mm
  if (std::abs(beside.dot(probing::directionAt(call.number("_STA1")).inPlane())) > near)
    call.refuseVariant(
        fmt::format("today CYCLE977 measures grooves and ribs at an angle about the place where the "
                    "probe stands, and that is {} {}, not _CPA, _CPO",
                    formatFixed(here.x() / call.control().unit, 4), formatFixed(here.y() / call.control().unit, 4)));
  call.isNow("CYCLE977");
  call.put("S_MA", 1);
  return call.digit(1) + call.task(OldCall::Corrects::AlsoTools);
}

int oldForm(OldCall& call) {
  call.nothingFrom(5);
  if (call.digit(2) == 0 && call.digit(4) == 0 && (call.digit(1) == 3 || call.digit(1) == 4)) return grooveOrRib(call);
  if (call.digit(2) != 0 || call.digit(1) < 1 || call.digit(1) > 2) call.refuseVariant();
  call.put("S_CPA", call.number("_CPA"));
  call.put("S_CPO", call.number("_CPO"));
  return call.digit(1) + call.task(OldCall::Corrects::AlsoTools) + call.digit(4) * 1000;
}

constexpr TitleSize titleSizes[] = {{"S_SETV"}};

constexpr Example examples[] = {
    {"S_MVAR", 1},  // a hole
    {"S_SETV", 30},
    {"S_INCA", 90},
};

constexpr CycleDefinition definition = {
    .number = 979,
    .name = "CYCLE979",
    .title = "Circle segment inside, outside",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures diameter and centre of a segment of a hole or spigot by three or four points at given angles and "
        "corrects the zero offset or the tool.",
    .parameters = parameters979,
    .results = results979,
    .controls = control::onSinumerik,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  context.requireProbe({710, 712, 580});
  const int units = context.digit("S_MVAR", 1);
  if (units < 1 || units > 2 || context.digit("S_MVAR", 4) > 1) context.alarm(61307);
  const Side side = units == 1 ? Side::Inside : Side::Outside;
  const Task task = taskOf(context);
  const Method method = methodOf(context);
  requireCalibrationFor(context, method);
  const int count = 3 + context.digit("S_MVAR", 4);
  const double step = context.real("S_INCA");
  if (step == 0 || std::abs(step) > 360.0 / count) {
    context.alarm(61319,
                  fmt::format("S_INCA: more than 0, at most {:.0f} degrees with {} points", 360.0 / count, count));
  }
  if (std::abs(context.real("S_STA1")) > 360) context.alarm(61319, "S_STA1 is between -360 and 360 degrees");
  const auto target = task == Task::ZeroOffset ? frameTarget(context, GlobalBase::Allowed) : std::nullopt;
  const double set = setValueOf(context, task, context.real("S_SETV"));
  if (!(set > 0)) context.alarm(61319, "S_SETV, the set diameter, must be greater than 0");

  probing::SinumerikProber& prober = context.prober();
  const PartPoint setCentre(context.real("S_CPA"), context.real("S_CPO"), prober.position().z());
  const double path = context.real("S_FA");
  Toucher toucher(context, method);
  std::vector<Vector2> ballCentres;
  std::vector<std::size_t> places;
  for (const probing::PlannedTouch& touch :
       probing::planCircle(setCentre, set, context.real("S_STA1"), step, count, side)) {
    if (!ballCentres.empty()) prober.moveOnArc(setCentre, step);
    const MeasuredPoint point = toucher.measure(touch.surface, touch.direction, path);
    ballCentres.push_back((point.surface - touch.direction * prober.ballRadius()).inPlane());
    places.push_back(point.record);
  }
  toucher.finish();
  context.setWayBack([&] { prober.moveOnArc(setCentre, -step * (count - 1)); });

  const auto fit = metrology::fitCircle(ballCentres, withCofactors);
  if (!fit) context.alarm(61316, fit.error().message);
  context.channel().journal().fit(recordOf(*fit, std::move(places)));
  const PartPoint centre(fit->shape.centre.x(), fit->shape.centre.y(), setCentre.z());
  const double diameter = 2 * (fit->shape.radius + outwards(side) * prober.ballRadius());

  const double difference = diameter - set - (task == Task::Tool ? empiricalValue(context) : 0);
  context.result(0, set);
  context.result(1, setCentre.x());
  context.result(2, setCentre.y());
  context.result(4, diameter, comparedSize(context, task, set, diameter, side));
  context.result(5, centre.x(), {.nominal = setCentre.x()});
  context.result(6, centre.y(), {.nominal = setCentre.y()});
  context.result(16, difference);
  context.result(17, centre.x() - setCentre.x());
  context.result(18, centre.y() - setCentre.y());
  context.noteCall();
  context.checkSafeArea(difference);
  if (task == Task::ZeroOffset) {
    context.checkSafeArea(centre.x() - setCentre.x());
    context.checkSafeArea(centre.y() - setCentre.y());
  }
  if (target) {
    const PlaneWay directions[] = {PlaneWay::unit(0), PlaneWay::unit(1)};
    correctTranslation(context, *target, machinePoint(context, centre), setCentre, directions);
    context.result(28, context.real("S_TSA"));
  }
  if (task == Task::Tool) {
    const Dimension dimensions[] = {{.set = set, .actual = diameter}};
    correctTool(context, dimensions, influenceOnSize(side));
  }
}

}  // namespace

extern const Entry cycle979 = {.definition = definition,
                               .title = {.byFeature = true, .sizes = titleSizes},
                               .requirements = requirements,
                               .oldForm = oldForm,
                               .run = run};

}  // namespace probewright::cycles::sinumerik
