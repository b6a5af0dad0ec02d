#include "cycles/sinumerik/measuring_method.hpp"

#include <cmath>

namespace probewright::cycles::sinumerik {

Method methodOf(Context& context) {
  const int digit = context.digit("S_MVAR", 5);
  if (digit > 2) context.alarm(61307, "10^4 of S_MVAR");
  const auto method = static_cast<Method>(digit);
  if (method == Method::Standard) return method;
  if (context.control().tool.type != 710 && context.control().tool.type != 580) {
    context.alarm(61309, "spindle reversal and alignment need a probe of type 710");
  }
  if (!context.channel().description().spindleOrients) context.alarm(61372);
  return method;
}

void requireCalibrationFor(Context& context, Method method) {
  if (method != Method::SpindleReversal) return context.requireCalibration();
  if (!(context.prober().ballRadius() > 0)) {
    context.alarm(61351, "the radius of the ball must be in the data set or in the tool data of the probe");
  }
}

double measuringDirection(Context& context, double toSetValue) {
  const int way = context.integer("S_MD");
  if (way < 0 || way > 2) context.alarm(61326, "S_MD is 1 (plus) or 2 (minus)");
  if (way != 0) return way == 1 ? 1 : -1;
  if (std::abs(toSetValue) < 1e-9) {
    context.alarm(61326, "S_MD leaves the direction open, and the probe is already at the set value");
  }
  return toSetValue > 0 ? 1 : -1;
}

Toucher::Toucher(Context& context, Method method)
    : context_(context), method_(method), spindle_(context.channel().spindleAngle()) {}

PartPoint Toucher::expectedFrom(const PlanePlace& start, const PlaneWay& direction, double path) const {
  return partAt(start, -(startOf({}, direction, path) - PlanePlace()));
}

PlanePlace Toucher::startOf(const PartPoint& setpoint, const PlaneWay& direction, double path) const {
  probing::SinumerikProber& prober = context_.prober();
  const PlanePlace upright = tipAt(setpoint, -prober.uprightTcp(direction));
  switch (method_) {
    case Method::SpindleReversal:
      return upright - direction * (path + prober.ballRadius());
    case Method::ProbeAligned:
      return upright - direction * (path + prober.probe().triggerPlus[0]);
    case Method::Standard:
      break;
  }
  return upright - direction * (path + prober.trigger(direction)) - prober.lateralDeviation(direction);
}

MeasuredPoint Toucher::measure(const PartPoint& setpoint, const PlaneWay& direction, double path) {
  probing::SinumerikProber& prober = context_.prober();
  const int count = context_.repetitions();
  switch (method_) {
    case Method::SpindleReversal:
      return measureReversed(setpoint, direction, path);
    case Method::ProbeAligned:
      prober.alignTo(direction);
      return prober.measureUncompensated(setpoint, direction, path, count, prober.probe().triggerPlus[0],
                                         prober.probe().feed);
    case Method::Standard:
      break;
  }
  return prober.measure(setpoint, direction, path, count);
}

MeasuredPoint Toucher::measureReversed(const PartPoint& setpoint, const PlaneWay& direction, double path) {
  probing::SinumerikProber& prober = context_.prober();
  const int count = context_.repetitions();
  const double radius = prober.ballRadius();
  const double feed = prober.probe().feed;
  for (const Deviation& known : deviations_) {
    const double along = known.direction.dot(direction);
    if (std::abs(std::abs(along) - 1) > 1e-9) continue;
    return prober.measureUncompensated(setpoint, direction, path, count, radius + known.along * along, feed);
  }
  context_.positionSpindle(spindle_ + 180);
  const MeasuredPoint reversed = prober.measureUncompensated(setpoint, direction, path, count, radius, feed);
  context_.positionSpindle(spindle_);
  MeasuredPoint point = prober.measureUncompensated(setpoint, direction, path, count, radius, feed);
  const double deviation = (reversed.tcp - point.tcp).dot(direction) / 2;
  deviations_.push_back({direction, deviation});
  point.surface = partAt(point.tcp, direction * (radius + deviation));
  return point;
}

void Toucher::finish() {
  if (method_ != Method::Standard) context_.positionSpindle(spindle_);
}

}  // namespace probewright::cycles::sinumerik
