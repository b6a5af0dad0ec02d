#include <algorithm>
#include <cmath>
#include <limits>

#include "control/alarm.hpp"
#include "language/klartext/host.hpp"

/// M functions. Those without an effect on a measuring run (spindle, coolant, feed behaviour) are accepted.
namespace probewright::language::klartext {

using control::Alarm;
using control::Feed;

void KlartextHost::machineFunction(const MachineFunction& function, Evaluation& evaluation) {
  switch (function.number) {
    case 3:
    case 13:
    case 4:
    case 14:
      spindleRuns_ = spindleHasRun_ = true;
      clockwise_ = function.number == 3 || function.number == 13;
      control_.q.setQ(110, spindleState());
      break;
    case 5:
    case 6:
      spindleRuns_ = false;
      control_.q.setQ(110, spindleState());
      break;
    case 89:
      contour_.flush();
      cycleAtEachMove_ = true;
      callMachiningCycle();
      break;
    case 126:
      shortestPath_ = true;
      break;
    case 127:
      shortestPath_ = false;
      break;
    case 128:
      settle();
      setHoldTip(true);
      break;
    case 129:
      settle();
      setHoldTip(false);
      break;
    case 140: {
      settle();
      std::optional<double> distance;
      if (const Word* back = find(function.words, "MB", evaluation); back != nullptr && back->value.present()) {
        distance = length(back->value, evaluation);
        if (!(*distance >= 0)) {
          throw Alarm("Retraction not permitted", "M140 MB goes back along the tool axis: its way cannot be negative",
                      "program a way from 0 on, or MB MAX");
        }
      }
      Feed feed = Feed::rapidTraverse();
      if (function.argument.present()) feed = Feed::at(length(function.argument, evaluation));
      retract(distance, feed);
      break;
    }
    default:
      break;
  }
}

/// Away from the workpiece along the tool axis, by a distance or to the limit of travel.
void KlartextHost::retract(std::optional<double> distance, Feed feed) {
  control::Channel& channel = control_.channel;
  const machine::MachineDescription& description = channel.description();
  const Vector3 start = channel.position();
  const Vector3 direction = channel.toolAxis();
  const machine::AxisPositions from = channel.axes();
  double way = distance.value_or(std::numeric_limits<double>::infinity());
  if (!distance) {
    const machine::AxisPositions ahead = channel.axesFromProgram(start + direction, from);
    for (std::size_t i = 0; i < description.axes.size(); ++i) {
      const double slope = ahead[i] - from[i];
      if (std::abs(slope) < 1e-9) continue;
      const double limit = slope > 0 ? description.axes[i].maximum : description.axes[i].minimum;
      way = std::min(way, std::max(0.0, (limit - from[i]) / slope));
    }
    if (!std::isfinite(way)) return;
    // Stay clear of the limit by less than any control shows.
    way = std::max(0.0, way - 1e-6);
  }
  channel.moveTo(start + way * direction, feed);
}

void KlartextHost::setHoldTip(bool hold) {
  if (hold) {
    const auto& axes = control_.channel.description().axes;
    const bool turns =
        std::ranges::any_of(axes, [](const machine::Axis& axis) { return axis.kind == machine::AxisKind::Rotary; });
    if (!turns) {
      throw Alarm("Function not available", "M128 and FUNCTION TCPM need a machine with rotary axes",
                  "take the function out or choose a machine that has them");
    }
  }
  control_.channel.holdTip = hold;
  referencePoint_ = ReferencePoint::TipTip;
  spaceAngles_ = false;
  placeControlledPoint();
  control_.applyCoordinates();
}

}  // namespace probewright::language::klartext
