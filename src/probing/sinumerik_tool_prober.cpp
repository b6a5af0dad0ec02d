#include "probing/sinumerik_tool_prober.hpp"

#include <algorithm>

#include "probing/sinumerik_rapid.hpp"
#include "probing/sinumerik_stroke.hpp"

namespace probewright::probing {

void SinumerikToolProber::approach(const PlanePlace& tip) {
  if (position().z() < tip.z()) moveHeightTo(tip.z());
  moveInPlane(tip);
  moveHeightTo(tip.z());
}

ToolStrokeTouch SinumerikToolProber::touch(const ToolStroke& stroke) {
  const PlanePlace end = stroke.start + 2 * stroke.path * stroke.direction;
  control::TouchRecord record;
  record.target = plane_.xyzFromPlane(stroke.start + stroke.path * stroke.direction).vector();
  record.direction = plane_.xyzFromPlane(stroke.direction).vector();
  const auto finish = [&](std::string outcome) {
    record.seconds = channel_.seconds();
    record.outcome = std::move(outcome);
    channel_.journal().touch(record);
  };
  SinumerikStroke order = {.start = plane_.xyzFromPlane(stroke.start),
                           .end = plane_.xyzFromPlane(end),
                           .feed = stroke.feed,
                           .retract = machine::Feed::at(habits_.planeFeed),
                           .sensor = machine::Sensor::ToolTouchProbe,
                           .attempts = habits_.oneAttempt ? 1 : 5};
  if (habits_.rapidRetract) order.retract = reducedRapid(channel_, order.end, habits_.rapidPercent);
  const auto once = [&] {
    const auto touched = carryOut(channel_, order, finish);
    if (!touched) refuseUntouched(channel_, stroke.path);
    record.ballCentre = record.surface = touched->touch.tip.vector();
    record.latched = touched->touch.latched;
    finish("touched");
    return *touched;
  };
  if (stroke.mayApproachFast && habits_.fastApproach && stroke.path > 1) {
    // A first quick touch, back off, then the one that counts.
    order.feed = habits_.fastFeed;
    const PlanePlace back = plane_.planeFromXyz(once().touch.tip) - std::min(2.0, stroke.path) * stroke.direction;
    channel_.retractTo(plane_.xyzFromPlane(back), order.retract);
    order.feed = stroke.feed;
  }
  const StrokeTouch touched = once();
  channel_.retractTo(order.start, order.retract);
  return {plane_.planeFromXyz(touched.touch.tip), touched.spindleAngle};
}

}  // namespace probewright::probing
