#include "cycles/heidenhain/parameters.hpp"
#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_probe_calibration.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice stopChoices[] = {{0, "stop: the operator puts the tool above the tool touch probe"},
                                  {1, "no stop: the tool is above the tool touch probe already"}};

constexpr Parameter parameters484[] = {
    only(standard(option(536, "Q536", "stop before the cycle begins", stopChoices), 0), control::onTNC640)};

constexpr CycleDefinition definition = {
    .number = 484,
    .name = "484",
    .title = "CALIBRATE IR TT",
    .family = CycleFamily::Tool,
    .summary =
        "Calibrates a tool touch probe whose place the control does not know, as of an infrared one, with an exact "
        "cylindrical tool that stands above the middle of its contact.",
    .parameters = parameters484,
};

void run(Context& context, const Arguments&) {
  requireCalibratingTool(context);
  auto& control = context.control();
  control::Channel& channel = context.channel();
  const bool stops = !control.isTNC640() || context.option(536) == 0;
  if (stops)
    context.stop("Position the calibrating tool above the middle of the tool touch probe, then press NC start");
  const MachinePlace start = channel.machineFromAxes(channel.axes());
  // The contact is somewhere below: as far down as the tool searches.
  PartInMachine middle = partAt(start);
  middle[control.coordinates.plane.tool] -= control.parameters.mp6540;
  calibrateToolProbe(context, middle, start[control.coordinates.plane.tool]);
}

}  // namespace

extern const Entry cycle484 = {.definition = definition, .conditions = toolConditions, .run = run};

}  // namespace probewright::cycles::heidenhain
