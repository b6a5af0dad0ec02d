#include "cycles/heidenhain/cycles.hpp"
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

}  // namespace

const CycleDefinition cycle404Definition = {
    .number = 404,
    .name = "404",
    .title = "SET BASIC ROTATION",
    .family = CycleFamily::Misalignment,
    .summary = "Sets the basic rotation to a given angle without measuring.",
    .parameters = parameters404,
    .results = {},
};

void cycle404(Context& context, const Arguments&) {
  context.require({.probes = false});
  const int row = context.option(305);
  if (row == 0) copyActivePresetTo0(context, {});
  setBasicRotation(context, context.q(307), row > 0 ? row : 0);
}

}  // namespace probewright::cycles::heidenhain
