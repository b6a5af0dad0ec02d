#include "cycles/sinumerik/turning.hpp"

#include <fmt/format.h>

#include <array>

#include "control/sinumerik/measuring_data.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr std::array axisNames = {"X", "Y", "Z"};

/// What turns the workpiece: the main spindle, or the rotary axis next to the bed.
std::optional<std::size_t> workpieceAxis(const machine::MachineDescription& description) {
  if (description.mainSpindle) return description.spindleOrients ? description.mainSpindle : std::nullopt;
  for (const machine::ChainElement& element : description.tableChain) {
    if (element.axis && description.axes[*element.axis].kind == machine::AxisKind::Rotary) return element.axis;
  }
  return std::nullopt;
}

}  // namespace

void requireTurningProbe(Context& context) {
  context.requireProbe({580});
  const int position = context.control().tool.position;
  if (position < 5 || position > 8) context.alarm(61315, fmt::format("$TC_DP2 = {}, 5 to 8 are possible", position));
}

void requireUnturned(Context& context) {
  const Matrix3 turned = context.control().machineFromWorkpiece().linear();
  if ((turned.cwiseAbs() - Matrix3::Identity()).norm() > 1e-9) {
    context.alarm(61330, "turned parts are measured along the axes of the machine");
  }
}

int turningAxis(Context& context, int code, ThirdAxis third) {
  if (code < 1 || code > 3) context.alarm(61325, fmt::format("axis {} of S_MA: 1 to 3 are possible", code));
  const auto plane = context.control().workingPlane();
  const int axis = code == 1 ? plane.main : code == 2 ? plane.minor : plane.tool;
  const char* name = axisNames[static_cast<std::size_t>(axis)];
  if (!context.channel().description().axisIndex(name)) context.alarm(61336, fmt::format("axis {}", name));
  if (code == 3 && third == ThirdAxis::Released && !maskBit(context.control().data, "$MCS_MEA_FUNCTION_MASK", 1)) {
    context.alarm(61336, fmt::format("bit 1 of MD 52740 does not release axis {} for turning", name));
  }
  return code - 1;
}

void requireTrigger(Context& context, int axis, double sign) {
  if (!maskBit(context.control().data, "$MNS_MEA_FUNCTION_MASK", 0)) return;
  const probing::SinumerikProbe& probe = context.prober().probe();
  const auto index = static_cast<std::size_t>(axis);
  const bool plus = (sign > 0) != context.prober().mirrored(axis);
  if ((plus ? probe.triggerPlus : probe.triggerMinus)[index] != 0) return;
  context.alarm(61341, fmt::format("data set {} has no trigger point for the {} direction of axis {} of the plane",
                                   context.dataSet() + 1, sign > 0 ? "plus" : "minus", axis + 1));
}

double countOf(const Context& context, int axis) {
  const control::WorkingPlane plane = context.control().workingPlane();
  const bool transverse = axis == 2 || (axis == 0 ? plane.main : plane.minor) == 0;
  return context.control().diameter && transverse ? 2 : 1;
}

void requireWorkpieceSpindle(Context& context) {
  if (!workpieceAxis(context.channel().description())) context.alarm(61372);
}

void turnWorkpiece(Context& context, double degrees) {
  control::Channel& channel = context.channel();
  if (channel.description().mainSpindle) return context.positionSpindle(degrees);
  const auto axis = workpieceAxis(channel.description());
  if (!axis) context.alarm(61372);
  machine::AxisPositions target = channel.axes();
  target[*axis] = degrees + channel.rotaryOffset[*axis];
  channel.moveAxes(target, machine::Feed::rapidTraverse());
}

void concludeTurned(Context& context, Task task, TurnedFeature feature, const TurnedDimension& dimension,
                    double direction) {
  const int axis = dimension.axis;
  const double empirical = task == Task::Tool ? empiricalValue(context) : 0;
  const double difference = dimension.actual - dimension.set - empirical;
  for (const int element : {0, 1 + axis})
    context.result(element, dimension.set);
  const Compared compared = feature == TurnedFeature::Face
                                ? comparedSurface(context, task, dimension.set, dimension.actual, direction)
                                : comparedSize(context, task, dimension.set, dimension.actual,
                                               feature == TurnedFeature::Inside ? Side::Inside : Side::Outside);
  context.result(4, dimension.actual, compared);
  context.result(5 + axis, dimension.actual, {.nominal = dimension.set});
  for (const int element : {16, 17 + axis})
    context.result(element, difference);
  context.noteCall();
  context.checkSafeArea(difference);
  if (task != Task::Tool) return;

  // A cutter that turned the part too large ends further out than its length says, by the difference on the radius.
  ToolInfluence influence = influenceOnSurface(axis == 2 ? 1 : axis, direction);
  if (feature != TurnedFeature::Face) influence.radius = feature == TurnedFeature::Inside ? 1 : -1;
  influence.radiusFromAxis = true;
  influence.radius /= dimension.count;
  influence.length /= dimension.count;
  // In the counter-spindle the workpiece system is mirrored, the tool is not.
  if (context.prober().mirrored(axis == 2 ? 1 : axis)) influence.length = -influence.length;
  const Dimension dimensions[] = {{.set = dimension.set, .actual = dimension.actual}};
  correctTool(context, dimensions, influence);
}

}  // namespace probewright::cycles::sinumerik
