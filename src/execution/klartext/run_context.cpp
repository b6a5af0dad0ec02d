#include "execution/klartext/run_context.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "control/alarm.hpp"
#include "execution/klartext/excerpt.hpp"

namespace probewright::execution::klartext {

using control::Alarm;

void RunContext::message(std::string text) {
  control.panel.message(control::EventKind::Message, std::move(text), control.channel.seconds());
}

void RunContext::warn(std::string text) {
  control.panel.message(control::EventKind::Warning, std::move(text), control.channel.seconds());
}

void RunContext::leaveOut(const std::string& what) {
  if (options.strict) {
    throw Alarm("Function not available", fmt::format("{} is not simulated", what), "run without --strict to skip it");
  }
  if (!firstTime(what)) return;
  control.panel.message(control::EventKind::Skipped, fmt::format("{} is not simulated and was skipped", what),
                        control.channel.seconds());
}

std::size_t RunContext::axisOf(char letter) const {
  const auto axis = control.channel.description().axisIndex(std::string_view(&letter, 1));
  if (!axis) {
    throw Alarm("Axis not available", fmt::format("The machine has no axis {}", letter),
                "take the axis out of the block or choose a machine that has it");
  }
  return *axis;
}

Result<std::string> RunContext::readHostFile(std::string_view path) {
  std::string name(path);
  std::erase(name, '"');
  if (!options.readFile) return fail(fmt::format("the file {} does not exist", excerptOf(name)));
  const auto read = [&](const std::string& each) {
    Result<std::string> bytes = options.readFile(each);
    work += Host::stepsOfFile(bytes ? bytes->size() : 0);
    return bytes;
  };
  Result<std::string> bytes = read(name);
  if (!bytes && fileNameOf(name) != name) {
    Result<std::string> byName = read(fileNameOf(name));
    if (byName) return byName;
  }
  return bytes;
}

const Word* find(WordRange range, std::string_view address, Evaluation& evaluation) {
  for (const Word& word : evaluation.words(range)) {
    if (word.address == addressOf(address)) return &word;
  }
  return nullptr;
}

double numberOr(WordRange range, std::string_view address, double otherwise, Evaluation& evaluation) {
  const Word* word = find(range, address, evaluation);
  return word == nullptr ? otherwise : evaluation.number(word->value);
}

std::string fileNameOf(std::string_view path) {
  const std::size_t separator = path.find_last_of("/\\:");
  return std::string(separator == std::string_view::npos ? path : path.substr(separator + 1));
}

}  // namespace probewright::execution::klartext
