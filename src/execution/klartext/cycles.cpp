#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "control/alarm.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/probe_words.hpp"
#include "cycles/heidenhain/registry.hpp"
#include "execution/klartext/cycles.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/cycle_writer.hpp"

/// Patterns of points are in cycle_patterns.cpp.
namespace probewright::execution::klartext {

using control::Alarm;
using control::Feed;

namespace {

/// Cycles of CYCL DEF that act where they stand; all others wait for CYCL CALL, M99 or M89.
constexpr std::array actingAtOnce = {14,  20,  220,  221,  224,  225,  238,  239,  270,  291,  292,  800,  801,
                                     880, 892, 1000, 1001, 1002, 1010, 1015, 1016, 1017, 1018, 1030, 1032, 1033};

/// Cycles of the machine tool builder: only he knows when and how they act.
bool isOfBuilder(int number) { return (number >= 300 && number < 400) || (number >= 500 && number < 600); }

}  // namespace

void Cycles::carryOut(const CycleCall& call, Evaluation& evaluation) {
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
void Cycles::defineCycle(int number) {
  machiningCycle_ = number;
  cycleAtEachMove_ = false;
}

void Cycles::defineProgramCycle(std::string program) {
  defineCycle(12);
  run_.cycleProgram = std::move(program);
}

void Cycles::callAtEachMove() {
  cycleAtEachMove_ = true;
  callMachiningCycle();
}

void Cycles::afterMove(const Move& move, Evaluation& evaluation) {
  if (!cycleAtEachMove_ || !Motion::travels(move, evaluation)) return;
  // M99 in the block: the call comes after the move by itself.
  const Block& block = evaluation.block();
  const bool callsByItself = std::ranges::any_of(block.instructions, [&](const Instruction& each) {
    const auto* command = std::get_if<Command>(&each);
    return command != nullptr && kindOf(block, *command) == CommandKind::CycleCall;
  });
  if (callsByItself) return;
  motion_.flush();
  callMachiningCycle();
}

void Cycles::callCycle(const Command& command, Evaluation& evaluation) {
  cycleAtEachMove_ = false;
  if (evaluation.at(command.text) == "PAT" && machiningCycle_ == 12) {
    callAtPattern();
    return;
  }
  if (evaluation.at(command.text) == "POS") moveToCallPosition(command, evaluation);
  callMachiningCycle();
}

/// In the plane at the greater of the two heights; cycles that are skipped stay above.
void Cycles::moveToCallPosition(const Command& command, Evaluation& evaluation) {
  const Word* feedWord = find(command.words, "F", evaluation);
  const Feed feed = feedWord == nullptr ? Feed::rapidTraverse() : checkedFeed(run_.feed(feedWord->value, evaluation));
  const control::WorkingPlane& plane = control_.coordinates.plane;
  const PlanePlace from = plane.planeFromXyz(control_.channel.position());
  const PlanePlace to = plane.planeFromXyz(motion_.pointOf(command.words, evaluation, control_.channel.position()));
  const double above = std::max(from.z(), to.z());
  control_.channel.moveTo(plane.xyzFromPlane(PlanePlace(from.x(), from.y(), above)), feed);
  control_.channel.moveTo(plane.xyzFromPlane(PlanePlace(to.x(), to.y(), above)), feed);
  if (machiningCycle_ == 12) control_.channel.moveTo(plane.xyzFromPlane(to), feed);
}

namespace {

/// Alarm if the parameter cannot be this text.
void refuseText(const cycles::Parameter& parameter, std::string_view text, control::ControlKind kind) {
  cycles::Argument argument;
  argument.isText = true;
  argument.text = text;
  std::string why = cycles::complaint(parameter, argument, kind);
  if (!why.empty()) throw Alarm("Cycle parameter wrong", std::move(why), "correct the value");
}

}  // namespace

void Cycles::measure(const CycleCall& call, Evaluation& evaluation) {
  const cycles::heidenhain::Entry* entry = cycles::heidenhain::findEntry(call.number);
  if (entry == nullptr && isOfBuilder(call.number)) {
    run_.leaveOut(fmt::format("Touch probe cycle {}, which is of the machine tool builder,", call.number));
    return;
  }
  if (entry == nullptr) {
    throw Alarm("Cycle not available", fmt::format("Touch probe cycle {} is not available", call.number),
                "list the available cycles with: probewright cycles");
  }
  if (run_.scans) {
    if (run_.firstTime("skipped touch probe cycles"))
      run_.message("Touch probe cycles before the start block are skipped; their results have no values");
    return;
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
    if (const std::string_view perTurn = language::klartext::feedPerTurn(evaluation.block(), word); !perTurn.empty())
      refuseText(*parameter, perTurn, control_.kind());
    // MB MAX: as far as the parameter goes.
    Value value = word.value.present() ? evaluation.value(word.value) : Value(parameter->maximum);
    if (isText(value) && parameter->kind == cycles::ValueKind::Feed) {
      const std::string& text = std::get<std::string>(value);
      refuseText(*parameter, text, control_.kind());
      value = text == "FMAX" ? parameter->maximum : control_.tool.feed / control_.feedUnit();
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
  guidance_.withTip([&] { cycles::heidenhain::runCycle(control_, *entry, arguments, evaluation.place()); });
  control_.applyCoordinates();
}

void Cycles::callMachiningCycle() {
  if (!machiningCycle_) {
    throw Alarm("Cycle not defined", "CYCL CALL, M99 or M89 finds no cycle defined",
                "program CYCL DEF with the cycle before it");
  }
  if (machiningCycle_ == 12) {
    requestedProgram_ = run_.cycleProgram;
    return;
  }
  skip(*machiningCycle_);
}

void Cycles::skip(int number) {
  if (run_.options.strict) {
    throw Alarm("Cycle not available", fmt::format("Cycle {} is not simulated", number),
                "run without --strict to skip machining cycles");
  }
  run_.leaveOut(fmt::format("Cycle {}", number));
}

}  // namespace probewright::execution::klartext
