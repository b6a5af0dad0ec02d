#include <fmt/format.h>

#include <cmath>

#include "control/alarm.hpp"
#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/hole_measurement.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/rotary_alignment.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters405[] = {
    coordinate(321, "Q321", "nominal centre of the hole in the main axis"),
    coordinate(322, "Q322", "nominal centre in the minor axis; 0: align to the positive Y axis"),
    length(262, "Q262", "nominal diameter of the hole, rather too small than too large"),
    angle(325, "Q325", "angle of the first touch from the main axis"),
    angle(247, "Q247", "angle from touch to touch, negative: clockwise; at least 5 degrees", -120, 120),
    measuringHeight,
    setUpClearance,
    clearanceHeight,
    moveToClearance,
    {.name = "Q337",
     .address = 337,
     .meaning = "0: set the angle of C to zero; above: row of the datum table that takes the offset",
     .kind = ValueKind::Integer,
     .minimum = 0,
     .maximum = 2999},
};

constexpr ResultDefinition results405[] = {
    {"Q150", {"measured ", "angular offset"}, result::actual(of::angle).main()},
};

constexpr CycleDefinition definition = {
    .number = 405,
    .name = "405",
    .title = "ROT IN C AXIS",
    .family = CycleFamily::Misalignment,
    .summary =
        "Measures a hole and turns the C axis until its centre lies in the direction of the positive Y axis or of its "
        "nominal position.",
    .parameters = parameters405,
    .results = results405,
};

void run(Context& context, const Arguments&) {
  requireTable(context, 2);
  const int row = context.option(337);
  if (row == 0) {
    context.control().requireWritablePreset(context.control().coordinates.preset.row);
  } else {
    requireDatumTable(context, fmt::format("Q337 = {} enters", row), "set the angle of C to zero with Q337 = 0");
  }
  const MeasuredCircle circle =
      measureCircle(context, {321, 322, 262}, Side::Inside, probing::Ending::AtMeasuringHeight);
  context.prober().moveTo(ballAt(circle.centre));
  context.prober().moveSouthPoleTo(context.q(260));
  // The C axis turns in the plane of X and Y whatever the touch probe axis is.
  const auto& plane = context.control().coordinates.plane;
  const auto inXY = [&](const PartPoint& place) {
    const PartInProgram xyz = plane.xyzFromPlane(place);
    return angleOf(Vector2::Zero(), {xyz.x(), xyz.y()});
  };
  const double target = context.q(322) == 0 ? 90 : inXY({context.q(321), context.q(322), context.q(261)});
  const double offset = normalizedDegrees(inXY(circle.centre) - target);
  if (plane.xyzFromPlane(PartPoint(context.q(321), context.q(322), context.q(261))).y() < 0) {
    context.warn("The hole must lie on the positive side of the Y axis: the control assumes that");
  }
  context.result(150, offset);
  const std::size_t axis = turnWorkpiece(context, 2, -offset);
  if (row == 0) {
    zeroRotaryAxisInPreset(context, axis, PresetRow::Active);
  } else {
    addDatumAngle(context, axis, row, offset);
  }
}

}  // namespace

extern const Entry cycle405 = {.definition = definition, .conditions = {.tilted = control::onITNC530}, .run = run};

}  // namespace probewright::cycles::heidenhain
