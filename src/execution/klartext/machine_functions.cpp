#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/alarm.hpp"
#include "execution/klartext/machine_functions.hpp"
#include "language/klartext/m_functions.hpp"

namespace probewright::execution::klartext {

using control::Alarm;
using control::Feed;
using language::klartext::effectOf;
using language::klartext::FunctionEffect;
using machine::Rotation;

void MachineFunctions::carryOut(const MachineFunction& function, Evaluation& evaluation) {
  switch (function.number) {
    case 3:
    case 13:
    case 4:
    case 14:
      spindle_.turn(function.number == 3 || function.number == 13 ? Rotation::Clockwise : Rotation::CounterClockwise);
      if (function.number > 10) spindle_.coolant(8);
      break;
    case 5:
    case 6:
      spindle_.stop();
      break;
    case 7:
      control_.channel.function(7);
      break;
    case 8:
    case 9:
      spindle_.coolant(function.number);
      break;
    case 19:
    case 20:
      // A builder may have given the number another meaning.
      if (handToMachine(function.number)) break;
      motion_.flush();
      spindle_.orient();
      break;
    case 89:
      motion_.flush();
      cycles_.callAtEachMove();
      break;
    case 94:
      motion_.settle();
      takeTurns(function, evaluation);
      break;
    case 126:
    case 127:
      motion_.modes.shortestPath = function.number == 126;
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
      motion_.settle();
      guidance_.setHoldTip(function.number == 114 || function.number == 128);
      break;
    case 130:
      motion_.settle();
      motion_.modes.untiltedPositions = true;
      break;
    case 136:
    case 137:
      motion_.modes.feedPerRevolution = function.number == 136;
      break;
    case 140:
      motion_.settle();
      retractAlongTool(function, evaluation);
      break;
    case 141:
      motion_.settle();
      motion_.modes.ignoreProbe = true;
      break;
    case 143:
      motion_.settle();
      deleteBasicRotation();
      break;
    case 144:
    case 145:
      motion_.settle();
      control_.coordinates.tiltedAxesInPosition = function.number == 144;
      control_.applyCoordinates();
      break;
    default:
      nameMachineFunction(function.number);
      break;
  }
}

/// True if the machine has carried out the function.
bool MachineFunctions::handToMachine(int number) {
  if (!control_.channel.machine().hasFunction(number)) return false;
  motion_.flush();
  return control_.channel.function(number);
}

/// Functions that the control does not carry out itself: the machine may have those that are not the control's own.
void MachineFunctions::nameMachineFunction(int number) {
  switch (effectOf(number, control_.kind())) {
    case FunctionEffect::CarriedOut:
    case FunctionEffect::Harmless:
      break;
    case FunctionEffect::NotCarriedOut:
      run_.leaveOut(fmt::format("M{}", number));
      break;
    case FunctionEffect::OfBuilder:
      if (handToMachine(number)) break;
      run_.leaveOut(fmt::format("M{}, which is a function of the machine tool builder,", number));
      break;
    case FunctionEffect::OfOtherOne:
      if (handToMachine(number)) break;
      run_.leaveOut(fmt::format("M{}, which the {} does not have,", number, control::name(control_.kind())));
      break;
  }
}

/// M140 MB: back along the tool axis.
void MachineFunctions::retractAlongTool(const MachineFunction& function, Evaluation& evaluation) {
  std::optional<double> distance;
  if (const Word* back = find(function.words, "MB", evaluation); back != nullptr && back->value.present()) {
    distance = run_.length(back->value, evaluation);
    if (!(*distance >= 0)) {
      throw Alarm("Retraction not permitted", "M140 MB retracts along the tool axis: its distance cannot be negative",
                  "program a distance of 0 or more, or MB MAX");
    }
  }
  Feed feed = Feed::rapidTraverse();
  if (function.argument.present()) feed = checkedFeed(run_.feed(function.argument, evaluation));
  motion_.retract(distance, feed);
}

/// M94: the readings of all rotary axes, or of those that it names, lose their whole turns.
void MachineFunctions::takeTurns(const MachineFunction& function, Evaluation& evaluation) {
  control::Channel& channel = control_.channel;
  const auto& axes = channel.description().axes;
  const auto take = [&](std::size_t axis) {
    if (axes[axis].kind != machine::AxisKind::Rotary) return;
    const double reading = channel.axes()[axis] - channel.rotaryOffset[axis];
    control_.coordinates.turnsTaken[axis] += 360 * std::floor(reading / 360 + 1e-9);
  };
  for (const Word& word : evaluation.words(function.words))
    take(run_.axisOf(static_cast<char>(word.address)));
  for (std::size_t i = 0; function.words.count == 0 && i < axes.size(); ++i)
    take(i);
  control_.applyCoordinates();
}

/// M143: the basic rotation ends. The TNC 640 also clears it in the active row of the preset table.
void MachineFunctions::deleteBasicRotation() {
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

}  // namespace probewright::execution::klartext
