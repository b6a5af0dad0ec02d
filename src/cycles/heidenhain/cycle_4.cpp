#include "control/alarm.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/free_measurement.hpp"
#include "cycles/heidenhain/free_measurement_parameters.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters4 = joined(
    std::array{resultNumber, standard(coordinate(probe_word::coordinate, "IX", "probing direction, X component"), 0),
               standard(coordinate(probe_word::coordinate + 1, "IY", "probing direction, Y component"), 0),
               standard(coordinate(probe_word::coordinate + 2, "IZ", "probing direction, Z component"), 0)},
    strokeOfBlock);

constexpr ResultDefinition results4[] = {{"Qn", "ball centre, X", result::actual(of::centreX)},
                                         {"Qn+1", "ball centre, Y", result::actual(of::centreY)},
                                         {"Qn+2", "ball centre, Z", result::actual(of::centreZ)},
                                         {"Qn+3", "1: touched, -1: not", result::status}};

constexpr CycleDefinition definition = {
    .number = 4,
    .name = "4",
    .title = "MEASURING IN 3-D",
    .family = CycleFamily::Special,
    .summary =
        "Measures from the present position of the probe in the direction of a vector and writes the ball centre and a "
        "status "
        "into four Q parameters. On the iTNC 530 a function of feature content level 3.",
    .parameters = parameters4,
    .results = results4,
};

void run(Context& context, const Arguments&) {
  measureFreely(context, {.direction = {context.q(probe_word::coordinate), context.q(probe_word::coordinate + 1),
                                        context.q(probe_word::coordinate + 2)},
                          .distance = context.q(probe_word::distance),
                          .directionInMachine = false,
                          .resultInMachine = context.option(probe_word::referenceSystem) == 1,
                          .withTipOffset = context.control().isTNC640(),
                          .alarmIfDeflected = true});
}

}  // namespace

extern const Entry cycle4 = {.definition = definition,
                             .conditions = {.under = Transformed::Any, .turningMode = true, .featureLevel = 3},
                             .run = run};

}  // namespace probewright::cycles::heidenhain
