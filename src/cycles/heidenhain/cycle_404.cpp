#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

/// The TNC 640 can name a row; -1 is the active preset.
constexpr Parameter presetRow = only({.name = "Q305",
                                      .address = 305,
                                      .meaning = "row of the preset table; -1: the active one, 0: copy it to row 0",
                                      .kind = ValueKind::Integer,
                                      .minimum = -1,
                                      .maximum = 99999,
                                      .standard = -1},
                                     control::onTNC640);

constexpr Parameter parameters404[] = {angle(307, "Q307", "angle that the basic rotation is set to"), presetRow};

constexpr CycleDefinition definition = {
    .number = 404,
    .name = "404",
    .title = "SET BASIC ROTATION",
    .family = CycleFamily::Misalignment,
    .summary = "Sets the basic rotation to a given angle without measuring.",
    .parameters = parameters404,
    .results = {},
};

void run(Context& context, const Arguments&) {
  const int row = context.option(305);
  if (row == 0) copyActivePresetTo0(context, {});
  setBasicRotation(context, context.q(307), row > 0 ? row : 0);
}

}  // namespace

extern const Entry cycle404 = {.definition = definition, .conditions = {.uses = Uses::Nothing}, .run = run};

}  // namespace probewright::cycles::heidenhain
