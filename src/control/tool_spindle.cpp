#include "control/tool_spindle.hpp"

#include "control/alarm.hpp"

namespace probewright::control {

namespace {

void judge(const Channel& channel, const machine::MoveResult& result) {
  switch (result.end) {
    case machine::MoveEnd::Reached:
      return;
    case machine::MoveEnd::Cancelled:
      throw Cancelled();
    case machine::MoveEnd::Refused:
      throw Alarm(channel.alarms.orientation, result.detail, "see what the machine lacks");
    case machine::MoveEnd::AxisLimit:
      throw Alarm(channel.alarms.limit, result.detail);
    case machine::MoveEnd::ProbeSignal:
    case machine::MoveEnd::Collision:
      throw Alarm(channel.alarms.collision, result.detail, "turn the tool where it is clear of everything");
  }
}

}  // namespace

machine::ToolSpindle* toolSpindleOf(Channel& channel) {
  auto* spindle = dynamic_cast<machine::ToolSpindle*>(&channel.machine());
  return spindle != nullptr && spindle->drivesTools() ? spindle : nullptr;
}

void turnTool(Channel& channel, machine::ToolSpindle& spindle, machine::Rotation rotation, double speed) {
  judge(channel, spindle.turnTool(rotation, speed));
}

void orientTool(Channel& channel, machine::ToolSpindle& spindle, double degrees) {
  judge(channel, spindle.orientTool(degrees));
}

}  // namespace probewright::control
