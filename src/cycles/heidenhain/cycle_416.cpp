#include "control/alarm.hpp"
#include "cycles/heidenhain/bolt_circle_measurement.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters416 =
    joined(joined(boltCircleParameters, centreTransfer), std::array{later(standard(setUpClearance, 0), 5)});

constexpr ResultDefinition results416[] = {
    {"Q151", {"actual ", "centre, main axis"}, result::actual(of::centre1).main()},
    {"Q152", {"actual ", "centre, minor axis"}, result::actual(of::centre2).main()},
    {"Q153", {"actual ", "diameter of the bolt hole circle"}, result::actual(of::diameter).main()},
};

constexpr CycleDefinition definition = {
    .number = 416,
    .name = "416",
    .title = "PRESET CIRCLE CENTER",
    .family = CycleFamily::Preset,
    .summary = "Measures three holes of a bolt hole circle and sets the preset to its centre.",
    .parameters = parameters416,
    .results = results416,
};

void run(Context& context, const Arguments&) {
  requireTransferTarget(context);
  const MeasuredCircle circle = measureBoltCircle(context);
  context.result(151, circle.centre.x(), {.nominal = context.q(273)});
  context.result(152, circle.centre.y(), {.nominal = context.q(274)});
  context.result(153, circle.diameter, {.nominal = context.q(262)});
  finishPreset(context, {.measured = circle.centre, .wish = {context.q(331), context.q(332)}, .rotation = {}});
}

}  // namespace

extern const Entry cycle416 = {.definition = definition, .conditions = {.under = Transformed::ByRotation}, .run = run};

}  // namespace probewright::cycles::heidenhain
