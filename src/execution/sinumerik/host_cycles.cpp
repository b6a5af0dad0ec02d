#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "control/alarm.hpp"
#include "control/sinumerik/text.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/old_form.hpp"
#include "cycles/sinumerik/registry.hpp"
#include "execution/sinumerik/functions.hpp"
#include "execution/sinumerik/host.hpp"
#include "execution/sinumerik/swivel.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/cursor.hpp"
#include "language/word_column.hpp"

/// Calls of cycles: what their arguments are and where they go.
namespace probewright::execution::sinumerik {

using control::Alarm;

namespace {

/// The parameters that an alarm speaks of, by their place in the call and their meaning.
std::string namedArguments(const cycles::CycleDefinition& definition, const Alarm& alarm) {
  const std::string said = alarm.text() + ' ' + alarm.advice() + ' ';
  std::string named;
  for (const cycles::Parameter& parameter : definition.parameters) {
    const auto isWhole = [&](std::size_t at) { return !isNamePart(said[at + parameter.name.size()]); };
    std::size_t at = said.find(parameter.name);
    while (at != std::string::npos && !isWhole(at))
      at = said.find(parameter.name, at + 1);
    if (at == std::string::npos) continue;
    named += fmt::format("; {} is argument {} of {}: {}", parameter.name, parameter.address + 1, definition.name,
                         parameter.meaning);
  }
  return named;
}

/// The alarm of a call in the old form, with the variables that its program writes: _FA for S_FA.
Alarm inOldForm(const cycles::CycleDefinition& definition, const Alarm& alarm) {
  const auto translated = [&](std::string text) {
    for (const cycles::Parameter& parameter : definition.parameters) {
      const std::string name(parameter.name);
      if (!name.starts_with("S_")) continue;
      const std::string old = name == "S_SETV" ? "_SETVAL" : name == "S_KNUM1" ? "_KNUM" : name.substr(1);
      for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + old.size())) {
        const char next = at + name.size() < text.size() ? text[at + name.size()] : ' ';
        if (!isNamePart(next)) text.replace(at, name.size(), old);
      }
    }
    return text;
  };
  return Alarm(alarm.code(), translated(alarm.text()), translated(alarm.advice()));
}

}  // namespace

/// The interpreter found no program of this name.
void SinumerikHost::carryOut(const CallProgram& call, Evaluation& evaluation) {
  motion_.flush();
  const std::string name =
      upperCase(call.nameValue.present() ? evaluation.text(call.nameValue) : std::string(evaluation.at(call.name)));
  runCycle(name, call.arguments, evaluation);
}

