#include "cycles/heidenhain/calibration.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters462[] = {
    standardRadius("radius of the calibration ring"),
    setUpClearance,
    calibrationTouches,
    calibrationStartAngle,
};

constexpr LogTerm logTerms[] = {
    {"CALIBRATION OF A TS IN A RING", "KALIBROVKA TS V KOLZE", "TS KALIBRERING MOT RING"},
};

constexpr CycleDefinition definition = {
    .number = 462,
    .name = "462",
    .title = "CALIBRATION OF A TS IN A RING",
    .family = CycleFamily::Calibration,
    .summary =
        "Calibrates the ball radius, and with a spindle that can be oriented the centre offset, in a calibration ring; "
        "the probe stands in the middle of the ring at measuring height.",
    .parameters = parameters462,
    .results = {},
    .controls = control::onTNC640,
};

void run(Context& context, const Arguments&) {
  auto prober = calibrationProber(context);
  const BallCentre start = prober.position();
  storeRadius(context, calibrateRadius(context, prober,
                                       {.centre = start.inPlane(),
                                        .standardRadius = context.q(407),
                                        .side = Side::Inside,
                                        .count = context.option(423),
                                        .startAngle = context.q(380),
                                        .measuringHeight = start.z(),
                                        .travelHeight = start.z(),
                                        .extraClearance = context.q(320)}));
}

}  // namespace

extern const Entry cycle462 = {
    .definition = definition, .conditions = {.turningMode = true}, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain
