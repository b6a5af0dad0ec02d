#include "cycles/heidenhain/camera_cycle.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice coverChoices[] = {{0, "closed after the cycle"}, {1, "stays open, for another image"}};

constexpr Parameter parameters601[] = {
    monitoringPoint,
    deviationStop,
    option(613, "Q613", "cover of the camera", coverChoices),
    referenceImages,
};

constexpr CycleDefinition definition = {
    .number = 601,
    .name = "601",
    .title = "LOCAL WORKING SPACE",
    .family = CycleFamily::Special,
    .summary =
        "Takes an image with the camera from where the spindle stands, and compares it with reference images (Visual "
        "Setup Control, option 136).",
    .parameters = parameters601,
    .results = cameraResults,
    .controls = control::onTNC640,
};

void run(Context& context, const Arguments&) {
  monitorByCamera(context, context.option(613) == 1 ? CoverAfterwards::Open : CoverAfterwards::Closed);
}

}  // namespace

extern const Entry cycle601 = {
    .definition = definition, .conditions = cameraConditions, .rules = cameraRules, .run = run};

}  // namespace probewright::cycles::heidenhain
