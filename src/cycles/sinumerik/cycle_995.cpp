#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/number_text.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/sinumerik/ball_measurement.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "metrology/fits.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice features995[] = {{5, "spindle"}};
constexpr Choice repeat995[] = {{1, "repeated about the centre found"}};
constexpr Choice method995[] = {{2, "probe aligned with each touch"}};
constexpr Choice points995[] = {{1, "four points"}};
constexpr Choice diameter995[] = {{0, "diameter as set"}, {1, "finds the diameter of the ball"}};
constexpr CodeDigit variant995[] = {
    {1, 1, "feature", features995}, {2, 1, "repetition", repeat995}, {3, 1, "task", parameters::measureOnly},
    {4, 1, "method", method995},    {6, 1, "points", points995},     {7, 1, "diameter", diameter995}};

constexpr Parameter parameters995[] = {
    parameters::variant(variant995, 5),
    parameters::count<0>(1, "S_KNUM", "0: nothing is corrected"),
    parameters::dataSet(2),
    parameters::length(3, "S_SETV", "diameter of the calibration ball"),
    parameters::measuringPath(4),
    parameters::safeArea(5),
    parameters::angle(6, "S_STA1", "angle of the first point from the 1st axis"),
    parameters::angle(7, "S_INCA", "not used: the points lie 90 degrees apart"),
    parameters::length(8, "S_DZ", "distance from the probe's ball to the place on its shaft that touches"),
    parameters::length(9, "S_SETV0", "not used"),
    parameters::length(10, "S_SETV1", "not used"),
    parameters::length(11, "S_SETV2", "not used"),
    parameters::angle(12, "S_TUL", "upper tolerance limit of the angles"),
    parameters::angle(13, "S_TZL", "zero range: smaller angles count as none"),
    parameters::repetitions(14),
    parameters::reserved(15),
    parameters::plane(16),
    parameters::count<1>(17, "_AMODE", "1: S_TUL is a tolerance"),
};

constexpr ResultDefinition results995[] = {
    {"_OVR[2]", "angle of the tool axis towards the 1st axis", result::actual(of::angle1).main()},
    {"_OVR[3]", "angle of the tool axis towards the 2nd axis", result::actual(of::angle2).main()},
    {"_OVR[4]", "distance from the probe's ball to the place on its shaft", result::actual(of::distance)},
    {"_OVR[5]", "by how much the angle towards the 1st axis exceeds its tolerance", result::excess(of::angle1)},
    {"_OVR[6]", "by how much the angle towards the 2nd axis exceeds its tolerance", result::excess(of::angle2)},
    {"_OVR[7]", "deviation of the tool axis towards the 1st axis over the distance",
     result::actual(of::distance1).main()},
    {"_OVR[8]", "deviation of the tool axis towards the 2nd axis over the distance",
     result::actual(of::distance2).main()},
    {"_OVR[9]", "upper tolerance limit of the angles", result::upperLimit(of::angle)},
    {"_OVR[10]", {"set ", "diameter of the ball"}, result::set(of::diameter.number(1))},
    {"_OVR[11]", {"set ", "centre of the ball, 1st axis"}, result::set(of::centre1.number(1))},
    {"_OVR[12]", {"set ", "centre of the ball, 2nd axis"}, result::set(of::centre2.number(1))},
    {"_OVR[13]", {"set ", "centre of the ball, 3rd axis"}, result::set(of::centre3.number(1))},
    {"_OVR[14]", "diameter of the ball", result::actual(of::diameter.number(1))},
    {"_OVR[15]", "centre of the ball, 1st axis", result::actual(of::centre1.number(1))},
    {"_OVR[16]", "centre of the ball, 2nd axis", result::actual(of::centre2.number(1))},
    {"_OVR[17]", "centre of the ball, 3rd axis", result::actual(of::centre3.number(1))},
    {"_OVR[18]", {"difference of the ", "diameter of the ball"}, result::difference(of::diameter.number(1))},
    {"_OVR[19]", {"difference of the ", "centre of the ball, 1st axis"}, result::difference(of::centre1.number(1))},
    {"_OVR[20]", {"difference of the ", "centre of the ball, 2nd axis"}, result::difference(of::centre2.number(1))},
    {"_OVR[21]", {"difference of the ", "centre of the ball, 3rd axis"}, result::difference(of::centre3.number(1))},
    {"_OVR[22]", "diameter of the ball that the shaft touches", result::actual(of::diameter.number(2))},
    {"_OVR[23]", "expected centre, touched by the shaft, 1st axis", result::set(of::centre1.number(2))},
    {"_OVR[24]", "expected centre, touched by the shaft, 2nd axis", result::set(of::centre2.number(2))},
    {"_OVR[25]", "centre, touched by the shaft, 1st axis", result::actual(of::centre1.number(2))},
    {"_OVR[26]", "centre, touched by the shaft, 2nd axis", result::actual(of::centre2.number(2))},
    {"_OVR[27]",
     {"difference of the ", "centre, touched by the shaft, 1st axis"},
     result::difference(of::centre1.number(2))},
    {"_OVR[28]",
     {"difference of the ", "centre, touched by the shaft, 2nd axis"},
     result::difference(of::centre2.number(2))},
    {"_OVI[2]", "number of the cycle", result::status},
    {"_OVI[3]", "measuring variant", result::setting()},
    {"_OVI[5]", "data set of the probe", result::setting()},
    {"_OVI[9]", "number of the alarm or message", result::status},
};

