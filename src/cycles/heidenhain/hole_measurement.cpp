#include "cycles/heidenhain/hole_measurement.hpp"

#include <cmath>

#include "control/alarm.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/heidenhain/rotary_alignment.hpp"
#include "cycles/heidenhain/transfer.hpp"
#include "metrology/fits.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {
PartPoint measureHoleCentre(Context& context, const Vector2& centre, double measuringHeight) {
  auto& prober = context.prober();
  BallCentre place(centre.x(), centre.y(), measuringHeight);
  prober.approach(place, context.q(260));
  for (const int axis : {0, 1}) {
    const EvaluatedTouch plus = prober.stroke(probing::axisDirection(axis, 1));
    const EvaluatedTouch minus = prober.stroke(probing::axisDirection(axis, -1));
    place[axis] = (plus.ballCentre[axis] + minus.ballCentre[axis]) / 2;
    if (axis == 0) prober.moveTo(place);
  }
  prober.moveSouthPoleTo(context.q(260));
  return partAt(place);
}

PartPoint measureStudCentre(Context& context, const Vector2& centre, double diameter, double measuringHeight) {
  const probing::CircleTask task{.centre = centre, .diameter = diameter, .side = Side::Outside};
  const auto touches = probing::probeCircle(context.prober(), task,
                                            {.measuring = measuringHeight,
                                             .clearance = context.q(260),
                                             .extraClearance = context.q(320),
                                             .between = betweenOf(context)});
  std::vector<Vector3> centres;
  centres.reserve(touches.size());
  for (const EvaluatedTouch& touch : touches)
    centres.push_back(touch.ballCentre.vector());
  const auto fit = metrology::fitCircleInPlane(centres, Vector3::UnitZ(), withCofactors);
  if (!fit) throw control::Alarm("Circle not determined", fit.error().message, fit.error().advice);
  context.channel().journal().fit(recordOf(*fit, placesOf(touches)));
  return PartPoint(fit->shape.centre);
}

double angleOf(const Vector2& first, const Vector2& second) {
  const Vector2 along = second - first;
  if (along.norm() < 1e-6)
    throw control::Alarm("Angle not determined", "The two centres coincide", "move the points apart");
  return degreesFromRadians(std::atan2(along.y(), along.x()));
}

void twoHoleRules(CallRules& call) {
  const auto first = call.numbers({268, 269}), second = call.numbers({270, 271});
  if (first && first == second)
    call.refuse("Angle not determined", 271, "The two centres coincide", "move the points apart");
}

void requireCompensation(Context& context) {
  const Control& control = context.control();
  const int active = control.coordinates.preset.row;
  const int row = context.option(305);
  if (context.option(402) == 1) {
    requireTable(context, control.coordinates.plane.tool);
    const bool zero = context.option(337) == 1;
    const bool entersRow = zero && control.isTNC640();
    if (entersRow || zero || control.isTNC640()) control.requireWritablePreset(entersRow ? row : active);
    if (!control.coordinates.preset.spaceAngles.isZero(0)) control.requireWritablePreset(active);
  } else {
    control.requireWritablePreset(row == 0 && !control.isTNC640() ? active : row);
  }
}

void compensateByRotationOrTable(Context& context, double angle) {
  const double misalignment = normalizedDegrees(angle - context.q(307));
  if (context.option(402) == 0) {
    if (context.option(337) == 1) {
      context.warn("Q337 = 1 sets a rotary axis to zero that Q402 = 0 does not turn: it has no effect");
    }
    // The TNC 640 makes row 0 the active preset; older controls know it as the preset set by hand.
    if (context.option(305) == 0 && context.control().isTNC640()) {
      copyActivePresetTo0(context, rotationChange(context, misalignment));
    } else {
      setBasicRotation(context, misalignment, context.option(305));
    }
    return;
  }
  const machine::AxisPositions before = context.channel().axes();
  const std::size_t axis = turnWorkpiece(context, context.control().coordinates.plane.tool, -misalignment);
  enterAlignment(context, axis, context.channel().axes()[axis] - before[axis]);
}

}  // namespace probewright::cycles::heidenhain
