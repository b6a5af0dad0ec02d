#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "control/alarm.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/probe_words.hpp"
#include "cycles/heidenhain/registry.hpp"
#include "execution/klartext/host.hpp"

/// Touch probe cycles run; cycle 12 calls its program; all other machining cycles are named as skipped.
namespace probewright::language::klartext {

using control::Alarm;
using control::Feed;

namespace {

/// Cycles of CYCL DEF that act where they stand; all others wait for CYCL CALL, M99 or M89.
constexpr std::array actingAtOnce = {14, 20, 220, 221, 224, 225, 238, 239, 270, 291, 292, 800, 801, 880, 892};

/// Cycles of the machine tool builder: only he knows when and how they act.
bool isOfBuilder(int number) { return (number >= 300 && number < 400) || (number >= 500 && number < 600); }

}  // namespace

void KlartextHost::cycle(const CycleCall& call, Evaluation& evaluation) {
  if (evaluation.at(call.name) == "TCH PROBE") {
    measure(call, evaluation);
    return;
  }
  if (std::ranges::find(actingAtOnce, call.number) != actingAtOnce.end()) {
    skip(call.number);
    return;
  }
  if (isOfBuilder(call.number)) skip(call.number);
  defineCycle(call.number);
}

/// A new cycle ends M89.
void KlartextHost::defineCycle(int number) {
  machiningCycle_ = number;
  cycleAtEachMove_ = false;
}

/// CYCL CALL, CYCL CALL POS at a position, and M99, which ends M89.
void KlartextHost::callCycle(const Command& command, Evaluation& evaluation) {
  cycleAtEachMove_ = false;
  if (evaluation.at(command.text) == "PAT" && machiningCycle_ == 12) {
    callAtPattern();
    return;
  }
  if (evaluation.at(command.text) == "POS") moveToCallPosition(command, evaluation);
  callMachiningCycle();
}

/// In the plane at the greater of the two heights; cycles that are skipped stay above.
void KlartextHost::moveToCallPosition(const Command& command, Evaluation& evaluation) {
  Move way;
  way.words = command.words;
  const Word* feedWord = find(command.words, "F", evaluation);
  const Feed feed = feedWord == nullptr ? Feed::rapidTraverse() : checkedFeed(length(feedWord->value, evaluation));
  const control::WorkingPlane& plane = control_.coordinates.plane;
  const Vector3 from = plane.planeFromXyz(control_.channel.position());
  const Vector3 to = plane.planeFromXyz(pointOf(way, evaluation, control_.channel.position()));
  const double above = std::max(from.z(), to.z());
  control_.channel.moveTo(plane.xyzFromPlane({from.x(), from.y(), above}), feed);
  control_.channel.moveTo(plane.xyzFromPlane({to.x(), to.y(), above}), feed);
  if (machiningCycle_ == 12) control_.channel.moveTo(plane.xyzFromPlane(to), feed);
}

void KlartextHost::measure(const CycleCall& call, Evaluation& evaluation) {
  const cycles::heidenhain::Entry* entry = cycles::heidenhain::findEntry(call.number);
  if (entry == nullptr && isOfBuilder(call.number)) {
    leaveOut(fmt::format("Touch probe cycle {}, which is of the machine tool builder,", call.number));
    return;
  }
  if (entry == nullptr) {
    throw Alarm("Cycle not available", fmt::format("Touch probe cycle {} is not available", call.number),
                "list the available cycles with: probewright cycles");
  }
  cycles::Arguments arguments(entry->definition);
  for (const Word& word : evaluation.words(call.parameters)) {
    const cycles::Parameter* parameter = entry->definition.parameter(word.address);
    if (parameter == nullptr) {
      const bool named = word.address < cycles::heidenhain::probe_word::result;
      throw Alarm("Cycle parameter wrong",
                  named ? fmt::format("Cycle {} has no parameter Q{}", call.number, word.address)
                        : fmt::format("Cycle {} does not take one of its words", call.number),
                  "take the parameter out of the cycle");
    }
    // MB MAX: as far as the parameter goes.
    Value value = word.value.present() ? evaluation.value(word.value) : Value(parameter->maximum);
    if (isText(value) && parameter->kind == cycles::ValueKind::Feed) {
      const std::string& text = std::get<std::string>(value);
      value = text == "FMAX" ? parameter->maximum : control_.tool.feed / control_.unit;
    }
    constexpr std::uint32_t coordinate = cycles::heidenhain::probe_word::coordinate;
    if (word.mode == WordMode::Incremental && call.number <= 1 && word.address < coordinate + 3 && !isText(value)) {
      const auto axis = static_cast<Eigen::Index>(word.address - coordinate);
      value = std::get<double>(value) + control_.channel.position()[axis] / control_.unit;
    }
    if (isText(value)) {
      arguments.set(word.address, std::get<std::string>(value));
    } else {
      arguments.set(word.address, std::get<double>(value));
    }
  }
  lastProbeCycle_ = call.number;
  // Cycles place the tip, whatever FUNCTION TCPM says.
  const ReferencePoint point = std::exchange(referencePoint_, ReferencePoint::TipTip);
  placeControlledPoint();
  cycles::heidenhain::runCycle(control_, *entry, arguments, evaluation.place());
  referencePoint_ = point;
  placeControlledPoint();
  control_.applyCoordinates();
}

void KlartextHost::callMachiningCycle() {
  if (!machiningCycle_) {
    throw Alarm("Cycle not defined", "CYCL CALL, M99 or M89 finds no cycle defined",
                "program CYCL DEF with the cycle before it");
  }
  if (machiningCycle_ == 12) {
    requestedProgram_ = cycleProgram_;
    return;
  }
  skip(*machiningCycle_);
}

void KlartextHost::skip(int number) {
  if (options_.strict) {
    throw Alarm("Cycle not available", fmt::format("Cycle {} is not simulated", number),
                "run without --strict to skip machining cycles");
  }
  leaveOut(fmt::format("Cycle {}", number));
}

}  // namespace probewright::language::klartext
