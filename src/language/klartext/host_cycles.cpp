#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "control/alarm.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/probe_words.hpp"
#include "cycles/heidenhain/registry.hpp"
#include "language/klartext/host.hpp"

/// Touch probe cycles run; machining cycles are named as skipped.
namespace probewright::language::klartext {

using control::Alarm;

namespace {

/// Cycles of CYCL DEF that act where they stand; all others wait for CYCL CALL, M99 or M89.
constexpr std::array<int, 12> actingAtOnce = {14, 20, 220, 221, 224, 225, 238, 239, 291, 292, 800, 880};

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
  machiningCycle_ = call.number;
}

void KlartextHost::measure(const CycleCall& call, Evaluation& evaluation) {
  const cycles::heidenhain::Entry* entry = cycles::heidenhain::findEntry(call.number);
  if (entry == nullptr) {
    throw Alarm("Cycle not available", fmt::format("Touch probe cycle {} is not available", call.number),
                "list the available cycles with: probewright cycles");
  }
  cycles::Arguments arguments(*entry->definition);
  for (const Word& word : evaluation.words(call.parameters)) {
    const cycles::Parameter* parameter = entry->definition->parameter(word.address);
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
  cycles::heidenhain::runCycle(control_, *entry, arguments, evaluation.place());
  control_.applyCoordinates();
}

void KlartextHost::callMachiningCycle() {
  if (!machiningCycle_) {
    throw Alarm("Cycle not defined", "CYCL CALL, M99 or M89 finds no cycle defined",
                "program CYCL DEF with the cycle before it");
  }
  skip(*machiningCycle_);
}

void KlartextHost::skip(int number) {
  if (options_.strict) {
    throw Alarm("Cycle not available", fmt::format("Cycle {} is not simulated", number),
                "run without --strict to skip machining cycles");
  }
  control_.panel.message(control::EventKind::Skipped, fmt::format("Cycle {} is not simulated and was skipped", number),
                         control_.channel.seconds());
}

}  // namespace probewright::language::klartext
