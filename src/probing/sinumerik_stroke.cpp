#include "probing/sinumerik_stroke.hpp"

#include <fmt/format.h>

#include "control/alarm.hpp"
#include "control/stopped_place.hpp"

namespace probewright::probing {

using control::Alarm;
using machine::MeasureEnd;
using machine::Sensor;

namespace {

Alarm notReady(Sensor sensor, const std::string& detail) {
  if (sensor == Sensor::TouchProbe) {
    return {"61309", detail.empty() ? "There is no workpiece probe in the spindle" : detail,
            "load a probe of type 710, 712, 713, 714 or 580 before the cycle, and see that it is switched on"};
  }
  return {"61309", detail.empty() ? "The machine has no tool touch probe" : detail,
          "connect the tool touch probe, see that it is switched on, and load the tool that is to touch it"};
}

}  // namespace

std::optional<StrokeTouch> carryOut(control::Channel& channel, const SinumerikStroke& stroke,
                                    const std::function<void(std::string)>& note) {
  for (int attempt = 0; attempt < stroke.attempts; ++attempt) {
    const machine::MeasureResult result =
        channel.measureTo(stroke.end, machine::Feed::at(stroke.feed), stroke.sensor, stroke.part);
    switch (result.end) {
      case MeasureEnd::Touched:
        return StrokeTouch{channel.touchFrom(result), result.spindleAngle};
      case MeasureEnd::NoContact:
        note("no contact");
        channel.retractTo(stroke.start, stroke.retract);
        break;
      case MeasureEnd::DeflectedAtStart:
        note("deflected");
        throw Alarm(
            "61302",
            control::deflectedAtStart(
                channel, "Probe collision: the probe is deflected before the measuring move begins", result.detail),
            "move the probe clear of the workpiece or correct the start position");
      case MeasureEnd::NotReady:
        note("not ready");
        throw notReady(stroke.sensor, result.detail);
      case MeasureEnd::AxisLimit:
        note("limit");
        throw Alarm(channel.alarms.limit, result.detail,
                    "check the zero offset and the position of the workpiece in the machine");
      case MeasureEnd::Collision:
      case MeasureEnd::Cancelled:  // the channel throws it, and what is refused
      case MeasureEnd::Refused:
        note("collision");
        throw Alarm(channel.alarms.collision, result.detail,
                    "correct the starting position; the path of the probe must be clear");
    }
  }
  return std::nullopt;
}

void refuseUntouched(const control::Channel& channel, double path) {
  throw Alarm("61301",
              fmt::format("Probe does not switch within {:.3f} mm; the {}", 2 * path, control::stoppedPlace(channel)),
              "check the setpoint, the measuring path DFA and the zero offset");
}

}  // namespace probewright::probing
