#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters417[] = {
    coordinate(263, "Q263", "touch, main axis"),
    coordinate(264, "Q264", "touch, minor axis"),
    coordinate(294, "Q294", "touch, touch probe axis"),
    setUpClearance,
    clearanceHeight,
    presetTableRow,
    newPreset3,
    standard(transfer, -1),
};

constexpr ResultDefinition results417[] = {
    {"Q160", {"actual ", "coordinate of the touched point"}, result::actual(of::coordinate).main()}};

constexpr CycleDefinition definition = {
    .number = 417,
    .name = "417",
    .title = "PRESET IN TS AXIS",
    .family = CycleFamily::Preset,
    .summary = "Touches a surface in the touch probe axis and sets the preset of that axis.",
    .parameters = parameters417,
    .results = results417,
};

void run(Context& context, const Arguments&) {
  requireTransferTarget(context);
  const PlannedTouch planned{{context.q(263), context.q(264), context.q(294)}, probing::axisDirection(2, -1)};
  auto& prober = context.prober();
  prober.approach(prober.prePosition(planned, context.q(320)), context.q(260));
  const EvaluatedTouch touch = prober.touch(planned);
  prober.moveSouthPoleTo(context.q(260));
  context.result(160, touch.surface[2], {.nominal = context.q(294)});
  NewPreset preset;
  preset.measured = touch.surface;
  preset.wish[2] = context.q(333);
  transferPreset(context, preset);
}

}  // namespace

extern const Entry cycle417 = {.definition = definition, .conditions = {.under = Transformed::ByRotation}, .run = run};

}  // namespace probewright::cycles::heidenhain
