#include <algorithm>
#include <cmath>
#include <utility>

#include "control/alarm.hpp"
#include "cycles/heidenhain/calibration.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/directional_calibration.hpp"
#include "cycles/heidenhain/parameters.hpp"
#include "metrology/elements.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice lengthChoices[] = {{0, "no"}, {1, "yes"}};

constexpr Parameter parameters460[] = {
    standardRadius("exact radius of the calibration sphere"),
    setUpClearance,
    moveToClearance,
    upToOn(calibrationTouches, control::onITNC530, 4),
    calibrationStartAngle,
    option(433, "Q433", "also calibrate the length", lengthChoices),
    coordinate(434, "Q434", "coordinate of the sphere's centre in the touch probe axis"),
    only({.name = "Q455",
          .address = 455,
          .meaning = "touches between pole and equator for a 3-D calibration; 0: none",
          .kind = ValueKind::Integer,
          .minimum = 0,
          .maximum = 30,
          .standard = 0},
         control::onTNC640),
};

EvaluatedTouch touchPole(probing::HeidenhainProber& prober, const CalibrationTask& task) {
  const double standOff = prober.probe().setUp + task.extraClearance;
  return prober.stroke(probing::axisDirection(2, -1), standOff + 2 * task.standardRadius);
}

/// Not the spindle axis but the ball is to stand over the pole.
void moveOverPole(probing::HeidenhainProber& prober, const CalibratedRadius& calibrated) {
  BallCentre overPole = ballAt(calibrated.centre);
  if (const auto& offset = calibrated.centreOffset) overPole -= PlaneWay(offset->x(), offset->y(), 0);
  prober.moveInPlane(overPole);
}

/// The pole gives the height of the equator, the equator the place of the pole: twice is exact.
CalibratedRadius calibrateFromPole(Context& context, probing::HeidenhainProber& prober, CalibrationTask task) {
  CalibratedRadius calibrated;
  for (int pass = 0; pass < 2; ++pass) {
    const double radius = pass == 0 ? prober.probe().ballRadius : calibrated.radius;
    task.measuringHeight = touchPole(prober, task).ballCentre.z() - task.standardRadius - radius;
    calibrated = calibrateRadius(context, prober, task);
    task.centre = calibrated.centre.inPlane();
    moveOverPole(prober, calibrated);
  }
  return calibrated;
}

/// Touches above one another on the side of the reference angle: the ball centres lie on a circle, whose middle is the
/// height of the equator however far the probe stands beside the sphere's axis. Begins where the equator is if the
/// probe stands above the sphere as the cycle asks for, and follows it as long as it turns out to lie elsewhere.
double searchEquator(probing::HeidenhainProber& prober, const CalibrationTask& task) {
  const double ball = prober.probe().ballRadius, locus = task.standardRadius + ball;
  double equator = task.travelHeight - ball - prober.probe().setUp - task.extraClearance - task.standardRadius;
  const PlaneWay outwards = probing::directionAt(task.startAngle);
  bool there = false;
  /// How far out and how high the ball centre stands when it meets the sphere at `height`.
  const auto meet = [&](double height) {
    const double away = std::sqrt(std::max(0.0, locus * locus - std::pow(height - equator, 2))) - ball;
    const PlannedTouch planned{PartPoint(task.centre.x(), task.centre.y(), height) + away * outwards, -outwards};
    const BallCentre start = prober.prePosition(planned, task.extraClearance);
    if (!std::exchange(there, true)) prober.moveInPlane(start);
    prober.moveTo(start);
    const BallCentre centre = prober.touch(planned).ballCentre;
    return Vector2(centre.vector().dot(outwards.vector()), centre.z());
  };
  // Short enough that below the equator the ball still touches before the shaft.
  const double step = task.standardRadius / 10;
  constexpr int longest = 6;
  for (int search = 0; search < longest; ++search) {
    const double begin = equator;
    const Vector2 first = meet(begin), second = meet(begin + step);
    const bool above = second.x() < first.x();
    const Vector2 third = meet(above ? begin - step : begin + 2 * step);
    const auto section = metrology::circleThrough(first, second, third);
    if (!section) throw control::Alarm("Calibration not possible", section.error().message, section.error().advice);
    equator = section->centre.y();
    if (std::abs(equator - begin) <= 2 * step) break;
  }
  prober.moveHeightTo(task.travelHeight);
  return equator;
}

