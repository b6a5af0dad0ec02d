#include "session/first_value.hpp"

#include <algorithm>
#include <span>

namespace probewright::session {

namespace {

/// Of parameters that several cycles share; a cycle's own examples come before these.
constexpr cycles::Example shared[] = {
    {"Q247", 90}, {"Q253", 750}, {"Q303", 1}, {"Q407", 12.5}, {"QS600", 0, "POINT"}, {"S_FA", 10}, {"S_TSA", 1},
};

}  // namespace

FirstValue firstValue(const cycles::CycleDefinition& cycle, const cycles::Parameter& parameter) {
  for (const std::span<const cycles::Example> examples : {cycle.examples, std::span<const cycles::Example>(shared)}) {
    const auto example = std::ranges::find(examples, parameter.name, &cycles::Example::parameter);
    if (example != examples.end()) return {example->number, std::string(example->text), true};
  }
  if (parameter.standard) return {*parameter.standard, {}};
  if (!parameter.choices.empty()) return {static_cast<double>(parameter.choices.front().value), {}};
  return {std::clamp(0.0, parameter.minimum, parameter.maximum), {}};
}

}  // namespace probewright::session
