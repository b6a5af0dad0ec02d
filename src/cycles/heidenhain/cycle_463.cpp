#include "cycles/heidenhain/calibration.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters463[] = {
    standardRadius("radius of the calibration stud"),
    setUpClearance,
    moveToClearance,
    calibrationTouches,
    calibrationStartAngle,
};

constexpr LogTerm logTerms[] = {
    {"TS CALIBRATION ON STUD", "KALIBROVKA TS NA ZAPFE", "TS KALIBRERING MOT TAPP"},
};

constexpr CycleDefinition definition = {
    .number = 463,
    .name = "463",
    .title = "TS CALIBRATION ON STUD",
    .family = CycleFamily::Calibration,
    .summary =
        "Calibrates the ball radius, and with a spindle that can be oriented the centre offset, on a calibration stud; "
        "the probe stands centred above it at set-up clearance.",
    .parameters = parameters463,
    .results = {},
    .controls = control::onTNC640,
};

void run(Context& context, const Arguments&) {
  auto prober = calibrationProber(context);
  const BallCentre start = prober.position();
  // As far below the top of the stud as the probe stands above it.
  const double touchHeight = start.z() - 2 * (prober.probe().setUp + context.q(320)) - prober.probe().ballRadius;
  storeRadius(context, calibrateRadius(context, prober,
                                       {.centre = start.inPlane(),
                                        .standardRadius = context.q(407),
                                        .side = Side::Outside,
                                        .count = context.option(423),
                                        .startAngle = context.q(380),
                                        .measuringHeight = touchHeight,
                                        .travelHeight = start.z(),
                                        .extraClearance = context.q(320),
                                        .between = betweenOf(context)}));
}

}  // namespace

extern const Entry cycle463 = {
    .definition = definition, .conditions = {.turningMode = true}, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain
