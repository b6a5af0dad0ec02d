#include "cycles/heidenhain/single_touch.hpp"

#include "control/alarm.hpp"
#include "cycles/heidenhain/probe_words.hpp"

namespace probewright::cycles::heidenhain {

void moveToProgrammedPosition(Context& context) {
  control::Channel& channel = context.channel();
  const machine::MachineDescription& description = channel.description();
  auto& prober = context.prober();
  control::Target target;
  bool turns = false;
  ProgramPlace tip = channel.position();
  for (int i = 0; i < 6; ++i) {
    const int number = static_cast<int>(probe_word::coordinate) + i;
    if (!context.given(number)) continue;
    if (i < 3) {
      tip[i] = context.q(number);
      target.linear[static_cast<std::size_t>(i)] = tip[i];
      continue;
    }
    const char name = static_cast<char>('A' + i - 3);
    const auto axis = description.axisIndex(std::string_view(&name, 1));
    if (!axis) throw control::Alarm("Axis not available", std::string("The machine has no axis ") + name);
    target.rotary[*axis] = context.q(number);
    turns = true;
  }
  if (turns) {
    channel.moveTo(target, machine::Feed::at(prober.probe().positioningFeed));
    return;
  }
  const control::WorkingPlane& plane = context.control().coordinates.plane;
  prober.moveTo(prober.positionWithTip(plane.planeFromXyz(tip)));
}

void storeTouchPosition(Context& context, const EvaluatedTouch& touch) {
  control::Channel& channel = context.channel();
  const ProgramPlace reference = probing::spindlePlace(channel, touch.latched);
  for (int i = 0; i < 3; ++i)
    context.result(115 + i, reference[i]);
  int number = 118;
  const auto& axes = channel.description().axes;
  for (std::size_t i = 0; i < axes.size() && number <= 119; ++i) {
    if (axes[i].kind != machine::AxisKind::Rotary) continue;
    context.result(number++, touch.latched[i] - channel.rotaryOffset[i]);
  }
}

}  // namespace probewright::cycles::heidenhain
