#include "cycles/heidenhain/calibration.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters461[] = {coordinate(434, "Q434", "height of the reference surface")};

constexpr LogTerm logTerms[] = {
    {"TS CALIBRATION OF TOOL LENGTH", "KALIBROVKA DLINI TS", "TS KALIBRERING LAENGD"},
};

constexpr CycleDefinition definition = {
    .number = 461,
    .name = "461",
    .title = "TS CALIBRATION OF TOOL LENGTH",
    .family = CycleFamily::Calibration,
    .summary = "Calibrates the length of the touch probe on a surface of known height.",
    .parameters = parameters461,
    .results = {},
    .controls = control::onTNC640,
};

void run(Context& context, const Arguments&) {
  auto prober = calibrationProber(context);
  const EvaluatedTouch touch = prober.stroke(probing::axisDirection(2, -1));
  // The tool reference point stands one tool length above the tip.
  const double tip = touch.ballCentre.z() - prober.probe().ballRadius;
  storeLength(context, activeLength(context) + tip - context.q(434));
}

}  // namespace

extern const Entry cycle461 = {
    .definition = definition, .conditions = {.turningMode = true}, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain
