#include "cycles/sinumerik/turning.hpp"

#include <algorithm>

namespace probewright::cycles::sinumerik {

double measureOf(const Context& context) { return context.control().diameter ? 2 : 1; }

void turnWorkpiece(Context& context, double degrees) {
  const machine::MachineDescription& description = context.channel().description();
  for (const machine::ChainElement& element : description.tableChain) {
    if (!element.axis || description.axes[*element.axis].kind != machine::AxisKind::Rotary) continue;
    machine::AxisPositions target = context.channel().axes();
    target[*element.axis] = degrees + context.channel().rotaryOffset[*element.axis];
    context.channel().moveAxes(target, machine::Feed::rapidTraverse());
    return;
  }
  if (!description.spindleOrients) context.alarm(61372);
  context.channel().orientSpindle(degrees);
}

ToolInfluence influenceOnTurning(const Context& context, int measuringAxis, double side, double measure) {
  // Measurements in Y correct what acts in X, the 2nd axis in the turning plane.
  const int correctedAxis = measuringAxis == 2 && context.control().plane == 18 ? 1 : measuringAxis;
  return {.radius = side / measure, .length = -1 / measure, .radiusFromAxis = true, .measuringAxis = correctedAxis};
}

void reportTurned(Context& context, int axis, double set, double actual, double difference, const Compared& compared) {
  for (const int element : {0, 1 + axis})
    context.result(element, set);
  for (const int element : {4, 5 + axis})
    context.result(element, actual, compared);
  for (const int element : {16, 17 + axis})
    context.result(element, difference);
  context.noteCall();
}

}  // namespace probewright::cycles::sinumerik
