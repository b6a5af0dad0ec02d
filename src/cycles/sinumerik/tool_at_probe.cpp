#include "cycles/sinumerik/tool_at_probe.hpp"

namespace probewright::cycles::sinumerik {

void requireUprightTool(Context& context) {
  const control::Channel& channel = context.channel();
  if (channel.toolVector.isZero(1e-9)) return;
  const PlaneWay axis = context.control().workingPlane().planeFromXyz(channel.toolAxis());
  if (axis.z() < 1 - 1e-9) context.alarm(61330, "the tool is not parallel to the 3rd axis of the plane");
}

double signOfTouch(Context& context, int axis, const ToolProbeField& field) {
  const int way = context.integer("S_MD");
  if (way < 0 || way > 2) context.alarm(61326, "S_MD is 0, 1 (plus) or 2 (minus)");
  if (way != 0) return way == 1 ? 1 : -1;
  return sideOfTool(context, axis, field);
}

double sideOfTool(Context& context, int axis, const ToolProbeField& field) {
  const PlanePlace here = context.control().workingPlane().planeFromXyz(context.channel().position());
  return here[axis] < field.centre(axis) ? 1 : -1;
}

ToolAtProbe::ToolAtProbe(Context& context, const ToolProbeField& field, double feed, double below)
    : context_(context),
      field_(field),
      prober_(context.channel(), context.control().workingPlane(), habitsOf(context.control(), Measures::Tools)),
      radius_(context.control().tool.radius),
      path_(context.real("S_FA")),
      feed_(feed),
      below_(below),
      top_(field.trigger(2, -1)) {}

void ToolAtProbe::goAbove(const Vector2& place) { prober_.approach({place.x(), place.y(), top_ + path_}); }

void ToolAtProbe::goBeside(int axis, double sign, double across) {
  PlanePlace start;
  start[axis] = field_.trigger(axis, sign) - sign * (radius_ + path_);
  start[1 - axis] = across;
  start[2] = top_ - field_.depth - below_;
  prober_.approach(start);
}

void ToolAtProbe::rise() {
  const double clear = top_ + path_;
  if (prober_.position().z() < clear) prober_.moveHeightTo(clear);
}

PlanePlace ToolAtProbe::touch(const PlaneWay& direction) {
  const PlanePlace start = prober_.position();
  Vector3 sum = Vector3::Zero();
  const int count = context_.repetitions();
  for (int i = 0; i < count; ++i)
    sum += prober_.touch({.start = start, .direction = direction, .path = path_, .feed = feed_}).tip.vector();
  return PlanePlace(sum / count);
}

probing::ToolStrokeTouch ToolAtProbe::touchTurning(const PlaneWay& direction, double feed) {
  return prober_.touch(
      {.start = prober_.position(), .direction = direction, .path = path_, .feed = feed, .mayApproachFast = false});
}

}  // namespace probewright::cycles::sinumerik
