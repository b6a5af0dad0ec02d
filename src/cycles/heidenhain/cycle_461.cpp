#include "cycles/heidenhain/calibration.hpp"
#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters461[] = {coordinate(434, "Q434", "height of the reference surface")};

}  // namespace

const CycleDefinition cycle461Definition = {
    .number = 461,
    .name = "461",
    .title = "TS CALIBRATION OF TOOL LENGTH",
    .family = CycleFamily::Calibration,
    .summary = "Calibrates the length of the touch probe on a surface of known height.",
    .parameters = parameters461,
    .results = {},
    .controls = control::onTNC640,
};

void cycle461(Context& context, const Arguments&) {
  context.require({.turningModeAllowed = true});
  auto prober = calibrationProber(context);
  const EvaluatedTouch touch = prober.stroke(probing::axisDirection(2, -1));
  // The tool reference point stands one tool length above the tip.
  const double tip = touch.ballCentre.z() - prober.probe().ballRadius;
  storeLength(context, activeLength(context) + tip - context.q(434));
}

}  // namespace probewright::cycles::heidenhain