CalibratedRadius calibrateFromEquator(Context& context, probing::HeidenhainProber& prober, CalibrationTask task) {
  task.measuringHeight = searchEquator(prober, task);
  return calibrateRadius(context, prober, task);
}

constexpr LogTerm logTerms[] = {
    {"CALIBRATION OF TS ON A SPHERE", "KALIBROVKA TS NA SHARIKE", "TS KALIBRERING MOT KULA"},
};

constexpr CycleDefinition definition = {
    .number = 460,
    .name = "460",
    .title = "CALIBRATION OF TS ON A SPHERE",
    .family = CycleFamily::Calibration,
    .summary =
        "Calibrates the ball radius, the centre offset and on request the length of the touch probe on a calibration "
        "sphere; the probe stands above the sphere at set-up clearance.",
    .parameters = parameters460,
    .results = {},

};

void rules(CallRules& call) {
  if (call.kind() != ControlKind::iTNC530 || call.number(423).value_or(4) <= 4) return;
  if (*call.number(423) > calibrationTouches.maximum) return;  // on no control
  call.add(423, "Q423 takes four or three touches on the iTNC 530", "enter 4 or 3");
}

void run(Context& context, const Arguments&) {
  const bool directional = context.given(455) && context.option(455) > 0;
  if (directional) requireDirectionalCalibration(context);
  if (!context.control().isTNC640() && context.option(423) > 4) {
    throw control::Alarm("Cycle parameter wrong", "Q423 takes four or three touches on the iTNC 530", "enter 4 or 3");
  }
  auto prober = calibrationProber(context);
  if (directional && prober.probe().aside) {
    throw control::Alarm("Calibration not possible",
                         "An L-shaped stylus is turned to every touch; there are no 3-D calibration data for it",
                         "set Q455 = 0");
  }
  BallCentre start = prober.position();
  const double standardRadius = context.q(407);
  CalibrationTask task{.centre = start.inPlane(),
                       .standardRadius = standardRadius,
                       .side = Side::Outside,
                       .count = context.option(423),
                       .startAngle = context.q(380),
                       .travelHeight = start.z(),
                       .extraClearance = context.q(320),
                       .between = betweenOf(context)};
  // The older control begins at the pole; so does a ball that stands aside, which cannot be met at any height.
  const bool fromPole = !context.control().isTNC640() || prober.probe().aside;
  if (prober.probe().aside) prober.moveInPlane(start - prober.tipOffsetNow());
  const CalibratedRadius calibrated =
      fromPole ? calibrateFromPole(context, prober, task) : calibrateFromEquator(context, prober, task);
  storeRadius(context, calibrated);
  if (context.option(433) == 1) {
    moveOverPole(prober, calibrated);
    const EvaluatedTouch pole = touchPole(prober, task);
    const double tip = pole.ballCentre.z() - prober.probe().ballRadius;
    const double before = activeLength(context);
    storeLength(context, before + tip - (context.q(434) + standardRadius));
    // The same place has another coordinate for a tool of another length.
    start[2] -= activeLength(context) - before;
  }
  if (directional) {
    calibrateDirections(context, {.centre = calibrated.centre.inPlane(),
                                  .centreKnown = calibrated.centreOffset.has_value(),
                                  .standardRadius = standardRadius,
                                  .rings = context.option(455),
                                  .count = context.option(423),
                                  .startAngle = context.q(380),
                                  .extraClearance = context.q(320),
                                  .travelHeight = prober.position().z(),
                                  .between = task.between});
  }
  prober.moveHeightTo(start.z());
  prober.moveInPlane(start);
}

}  // namespace

extern const Entry cycle460 = {
    .definition = definition, .conditions = {.turningMode = true}, .logTerms = logTerms, .rules = rules, .run = run};

}  // namespace probewright::cycles::heidenhain