constexpr int points = 4;
constexpr double step = 90;
/// Measuring path and safe area of the shaft, in those of the ball.
constexpr double shaftFactor = 1.5;

/// Where the tool centre point stands when the shaft, `lowered` above the ball, is centred on `ball`.
Vector2 centreOfShaft(Context& context, const MeasuredBall& ball, double safeHeight, double lowered) {
  probing::SinumerikProber& prober = context.prober();
  const double spindle = context.channel().spindleAngle();
  const double path = shaftFactor * context.real("S_FA"), assumed = prober.ballRadius();
  PartPoint about = ball.centre;
  about[2] -= lowered + (prober.probe().lengthToCentre ? 0 : prober.ballRadius());
  std::vector<Vector2> tips;
  std::vector<std::size_t> places;
  for (const probing::PlannedTouch& touch :
       probing::planCircle(about, ball.diameter, context.real("S_STA1"), step, points, Side::Outside)) {
    if (tips.empty()) {
      prober.moveInPlane(tipAt(touch.surface, -(touch.direction * (path + assumed))));
      prober.moveHeightTo(about.z());
    } else {
      prober.moveOnArc(about, step);
    }
    prober.alignTo(touch.direction);
    const MeasuredPoint point = prober.measureUncompensated(touch.surface, touch.direction, path, context.repetitions(),
                                                            assumed, prober.probe().feed, control::TouchWith::Shaft);
    tips.push_back(point.tcp.inPlane());
    places.push_back(point.record);
  }
  context.positionSpindle(spindle);
  prober.moveHeightTo(safeHeight);
  const auto fit = metrology::fitCircle(tips, withCofactors);
  if (!fit) context.alarm(61316, fit.error().message);
  context.channel().journal().fit(recordOf(*fit, std::move(places)));
  return fit->shape.centre;
}

void reportBall(Context& context, const BallPlan& plan, const MeasuredBall& ball) {
  context.result(10, plan.diameter);
  context.result(14, ball.diameter, {.nominal = plan.diameter});
  context.result(18, ball.diameter - plan.diameter);
  for (int axis = 0; axis < 3; ++axis) {
    context.result(11 + axis, plan.centre[axis]);
    context.result(15 + axis, ball.centre[axis], {.nominal = plan.centre[axis]});
    context.result(19 + axis, ball.centre[axis] - plan.centre[axis]);
  }
}

/// Angles and deviations, compared with their tolerance and zero range.
void reportAxis(Context& context, const Vector2& deviation, double distance) {
  const bool tolerance = context.digit("_AMODE", 1) == 1;
  const double limit = context.real("S_TUL"), zeroRange = context.real("S_TZL");
  context.result(4, distance);
  if (tolerance) context.result(9, limit);
  for (int axis = 0; axis < 2; ++axis) {
    double angle = degreesFromRadians(std::atan2(deviation[axis], distance));
    const bool counts = !tolerance || std::abs(angle) >= zeroRange;
    if (!counts) angle = 0;
    const double beyond = tolerance ? std::max(0.0, std::abs(angle) - limit) : 0;
    Compared compared{.nominal = 0.0};
    if (tolerance) {
      compared.lower = -limit;
      compared.upper = limit;
      compared.verdict = beyond > 1e-9 ? Verdict::Scrap : Verdict::Good;
      context.record().verdict = worst(context.record().verdict, compared.verdict);
      context.result(5 + axis, beyond);
    }
    context.result(2 + axis, angle, compared);
    context.result(7 + axis, counts ? deviation[axis] : 0);
    if (beyond > 1e-9) {
      const std::string text = fmt::format(
          "the angle of the tool axis towards the {} axis is {:.4f} degrees, {:.4f} are "
          "allowed",
          axis == 0 ? "1st" : "2nd", angle, limit);
      context.warn(angle > 0 ? 61304 : 61305, text);
      context.stopOutOfTolerance(text);
    }
  }
}