void SinumerikHost::runCycle(std::string_view name, WordRange range, Evaluation& evaluation) {
  if (name == "CYCLE800") return runSwivel(range, evaluation);
  if (name == "CYCLE116") return runCircle(range, evaluation);
  const cycles::sinumerik::Entry* entry = cycles::sinumerik::findEntry(name);
  if (entry == nullptr) {
    if (isMeasuringCycle(name))
      throw Alarm("14011", fmt::format("the measuring cycle {} is not available", name),
                  "'probewright cycles --control 840Dsl' lists the cycles that are");
    if (isCycleWithoutEffect(name)) return;
    if (isSkippedCycle(name)) return skip(name);
    throw Alarm("14011", fmt::format("there is no program and no cycle {}", name),
                fmt::format("put {}.SPF beside the program, or check the spelling", name));
  }
  const cycles::CycleDefinition& definition = entry->definition;
  cycles::Arguments arguments(definition);
  for (const Word& word : evaluation.words(range)) {
    if (!word.value.present()) continue;
    const cycles::Parameter* parameter = definition.parameter(word.address);
    const Value value = evaluation.value(word.value);
    if (parameter == nullptr) {
      // Newer versions of the cycles have more; what is empty or 0 asks for nothing.
      if (value == Value(0.0) || value == Value(std::string())) continue;
      throw Alarm("14020",
                  fmt::format("{} takes at most {} arguments: more belong to a version of the measuring cycles newer "
                              "than 4.4",
                              name, definition.parameters.size()),
                  fmt::format("leave out the arguments that newer versions added; see 'probewright cycles {}'", name));
    }
    if (const auto* text = std::get_if<std::string>(&value)) {
      arguments.set(word.address, *text);
    } else {
      arguments.set(word.address, std::get<double>(value));
    }
  }
  std::optional<cycles::sinumerik::OldFeed> feed;
  bool oldForm = false;
  if (range.count == 0 && cycles::sinumerik::hasOldForm(definition) &&
      cycles::sinumerik::hasOldParameters(control_.data)) {
    oldForm = true;
    arguments = cycles::sinumerik::argumentsOfOldForm(definition, control_);
    entry = cycles::sinumerik::findEntry(arguments.definition().name);
    const bool ownFeed =
        std::ranges::find(definition.parameters, "S_VMS", &cycles::Parameter::name) != definition.parameters.end();
    if (!ownFeed) feed.emplace(control_);
  }
  const bool measures = entry->run != nullptr;
  if (measures) callMachineBuilder(definition.number, Occasion::BeforeMeasuring);
  SourcePlace place = evaluation.place();
  place.column = language::columnOf(name, evaluation.at(evaluation.block().source));
  try {
    cycles::sinumerik::runCycle(control_, *entry, arguments, place,
                                [&] { callMachineBuilder(definition.number, Occasion::SpindlePositioned); });
  } catch (const Alarm& alarm) {
    if (oldForm) throw inOldForm(arguments.definition(), alarm);
    const std::string named = namedArguments(definition, alarm);
    if (named.empty()) throw;
    throw Alarm(alarm.code(), alarm.text(), alarm.advice() + named);
  }
  if (measures) callMachineBuilder(definition.number, Occasion::AfterMeasuring);
}

/// CUST_MEACYC, the machine builder's program around every measuring cycle. It is told the cycle's number by _OVI[2]
/// and by its first parameter, the occasion by its second, if these are INT. A program without the second cannot tell
/// the calls apart and is called as the manual says, before the cycle; after the spindle's positioning where bit
/// 6 of SD 55740 asks for it.
void SinumerikHost::callMachineBuilder(int cycle, Occasion occasion) {
  // A cycle that CUST_MEACYC itself calls measures without it: it would call itself for ever.
  if (!options_.callProgram || levels_.empty() || notice_) return;
  if (control_.dryRun || control_.programTest || control_.blockSearch) return;
  if (occasion == Occasion::AfterMeasuring && !builderTellsOccasions_) return;
  control_.ovi[2] = cycle;
  builderTellsOccasions_ = false;
  notice_ = MeasuringNotice{cycle, occasion};
  callAside("CUST_MEACYC");
  notice_.reset();
}

void SinumerikHost::runSwivel(WordRange range, Evaluation& evaluation) {
  SwivelCall call;
  const auto words = evaluation.words(range);
  if (words.empty()) return deselectSwivel(control_);
  for (const Word& word : words) {
    if (!word.value.present()) continue;
    if (word.address == 1) {
      const Value value = evaluation.value(word.value);
      call.dataSet = language::isText(value) ? std::get<std::string>(value) : "";
      continue;
    }
    const double value = evaluation.number(word.value);
    const double length = value * control_.unit;
    switch (word.address) {
      case 0:
        call.retract = wholeNumber(value);
        break;
      case 2:
        call.state = wholeNumber(value);
        break;
      case 3:
        call.mode = wholeNumber(value);
        break;
      case 4:
      case 5:
      case 6:
        call.reference[word.address - 4] = length;
        break;
      case 7:
      case 8:
      case 9:
        call.angles[word.address - 7] = value;
        break;
      case 10:
      case 11:
      case 12:
        call.shift[word.address - 10] = length;
        break;
      case 13:
        call.direction = wholeNumber(value);
        break;
      case 14:
        call.retraction = length;
        break;
      default:
        break;
    }
  }
  swivel(control_, call);
}

}  // namespace probewright::execution::sinumerik
