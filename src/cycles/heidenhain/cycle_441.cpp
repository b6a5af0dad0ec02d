#include <fmt/format.h>

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice feedChoices[] = {{0, "at the feed rate Q396"}, {1, "at machine rapid traverse"}};
constexpr Choice trackChoices[] = {{0, "do not orient"}, {1, "orient the spindle before each probing"}};
constexpr Choice interruptChoices[] = {{0, "never"}, {1, "after every inspection cycle"}};

constexpr Parameter parameters441[] = {
    {.name = "Q396",
     .address = 396,
     .meaning = "feed rate of the positioning moves, also FMAX or FAUTO",
     .kind = ValueKind::Feed,
     .minimum = 0},
    option(397, "Q397", "pre-positioning", feedChoices),
    option(399, "Q399", "tracking of the probe", trackChoices),
    option(400, "Q400", "interrupt and show the results", interruptChoices),
};

constexpr CycleDefinition definition = {
    .number = 441,
    .name = "441",
    .title = "FAST PROBING",
    .family = CycleFamily::Special,
    .summary =
        "Sets positioning feed, tracking and interruption for all touch probe cycles that follow, until the end of the "
        "program. On the iTNC 530 a function of feature content level 2.",
    .parameters = parameters441,
    .results = {},

};

void run(Context& context, const Arguments&) {
  auto& overrides = context.control().overrides;
  const Control& control = context.control();
  double feed = context.q(396);
  const bool rapid = context.arguments().number(396) >= largest;  // FMAX
  if (const double limit = control.parameters.maxTouchFeed; control.isTNC640() && !rapid && feed > limit) {
    context.warn(fmt::format("Q396 = {:.0f} mm/min is limited to {:.0f} mm/min (maxTouchFeed)", feed, limit));
    feed = limit;
  }
  if (feed > 0) overrides.positioningFeed = feed;
  overrides.machineRapid = context.option(397) == 1;
  // The older control tracks only where its machine parameter has it prepared.
  overrides.track = context.option(399) == 1 && (control.isTNC640() || control.parameters.mp6165);
  if (context.option(399) == 1 && !*overrides.track) {
    context.warn("Q399 = 1 has no effect: MP6165 does not allow the probe to be turned to the touches");
  }
  overrides.interrupt = context.option(400) == 1;
}

}  // namespace

extern const Entry cycle441 = {.definition = definition,
                               .conditions = {.uses = Uses::Nothing, .under = Transformed::Any, .featureLevel = 2},
                               .run = run};

}  // namespace probewright::cycles::heidenhain
