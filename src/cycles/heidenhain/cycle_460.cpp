#include "control/alarm.hpp"
#include "cycles/heidenhain/calibration.hpp"
#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/directional_calibration.hpp"
#include "cycles/heidenhain/parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice lengthChoices[] = {{0, "no"}, {1, "yes"}};

constexpr Parameter parameters460[] = {
    standardRadius("exact radius of the calibration sphere"),
    setUpClearance,
    moveToClearance,
    calibrationTouches,
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

}  // namespace

const CycleDefinition cycle460Definition = {
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

void cycle460(Context& context, const Arguments&) {
  context.require({.turningModeAllowed = true});
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
  const Vector3 start = prober.position();
  const double standardRadius = context.q(407);
  const Vector3 down = probing::axisDirection(2, -1);
  const double standOff = prober.probe().setUp + context.q(320);

  // The pole gives the height of the equator; the equator gives the place of the pole: twice is exact.
  CalibrationTask task{.centre = start.head<2>(),
                       .standardRadius = standardRadius,
                       .side = Side::Outside,
                       .count = context.option(423),
                       .startAngle = context.q(380),
                       .travelHeight = start.z(),
                       .extraClearance = context.q(320),
                       .between = betweenTouches(context)};
  if (prober.probe().aside) prober.moveInPlane(start - prober.tipOffsetNow());
  CalibratedRadius calibrated;
  for (int pass = 0; pass < 3; ++pass) {
    const EvaluatedTouch pole = prober.stroke(down, standOff + 2 * standardRadius);
    const double radius = pass == 0 ? prober.probe().ballRadius : calibrated.radius;
    task.measuringHeight = pole.ballCentre.z() - standardRadius - radius;
    if (pass == 2) break;
    calibrated = calibrateRadius(context, prober, task);
    task.centre = calibrated.centre.head<2>();
    // Not the spindle axis but the ball is to stand over the pole.
    Vector3 overPole = calibrated.centre;
    if (calibrated.centreOffset) overPole.head<2>() -= *calibrated.centreOffset;
    prober.moveInPlane(overPole);
  }
  storeRadius(context, calibrated);
  if (context.option(433) == 1) {
    const EvaluatedTouch pole = prober.stroke(down, standOff + 2 * standardRadius);
    const double tip = pole.ballCentre.z() - prober.probe().ballRadius;
    const auto& tool = context.control().tool;
    storeLength(context, tool.length + tool.deltaLength + tip - (context.q(434) + standardRadius));
  }
  if (directional) {
    calibrateDirections(context, {.centre = calibrated.centre.head<2>(),
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

}  // namespace probewright::cycles::heidenhain
