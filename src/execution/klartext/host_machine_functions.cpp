#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/alarm.hpp"
#include "execution/klartext/host.hpp"
#include "execution/klartext/m_functions.hpp"

/// M functions; m_functions.hpp tells which of them are carried out.
namespace probewright::language::klartext {

using control::Alarm;
using control::Feed;
using machine::Rotation;

void KlartextHost::machineFunction(const MachineFunction& function, Evaluation& evaluation) {
  switch (function.number) {
    case 3:
    case 13:
    case 4:
    case 14:
      spindleHasRun_ = true;
      clockwise_ = function.number == 3 || function.number == 13;
      control_.channel.turnSpindle(clockwise_ ? Rotation::Clockwise : Rotation::CounterClockwise,
                                   control_.tool.spindleSpeed);
      control_.q.setQ(110, spindleState());
      if (function.number > 10) coolant(8);
      break;
    case 5:
    case 6:
      control_.channel.turnSpindle(Rotation::None, 0);
      control_.q.setQ(110, spindleState());
      break;
    case 7:
      control_.channel.function(7);
      break;
    case 8:
    case 9:
      coolant(function.number);
      break;
    case 89:
      contour_.flush();
      cycleAtEachMove_ = true;
      callMachiningCycle();
      break;
    case 94:
      settle();
      takeTurns(function, evaluation);
      break;
    case 126:
    case 127:
      shortestPath_ = function.number == 126;
      break;
    case 114:
    case 115:
      if (control_.isTNC640()) {
        nameMachineFunction(function.number);
        break;
      }
      [[fallthrough]];
    case 128:
    case 129:
      settle();
      setHoldTip(function.number == 114 || function.number == 128);
      break;
    case 130:
      settle();
      untiltedPositions_ = true;
      break;
    case 136:
    case 137:
      feedPerRevolution_ = function.number == 136;
      break;
    case 140:
      settle();
      retractAlongTool(function, evaluation);
      break;
    case 141:
      settle();
      ignoreProbe_ = true;
      break;
    case 143:
      settle();
      deleteBasicRotation();
      break;
    case 144:
    case 145:
      settle();
      control_.coordinates.tiltedAxesInPosition = function.number == 144;
      control_.applyCoordinates();
      break;
    default:
      nameMachineFunction(function.number);
      break;
  }
}

void KlartextHost::coolant(int number) {
  control_.q.setQ(111, number == 8 ? 1 : 0);
  control_.channel.function(number);
}

/// The end of the main program stops spindle and coolant.
void KlartextHost::standDown() {
  if (control_.channel.spindleRotation() != Rotation::None) control_.channel.turnSpindle(Rotation::None, 0);
  if (control_.q.q(111) == 1) control_.channel.function(9);
}

/// True if the machine has carried out the function.
bool KlartextHost::handToMachine(int number) {
  if (!control_.channel.machine().hasFunction(number)) return false;
  contour_.flush();
  return control_.channel.function(number);
}

/// Functions that the control does not carry out itself: the machine may have those that are not the control's own.
void KlartextHost::nameMachineFunction(int number) {
  switch (effectOf(number, control_.kind())) {
    case FunctionEffect::CarriedOut:
    case FunctionEffect::Harmless:
      break;
    case FunctionEffect::NotCarriedOut:
      leaveOut(fmt::format("M{}", number));
      break;
    case FunctionEffect::OfBuilder:
      if (handToMachine(number)) break;
      leaveOut(fmt::format("M{}, which is a function of the machine tool builder,", number));
      break;
    case FunctionEffect::OfOtherOne:
      if (handToMachine(number)) break;
      leaveOut(fmt::format("M{}, which the {} does not have,", number, control::name(control_.kind())));
      break;
  }
}

/// M140 MB: back along the tool axis.
void KlartextHost::retractAlongTool(const MachineFunction& function, Evaluation& evaluation) {
  std::optional<double> distance;
  if (const Word* back = find(function.words, "MB", evaluation); back != nullptr && back->value.present()) {
    distance = length(back->value, evaluation);
    if (!(*distance >= 0)) {
      throw Alarm("Retraction not permitted", "M140 MB retracts along the tool axis: its distance cannot be negative",
                  "program a distance of 0 or more, or MB MAX");
    }
  }
  Feed feed = Feed::rapidTraverse();
  if (function.argument.present()) feed = checkedFeed(length(function.argument, evaluation));
  retract(distance, feed);
}

/// M94: the readings of all rotary axes, or of those that it names, lose their whole turns.
void KlartextHost::takeTurns(const MachineFunction& function, Evaluation& evaluation) {
  control::Channel& channel = control_.channel;
  const auto& axes = channel.description().axes;
  const auto take = [&](std::size_t axis) {
    if (axes[axis].kind != machine::AxisKind::Rotary) return;
    const double reading = channel.axes()[axis] - channel.rotaryOffset[axis];
    control_.coordinates.turnsTaken[axis] += 360 * std::floor(reading / 360 + 1e-9);
  };
  for (const Word& word : evaluation.words(function.words))
    take(axisOf(static_cast<char>(word.address)));
  for (std::size_t i = 0; function.words.count == 0 && i < axes.size(); ++i)
    take(i);
  control_.applyCoordinates();
}

/// M143: the basic rotation ends. The TNC 640 also clears it in the active row of the preset table.
void KlartextHost::deleteBasicRotation() {
  if (control_.isTNC640()) {
    control::heidenhain::Control::PresetChange change;
    for (int i = 0; i < 3; ++i) {
      if (control_.coordinates.preset.spaceAngles[i] != 0) change.spaceAngles[static_cast<std::size_t>(i)] = 0;
    }
    control_.writePreset(control_.coordinates.preset.row, change);
    return;
  }
  control_.coordinates.preset.spaceAngles.setZero();
  control_.applyCoordinates();
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