constexpr Requirement requirements[] = {
    {"S_SETV", Need::Positive},
    {"S_DZ", Need::Positive},
};

void combinations(CallCombinations& call) {
  const auto upper = call.number("S_TUL");
  if (call.asymmetric() && upper && *upper < 0)
    call.refuse("S_TUL", fmt::format("S_TUL = {} is smaller than 0", formatShortest(*upper)));
}

constexpr Example examples[] = {
    {"S_MVAR", 102015},  // the only one, the diameter as set
    {"S_SETV", 25},
    {"S_DZ", 30},
};

constexpr CycleDefinition definition = {
    .number = 995,
    .name = "CYCLE995",
    .title = "Angular deviation of the spindle",
    .family = CycleFamily::Kinematics,
    .summary =
        "Measures a calibration ball with the probe's ball and again with the shaft of its stylus: the shift between "
        "the two centres shows by which angles the tool axis leans towards the axes of the plane.",
    .parameters = parameters995,
    .results = results995,
    .controls = control::onSinumerik,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  context.requireProbe({710, 580});
  context.requireCalibration();
  const int variant = context.integer("S_MVAR");
  if (variant != 102015 && variant != 1102015) context.alarm(61307, "S_MVAR is 102015 or 1102015");
  if (context.integer("S_KNUM") != 0) context.alarm(61321, "S_KNUM is 0: CYCLE995 corrects no zero offset");
  if (!context.channel().description().spindleOrients) context.alarm(61372);
  const double distance = context.real("S_DZ");
  if (!(distance > 0)) context.alarm(61319, "S_DZ, the distance to the place on the shaft, must be greater than 0");
  if (!(context.real("S_SETV") > 0)) context.alarm(61319, "S_SETV, the diameter, must be greater than 0");
  if (std::abs(context.real("S_STA1")) > 360) context.alarm(61319, "S_STA1 is between -360 and 360 degrees");
  if (context.digit("_AMODE", 1) == 1 && context.real("S_TUL") < 0) context.alarm(61319, "S_TUL is smaller than 0");

  probing::SinumerikProber& prober = context.prober();
  const PlanePlace start = prober.position();
  const double path = context.real("S_FA");
  BallPlan plan = {
      .diameter = context.real("S_SETV"),
      .points = points,
      .round = true,
      .startAngle = context.real("S_STA1"),
      .step = step,
      .alignProbe = true,
      .repeat = true,
      .findDiameter = variant == 1102015,
      .safeHeight = start.z(),
      .path = path,
  };
  // The probe stands the measuring path above the pole.
  plan.centre = partAt(start);
  plan.centre[2] -= path + plan.diameter / 2 + (prober.probe().lengthToCentre ? prober.ballRadius() : 0);
  const MeasuredBall ball = measureBall(context, plan);
  reportBall(context, plan, ball);
  context.noteCall();
  context.checkSafeArea(ball.diameter - plan.diameter);
  for (int axis = 0; axis < 3; ++axis)
    context.checkSafeArea(ball.centre[axis] - plan.centre[axis]);

  const Vector2 shaft = centreOfShaft(context, ball, plan.safeHeight, distance);
  // The axis of the tool stands over the ball's centre at the height of the shaft: what the tip gives way there, the
  // axis leans the other way.
  const Vector2 deviation = ball.centre.inPlane() - shaft;
  context.result(22, ball.diameter);
  for (int axis = 0; axis < 2; ++axis) {
    context.result(23 + axis, ball.centre[axis]);
    context.result(25 + axis, shaft[axis], {.nominal = ball.centre[axis]});
    context.result(27 + axis, -deviation[axis]);
    context.checkSafeArea(deviation[axis], shaftFactor);
  }
  prober.moveInPlane(start);
  prober.moveHeightTo(ball.centre.z() + start.z() - plan.centre.z());
  reportAxis(context, deviation, distance);
}

}  // namespace

extern const Entry cycle995 = {
    .definition = definition, .requirements = requirements, .combinations = combinations, .run = run};

}  // namespace probewright::cycles::sinumerik
