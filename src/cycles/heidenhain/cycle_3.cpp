#include <cmath>

#include "control/alarm.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/free_measurement.hpp"
#include "cycles/heidenhain/free_measurement_parameters.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice axisChoices[] = {{0, "X"}, {1, "Y"}, {2, "Z"}};
constexpr Choice errorChoices[] = {{0, "stop if the stylus is deflected at the start"}, {1, "go on with a status"}};

constexpr std::array parameters3 = joined(
    joined(std::array{resultNumber, option(probe_word::axis, "AXIS", "probing axis", axisChoices),
                      angle(probe_word::angle, "ANGLE", "angle of the probing direction from the axis", -180, 180)},
           strokeOfBlock),
    std::array{standard(option(probe_word::errorMode, "ERRORMODE", "deflected stylus", errorChoices), 0)});

constexpr ResultDefinition results3[] = {
    {"Qn", "ball centre, X", result::actual(of::centreX)},
    {"Qn+1", "ball centre, Y", result::actual(of::centreY)},
    {"Qn+2", "ball centre, Z", result::actual(of::centreZ)},
    {"Qn+3", "1: touched, -1: not, 2: already deflected (iTNC 530, error mode 1)", result::status}};

constexpr CycleDefinition definition = {
    .number = 3,
    .name = "3",
    .title = "MEASURING",
    .family = CycleFamily::Special,
    .summary =
        "Measures from the present position of the probe in a direction of a coordinate plane and writes the "
        "uncorrected ball "
        "centre and a status into four Q parameters.",
    .parameters = parameters3,
    .results = results3,
};

void run(Context& context, const Arguments&) {
  const int axis = context.option(probe_word::axis);
  const double turn = radiansFromDegrees(context.q(probe_word::angle));
  // X counts towards Y, Y towards Z, Z towards X.
  Vector3 direction = Vector3::Zero();
  direction[axis] = std::cos(turn);
  direction[(axis + 1) % 3] = std::sin(turn);
  const bool inMachine = context.option(probe_word::referenceSystem) == 1;
  measureFreely(context, {.direction = direction,
                          .distance = context.q(probe_word::distance),
                          .directionInMachine = inMachine && context.control().isTNC640(),
                          .resultInMachine = inMachine,
                          .withTipOffset = false,
                          .alarmIfDeflected = context.option(probe_word::errorMode) == 0});
}

}  // namespace

extern const Entry cycle3 = {
    .definition = definition, .conditions = {.under = Transformed::Any, .turningMode = true}, .run = run};

}  // namespace probewright::cycles::heidenhain
