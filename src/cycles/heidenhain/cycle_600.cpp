#include <cmath>

#include "control/alarm.hpp"
#include "cycles/heidenhain/camera_cycle.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters600[] = {
    monitoringPoint,
    {.name = "Q616",
     .address = 616,
     .meaning = "feed rate with which the spindle goes to the position that the machine tool builder has fixed",
     .kind = ValueKind::Feed,
     .minimum = 0.001,
     .maximum = 99999.999},
    deviationStop,
    referenceImages,
};

constexpr Example examples[] = {{"Q616", 1000}};

constexpr CycleDefinition definition = {
    .number = 600,
    .name = "600",
    .title = "GLOBAL WORKING SPACE",
    .family = CycleFamily::Special,
    .summary =
        "Takes an image of the working space with the camera, from a position that the machine tool builder has fixed, "
        "and compares it with reference images (Visual Setup Control, option 136).",
    .parameters = parameters600,
    .results = cameraResults,
    .controls = control::onTNC640,
    .examples = examples,
};

/// The tool axis goes up before the others move, and down after them.
void goToOverview(Context& context, const machine::AxisPositions& target) {
  control::Channel& channel = context.channel();
  const control::Feed feed = control::Feed::at(context.q(616));
  const auto tool = channel.description().axisIndex(std::string(1, context.control().tool.axis));
  const machine::AxisPositions from = channel.axes();
  machine::AxisPositions between = target;
  if (tool) between[*tool] = std::max(from[*tool], target[*tool]);
  machine::AxisPositions up = from;
  if (tool) up[*tool] = between[*tool];
  for (const machine::AxisPositions& next : {up, between, target}) {
    if (!(next == channel.axes())) channel.moveAxes(next, feed);
  }
}

void run(Context& context, const Arguments&) {
  const auto overview = cameraOf(context).camera->overviewPosition();
  if (!overview) {
    throw control::Alarm("Function not enabled",
                         "The machine tool builder has fixed no position of the camera for the whole working space",
                         "name it as [camera.overview] in the setup, or take the image with cycle 601");
  }
  goToOverview(context, *overview);
  monitorByCamera(context, CoverAfterwards::Closed);
}

}  // namespace

extern const Entry cycle600 = {
    .definition = definition, .conditions = cameraConditions, .rules = cameraRules, .run = run};

}  // namespace probewright::cycles::heidenhain
