#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters419[] = {
    coordinate(263, "Q263", "touch, main axis"),
    coordinate(264, "Q264", "touch, minor axis"),
    measuringHeight,
    setUpClearance,
    clearanceHeight,
    measuringAxis3,
    probingDirection,
    presetTableRow,
    standard(coordinate(333, "Q333", "coordinate that the touched point gets in the measuring axis"), 0),
    standard(transfer, -1),
};

constexpr CycleDefinition definition = {
    .number = 419,
    .name = "419",
    .title = "PRESET IN ONE AXIS",
    .family = CycleFamily::Preset,
    .summary = "Touches a point in any axis and sets the preset of that axis.",
    .parameters = parameters419,
    .results = {},
};

void run(Context& context, const Arguments&) {
  requireTransferTarget(context);
  const int axis = context.option(272) - 1;
  const PlannedTouch planned{{context.q(263), context.q(264), context.q(261)},
                             probing::axisDirection(axis, context.option(267))};
  auto& prober = context.prober();
  prober.approach(prober.prePosition(planned, context.q(320)), context.q(260));
  const EvaluatedTouch touch = prober.touch(planned);
  prober.moveSouthPoleTo(context.q(260));
  NewPreset preset;
  preset.measured = touch.surface;
  preset.wish[static_cast<std::size_t>(axis)] = context.q(333);
  transferPreset(context, preset);
}

}  // namespace

extern const Entry cycle419 = {.definition = definition, .conditions = {.under = Transformed::ByRotation}, .run = run};

}  // namespace probewright::cycles::heidenhain
