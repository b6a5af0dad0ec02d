#include <algorithm>
#include <cmath>

#include "control/alarm.hpp"
#include "control/scoped.hpp"
#include "execution/klartext/tool_guidance.hpp"
#include "machine/rotary_solver.hpp"

namespace probewright::execution::klartext {

using control::Alarm;

namespace {

double centreAboveTip(const control::heidenhain::ActiveTool& tool) { return tool.radius2 + tool.deltaRadius2; }

/// The tool vector of a point that lies `distance` above the tip.
Vector3 shortened(const control::heidenhain::Control& control, double distance) {
  Vector3 vector = control.channel.toolVector;
  vector[control.coordinates.plane.tool] -= distance;
  return vector;
}

}  // namespace

void ToolGuidance::switchBy(const Modal& modal, Evaluation& evaluation) {
  const bool on = evaluation.at(modal.name) == "FUNCTION TCPM";
  setHoldTip(on);
  if (!on) return;
  if (const Word* path = find(modal.words, "PATH", evaluation); path != nullptr && path->value.number == 0) {
    run_.leaveOut("PATHCTRL VECTOR, which guides the tool direction between the ends of a block,");
  }
  const Word* axis = find(modal.words, "AXIS", evaluation);
  const Word* point = find(modal.words, "REFP", evaluation);
  spaceAngles_ = axis != nullptr && axis->value.number == 0;
  toolAngles_.setZero();
  if (point != nullptr) referencePoint_ = static_cast<ReferencePoint>(std::lround(point->value.number));
  placeControlledPoint();
}

void ToolGuidance::placeControlledPoint() {
  const control::heidenhain::ActiveTool& tool = control_.tool;
  control_.channel.toolVector.setZero();
  control_.channel.toolVector[control_.coordinates.plane.tool] =
      tool.length + tool.deltaLength - (referencePoint_ == ReferencePoint::CentreCentre ? centreAboveTip(tool) : 0);
}

/// AXIS SPAT: A, B, C are space angles of the tool in the active coordinate system; those that the block leaves out
/// keep their value.
void ToolGuidance::turnToSpaceAngles(WordRange words, RotaryTarget& rotary, Evaluation& evaluation) {
  bool given = false;
  for (const Word& word : evaluation.words(words)) {
    if (word.address < 'A' || word.address > 'C') continue;
    double& angle = toolAngles_[static_cast<Eigen::Index>(word.address - 'A')];
    const double value = evaluation.number(word.value);
    angle = word.mode == WordMode::Incremental ? angle + value : value;
    given = true;
  }
  if (!given) return;
  Vector3 toolAxis = Vector3::Zero();
  toolAxis[control_.coordinates.plane.tool] = 1;
  turnTo(control::heidenhain::rotationFromSpaceAngles(toolAngles_) * toolAxis, rotary);
}

/// LN with TX, TY, TZ: where the tool points from its tip, while M128 or FUNCTION TCPM is on.
void ToolGuidance::turnToVector(WordRange words, RotaryTarget& rotary, Evaluation& evaluation) {
  Vector3 direction = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    const char name[2] = {'T', "XYZ"[i]};
    if (const Word* word = find(words, {name, 2}, evaluation)) direction[i] = evaluation.number(word->value);
  }
  if (direction.norm() < 1e-9) {
    throw Alarm("Tool direction wrong", "TX, TY and TZ of LN are all 0", "program the direction of the tool axis");
  }
  turnTo(direction, rotary);
}

/// The rotary axes go the shortest way to where the tool points in this direction of the active coordinate system.
void ToolGuidance::turnTo(const Vector3& inProgram, RotaryTarget& rotary) const {
  const control::Channel& channel = control_.channel;
  const machine::MachineDescription& description = channel.description();
  const machine::AxisPositions& reference = control_.coordinates.preset.rotaryOffset;
  const machine::AxisPositions now = channel.axes();
  Vector3 toolAxis = Vector3::Zero();
  toolAxis[control_.coordinates.plane.tool] = 1;
  const Vector3 direction = channel.machineFromProgram(ProgramWay(inProgram)).vector().normalized();
  std::vector<machine::AxisPositions> solutions =
      machine::solveRotaryAxes(description, direction, toolAxis, reference, now);
  if (solutions.empty()) {
    throw Alarm("Entered angle not permitted", "The rotary axes of the machine cannot point the tool in this direction",
                "choose other angles, or a machine whose rotary axes reach them");
  }
  const std::optional<std::size_t> free = machine::freeRotaryAxis(description, direction, reference);
  const auto distance = [&](machine::AxisPositions& solution) {
    double sum = 0;
    for (std::size_t i = 0; i < description.axes.size(); ++i) {
      if (description.axes[i].kind != machine::AxisKind::Rotary) continue;
      if (free == i) solution[i] = now[i];
      if (description.axes[i].modulo) solution[i] = now[i] + std::remainder(solution[i] - now[i], 360.0);
      sum += std::abs(solution[i] - now[i]);
    }
    return sum;
  };
  const machine::AxisPositions target =
      *std::ranges::min_element(solutions, {}, [&](machine::AxisPositions& solution) { return distance(solution); });
  for (std::size_t i = 0; i < description.axes.size(); ++i) {
    if (description.axes[i].kind == machine::AxisKind::Rotary) rotary[i] = target[i] - channel.rotaryOffset[i];
  }
}

/// A move with rotary axes. With TIP-CENTER the channel guides the centre: the target is that of the tip, and what it
/// leaves out keeps the centre's place.
void ToolGuidance::moveTurning(const control::Target& target, control::Feed feed) {
  control::Channel& channel = control_.channel;
  const machine::AxisPositions start = channel.axes();
  machine::AxisPositions end = start;
  for (std::size_t i = 0; i < channel.description().axes.size(); ++i) {
    if (target.rotary[i]) end[i] = *target.rotary[i] + channel.rotaryOffset[i];
  }
  if (referencePoint_ != ReferencePoint::TipCentre || end == start) {
    channel.moveTo(target, feed);
    return;
  }
  const ProgramPlace tipAtEnd = channel.programFromAxes(end);
  const control::Scoped guided(channel.toolVector, shortened(control_, centreAboveTip(control_.tool)));
  const ProgramWay tipToCentre = channel.programFromAxes(end) - tipAtEnd;
  const ProgramPlace centre = channel.position();
  control::Target ofCentre = target;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    ofCentre.linear[i] = target.linear[i] ? *target.linear[i] + tipToCentre[at] : centre[at];
  }
  channel.moveTo(ofCentre, feed);
}

void ToolGuidance::setHoldTip(bool hold) {
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

}  // namespace probewright::execution::klartext
