#include <algorithm>
#include <cmath>
#include <string_view>

#include "simulation/probe_signal.hpp"
#include "simulation/virtual_machine.hpp"

/// What the virtual machine feels: from the touch of a solid to the signal of a sensor.
namespace probewright::simulation {

using machine::Feed;
using machine::MeasureEnd;
using machine::MeasureOrder;
using machine::MeasureResult;
using machine::MoveEnd;
using machine::MoveResult;
using machine::Sensor;

namespace {

constexpr double measuringPrecision = 1e-7;  // mm

}  // namespace

double VirtualMachine::pretravel(const Motion& motion, const Touch& touch) const {
  const Matrix3 spindleFromTable = motion.tableFromSpindleAt(touch.fraction).linear().transpose();
  return pretravelOf(*tool_, carrying().angle, spindleFromTable * touch.normal);
}

VirtualMachine::Stop VirtualMachine::stopFor(const Motion& motion, const Touch& touch) {
  if (touch.shaft) return {touch, std::nullopt, touch.fraction};
  return signalStop(motion, touch);
}

VirtualMachine::Stop VirtualMachine::signalStop(const Motion& motion, const Touch& touch) {
  Stop stop{touch, std::nullopt, touch.fraction};
  const double length = motion.profile.length();
  if (length == 0) return stop;
  const TrueProbe& probe = tool_->probe;
  const double contact = touch.fraction * length;
  double signal = contact + pretravel(motion, touch) + motion.profile.speedAt(contact) * probe.signalDelay;
  if (probe.repeatability > 0) signal += probe.repeatability * gaussian_(noise_);
  const double braking = motion.profile.brakingDistanceAt(std::clamp(signal, 0.0, length));
  const double end = std::clamp(signal + braking, contact, contact + mostOvertravel * probe.ballRadius);
  stop.signal = signal / length;
  stop.end = std::min(end / length, 1.0);
  return stop;
}

MeasureResult VirtualMachine::refusedMeasurement(MoveResult why) const {
  return {why.end == MoveEnd::Cancelled ? MeasureEnd::Cancelled : MeasureEnd::Refused, reading_, std::move(why.detail)};
}

/// Where along the shaft it touches first, and when, as exactly as a ball there would: the search for shafts is
/// made for collisions. Near the place found the way to contact is a parabola over the shaft.
Touch VirtualMachine::preciseShaftTouch(const Motion& motion, const Touch& rough) const {
  const Shaft& shaft = shape_.shafts[*rough.shaft];
  const double length = shaft.axis.norm();
  const Vector3 along = shaft.axis / length;
  ToolShape bead;
  const auto touchAt = [&](double place) {
    bead.balls = {Ball{shaft.start + along * place, shaft.radius}};
    return firstTouch(motion, 0, 1, bead, surroundings_, {measuringPrecision});
  };
  const Vector3 inSpindle = motion.tableFromSpindleAt(rough.fraction).inverse() * rough.point;
  constexpr double apart = 0.25;  // mm
  double place = std::clamp((inSpindle - shaft.start).dot(along), 0.0, length);
  for (int i = 0; i < 2; ++i) {
    const auto below = touchAt(place - apart), here = touchAt(place), above = touchAt(place + apart);
    if (!below || !here || !above) break;
    const double bend = below->fraction - 2 * here->fraction + above->fraction;
    if (bend * motion.profile.length() < 1e-7) break;
    place = std::clamp(place + apart * std::clamp(0.5 * (below->fraction - above->fraction) / bend, -1.0, 1.0), 0.0,
                       length);
  }
  Touch precise = touchAt(place).value_or(rough);
  precise.shaft = rough.shaft;
  return precise;
}

MeasureResult VirtualMachine::measure(const MeasureOrder& order) {
  return order.sensor == Sensor::ToolTouchProbe ? measureTool(order) : measureWithProbe(order);
}

void VirtualMachine::lean(const Motion& measuring, const Touch& touch) {
  deflection_ = touch;
  if (kinematics_.isStraightWithoutPlay(measuring.from, measuring.to)) cameFrom_ = measuring.from;
}

MeasureResult VirtualMachine::measureWithProbe(const MeasureOrder& order) {
  const auto end = [&](MeasureEnd how, std::string detail) { return MeasureResult{how, reading_, std::move(detail)}; };
  if (stop_.stop_requested()) return end(MeasureEnd::Cancelled, stoppedText);
  if (!tool_ || tool_->kind != ToolKind::Probe)
    return end(MeasureEnd::NotReady, "there is no touch probe in the spindle");
  if (!tool_->probe.switchedOn) return end(MeasureEnd::NotReady, "the touch probe is switched off");
  if (auto refused = refusal(order.feed, order.target)) return refusedMeasurement(*std::move(refused));
  if (deflection_) return end(MeasureEnd::DeflectedAtStart, describe(*deflection_));
  if (auto limit = beyondTravel(order.target)) return end(MeasureEnd::AxisLimit, *limit);
  const Motion motion = motionTo(order.target, order.feed);
  std::optional<Touch> touch;
  std::optional<BodyHit> hit;
  try {
    touch = firstTouchOf(motion, 0, searchOptions(measuringPrecision));
    hit = bodyHit(motion, touch);
  } catch (const SearchStopped& stopped) {
    standAt(motion, stopped.fraction, PathKind::Measure);
    return end(MeasureEnd::Cancelled, stoppedText);
  }
  if (hit) {
    std::string detail = stopAt(motion, *hit, PathKind::Measure);
    return end(MeasureEnd::Collision, std::move(detail));
  }
  const bool shaftSignals = order.part == machine::TouchWith::Shaft;
  if (!touch) {
    advance(motion, Stop{}, PathKind::Measure);
    return end(MeasureEnd::NoContact, reachedText);
  }
  const bool byShaft = touch->shaft && std::string_view(shape_.shafts[*touch->shaft].part) == shaftName;
  if (byShaft && shaftSignals) touch = preciseShaftTouch(motion, *touch);
  if (touch->shaft && !(byShaft && shaftSignals)) {
    advance(motion, Stop{touch, std::nullopt, touch->fraction}, PathKind::Measure);
    return end(MeasureEnd::Collision, describe(*touch));
  }
  const Stop stop = signalStop(motion, *touch);
  if (stop.signal && *stop.signal > 1) {
    // The stylus leans against the surface without a signal: the way back must free it as after a touch.
    advance(motion, Stop{}, PathKind::Measure);
    if (!byShaft) lean(motion, *touch);
    return end(MeasureEnd::NoContact, tellsTouches_
                                          ? "the target was reached before the stylus was deflected enough for a signal"
                                          : reachedText);
  }
  advance(motion, stop, PathKind::Measure);
  if (!byShaft) lean(motion, *touch);
  // Nobody reads what was touched where it was meant to be.
  return {MeasureEnd::Touched, motion.readingAt(stop.signal.value_or(stop.end)), {}};
}

}  // namespace probewright::simulation
