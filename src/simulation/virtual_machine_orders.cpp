#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/virtual_machine.hpp"

/// Spindle, M functions, tool changes and waiting: orders that are no moves.
namespace probewright::simulation {

using machine::AxisKind;
using machine::AxisPositions;
using machine::Feed;
using machine::FunctionEnd;
using machine::FunctionResult;
using machine::MoveEnd;
using machine::MoveResult;
using machine::Rotation;
using machine::ToolChangeEnd;
using machine::ToolChangeResult;
using machine::WaitEnd;

namespace {

constexpr double orientationSeconds = 1;

std::string missingTool(const machine::ToolOrder& order, const std::vector<TrueTool>& tools) {
  if (order.name.empty()) return fmt::format("the magazine of this machine holds no tool {}", order.number);
  const auto other = std::ranges::find(tools, order.number, &TrueTool::number);
  return fmt::format("the magazine of this machine holds no tool \"{}\"{}", order.name,
                     other == tools.end() ? "" : fmt::format("; its tool {} is \"{}\"", other->number, other->name));
}

}  // namespace

MoveResult VirtualMachine::turn(machine::SpindleState& spindle, Rotation rotation, double speed) {
  const bool turnsTool = &spindle == &carrying();
  if (rotation == Rotation::None) {
    spindle.rotation = rotation;
    spindle.speed = 0;
    if (turnsTool) spin_ = {spindleDegrees(), clock_, 0};
    return {};
  }
  if (stop_.stop_requested()) return {MoveEnd::Cancelled, stoppedText};
  if (!(speed >= 0 && std::isfinite(speed)))
    return {MoveEnd::Refused, fmt::format("a spindle speed of {} is not possible", speed)};
  spindle.rotation = rotation;
  spindle.speed = speed;
  // Clockwise as seen from the spindle nose is against the angles about the tool.
  if (turnsTool) spin_ = {spindleDegrees(), clock_, (rotation == Rotation::Clockwise ? -6.0 : 6.0) * speed};
  return {};
}

MoveResult VirtualMachine::orient(machine::SpindleState& spindle, double degrees) {
  if (stop_.stop_requested()) return {MoveEnd::Cancelled, stoppedText};
  if (!truth_.machine.spindleOrients) return {MoveEnd::Refused, "the spindle of this machine cannot be oriented"};
  if (!std::isfinite(degrees)) return {MoveEnd::Refused, "the target angle of the spindle is not a number"};
  continuous_.stop();
  clock_ += orientationSeconds;
  spindle = {Rotation::None, 0, degrees};
  if (&spindle != &carrying()) return {};
  spin_ = {degrees, clock_, 0};
  shape_ = shapeOf(tool_, degrees);
  if (const auto touch = overlap()) return {touch->shaft ? MoveEnd::Collision : MoveEnd::ProbeSignal, describe(*touch)};
  const auto hit = guard_ ? guard_->standing(slides_, clock_, shape_) : std::nullopt;
  return hit ? MoveResult{MoveEnd::Collision, describe(*hit)} : MoveResult{};
}

MoveResult VirtualMachine::turnSpindle(Rotation rotation, double speed) { return turn(spindle_, rotation, speed); }
MoveResult VirtualMachine::orientSpindle(double degrees) { return orient(spindle_, degrees); }
MoveResult VirtualMachine::turnTool(Rotation rotation, double speed) { return turn(driven_, rotation, speed); }
MoveResult VirtualMachine::orientTool(double degrees) { return orient(driven_, degrees); }

FunctionResult VirtualMachine::function(int number) {
  if (!hasFunction(number)) return {FunctionEnd::Unknown, fmt::format("this machine has no M{}", number)};
  if (stop_.stop_requested()) return {FunctionEnd::Cancelled, stoppedText};
  return {};
}

std::optional<const TrueTool*> VirtualMachine::findTool(const machine::ToolOrder& order) const {
  const auto& tools = truth_.tools;
  auto found = order.name.empty() ? tools.end() : std::ranges::find(tools, order.name, &TrueTool::name);
  if (found == tools.end()) {
    found = std::ranges::find_if(tools, [&](const TrueTool& tool) {
      return tool.number == order.number && (order.name.empty() || tool.name.empty());
    });
  }
  if (found != tools.end()) return &*found;
  if (order.number == 0 && order.name.empty()) return nullptr;
  return std::nullopt;
}

ToolChangeResult VirtualMachine::load(const TrueTool* tool) {
  tool_ = tool;
  shape_ = shapeOf(tool_, carrying().angle);
  edges_.reset();
  if (tool_ != nullptr && tool_->kind == ToolKind::Cutter) edges_.emplace(*tool_);
  if (recording_ != Recording::Nothing)
    path_.add(pathPoint(tableFromSpindle(), reading_, PathKind::ToolChange, clock_));
  if (const auto touch = overlap())
    return {touch->shaft ? ToolChangeEnd::Collision : ToolChangeEnd::ProbeSignal, describe(*touch)};
  const auto hit = guard_ ? guard_->standing(slides_, clock_, shape_) : std::nullopt;
  return hit ? ToolChangeResult{ToolChangeEnd::Collision, describe(*hit)} : ToolChangeResult{};
}

ToolChangeResult VirtualMachine::insertTool(const machine::ToolOrder& order) {
  const auto tool = findTool(order);
  if (!tool) return {ToolChangeEnd::Missing, missingTool(order, truth_.tools)};
  ToolChangeResult result = load(*tool);
  // What bodies of the machine touch here is left out until they have come apart.
  const bool byBody = result.end == ToolChangeEnd::Collision && !overlap();
  return byBody ? ToolChangeResult{} : result;
}

ToolChangeResult VirtualMachine::changeTool(const machine::ToolOrder& order) {
  if (stop_.stop_requested()) return {ToolChangeEnd::Cancelled, stoppedText};
  const auto tool = findTool(order);
  if (!tool) return {ToolChangeEnd::Missing, missingTool(order, truth_.tools)};
  if (*tool == tool_) return {};
  if (deflection_ || toolContact_) return {ToolChangeEnd::ProbeSignal, stillDeflected()};
  turn(carrying(), Rotation::None, 0);

  AxisPositions target = reading_;
  const auto& chain = truth_.machine.spindleChain;
  const auto& axes = truth_.machine.axes;
  const auto nearest = std::find_if(chain.rbegin(), chain.rend(), [&](const machine::ChainElement& element) {
    return element.axis && axes[*element.axis].kind == AxisKind::Linear;
  });
  if (nearest != chain.rend()) {
    target[*nearest->axis] = truth_.machine.toolChange[*nearest->axis];
    advance(motionTo(target, Feed::rapidTraverse()), Stop{}, PathKind::ToolChange);
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].kind == AxisKind::Linear) target[i] = truth_.machine.toolChange[i];
  }
  advance(motionTo(target, Feed::rapidTraverse()), Stop{}, PathKind::ToolChange);
  continuous_.stop();
  clock_ += truth_.machine.toolChangeSeconds;
  return load(*tool);
}

WaitEnd VirtualMachine::dwell(double seconds) {
  if (stop_.stop_requested()) return WaitEnd::Cancelled;
  continuous_.stop();
  clock_ += std::max(seconds, 0.0);
  return WaitEnd::Over;
}

}  // namespace probewright::simulation
