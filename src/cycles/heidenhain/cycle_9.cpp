#include "cycles/heidenhain/calibration.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/free_measurement_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters9[] = {
    coordinate(probe_word::datum, "DATUM", "exact height of the touched surface in the touch probe axis"),
    referenceSystem};

constexpr CycleDefinition definition = {
    .number = 9,
    .name = "9",
    .title = "CALIBRATE TS LENGTH",
    .family = CycleFamily::Calibration,
    .summary = "Calibrates the length of the touch probe on a surface of known height below it.",
    .parameters = parameters9,
    .results = {},
    .controls = control::onITNC530,
};

void run(Context& context, const Arguments&) {
  auto prober = calibrationProber(context);
  const EvaluatedTouch touch = prober.stroke(probing::axisDirection(2, -1));
  const PlanePlace tip = tipAt(touch.ballCentre, PlaneWay(0, 0, -prober.probe().ballRadius));
  double height = tip.z();
  if (context.option(probe_word::referenceSystem) == 1) {
    const auto& plane = context.control().coordinates.plane;
    height = (context.machineFromProgram() * plane.xyzFromPlane(tip).vector())[plane.tool];
  }
  storeLength(context, activeLength(context) + height - context.q(probe_word::datum));
}

}  // namespace

extern const Entry cycle9 = {.definition = definition, .conditions = {.under = Transformed::Any}, .run = run};

}  // namespace probewright::cycles::heidenhain
