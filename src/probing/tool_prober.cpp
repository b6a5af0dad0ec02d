#include "probing/tool_prober.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "control/alarm.hpp"
#include "control/stopped_place.hpp"
#include "probing/heidenhain_prober.hpp"

namespace probewright::probing {

using control::Alarm;
using machine::Feed;
using machine::MeasureEnd;

ToolProber::ToolProber(control::Channel& channel, const WorkingPlane& plane, const ToolTouchProbe& probe,
                       double clearanceHeight)
    : channel_(channel),
      plane_(plane),
      probe_(probe),
      height_(std::max(clearanceHeight, probe.place[plane.tool] + probe.clearance)) {}

MachinePlace ToolProber::tip() const { return channel_.machineFromAxes(channel_.axes()); }

MachineWay ToolProber::inPlane(int axis, double value) const {
  Vector3 inPlane = Vector3::Zero();
  inPlane[axis] = value;
  return MachineWay(plane_.xyzFromPlane(inPlane));
}

void ToolProber::moveTo(const MachinePlace& tip) {
  channel_.moveAxes(channel_.axesFromMachine(tip, channel_.axes()), Feed::at(probe_.rapid));
}

void ToolProber::rise() {
  MachinePlace target = tip();
  if (target[plane_.tool] >= height_) return;
  target[plane_.tool] = height_;
  moveTo(target);
}

void ToolProber::approach(const MachinePlace& target) {
  rise();
  MachinePlace above = target;
  above[plane_.tool] = std::max(tip()[plane_.tool], height_);
  moveTo(above);
  moveTo(target);
}

ToolTouch ToolProber::stroke(const MachineWay& direction) {
  const MachinePlace start = tip();
  const ProgramPlace startInProgram = channel_.position();
  const ProgramPlace end = channel_.programFromMachine(start + probe_.reach * direction);
  control::TouchRecord record;
  // Where the tool is expected to touch.
  record.target = channel_.programFromMachine(start + probe_.clearance * direction).vector();
  record.direction = (end - startInProgram).normalized().vector();
  const machine::MeasureResult result = channel_.measureTo(end, Feed::at(probe_.feed), machine::Sensor::ToolTouchProbe);
  const auto fail = [&](const char* outcome, const std::string& code, const std::string& text, const char* advice) {
    record.seconds = channel_.seconds();
    record.outcome = outcome;
    channel_.journal().touch(record);
    throw Alarm(code, text, advice);
  };
  switch (result.end) {
    case MeasureEnd::Touched:
      break;
    case MeasureEnd::NoContact:
      fail("no contact", "Touch point inaccessible",
           fmt::format("The tool touch probe was not deflected within {:.3f} mm; the {}", probe_.reach,
                       control::stoppedPlace(channel_)),
           "check the position of the tool touch probe (centerPos, MP6580) and the tool's length and radius");
      break;
    case MeasureEnd::DeflectedAtStart:
      fail(
          "deflected", "Stylus already in contact",
          control::deflectedAtStart(channel_, "The tool touch probe is deflected before probing begins", result.detail),
          "check the length of the tool and MP6540");
      break;
    case MeasureEnd::NotReady:
      fail("not ready", "Touch probe not ready",
           result.detail.empty() ? "The machine has no tool touch probe" : result.detail,
           "connect the tool touch probe, and call a tool that is not a touch probe");
      break;
    case MeasureEnd::AxisLimit:
      fail("limit", channel_.alarms.limit, result.detail, "check the position of the tool touch probe (MP6580)");
      break;
    case MeasureEnd::Collision:
    case MeasureEnd::Cancelled:  // the channel throws it, and what is refused
    case MeasureEnd::Refused:
      fail("collision", channel_.alarms.collision, result.detail, "check the clearance height and the tool's data");
      break;
  }
  const control::Touch touch = channel_.touchFrom(result);
  channel_.retractTo(startInProgram, Feed::rapidTraverse());
  record.ballCentre = record.surface = touch.tip.vector();
  record.spindle = spindlePlace(channel_, touch.latched).vector();
  record.latched = touch.latched;
  record.seconds = channel_.seconds();
  record.outcome = "touched";
  channel_.journal().touch(record);
  return {channel_.machineFromAxes(touch.latched), result.spindleAngle};
}

ToolTouch ToolProber::touchTop(const Vector2& offset) {
  approach(tipAt(probe_.place, inPlane(0, offset.x())) + inPlane(1, offset.y()) + inPlane(2, probe_.clearance));
  return stroke(inPlane(2, -1));
}

ToolTouch ToolProber::touchSide(int axis, int sense, double toolRadius, double depth, double aside) {
  const double away = (axis == 0 ? probe_.size : probe_.size2) / 2 + toolRadius + probe_.clearance;
  approach(tipAt(probe_.place, inPlane(axis, -sense * away)) + inPlane(1 - axis, aside) + inPlane(2, -depth));
  const ToolTouch touched = stroke(inPlane(axis, sense));
  rise();
  return touched;
}

void ToolProber::centre() {
  rise();
  MachinePlace above = tipAt(probe_.place);
  above[plane_.tool] = std::max(tip()[plane_.tool], height_);
  moveTo(above);
}

}  // namespace probewright::probing
