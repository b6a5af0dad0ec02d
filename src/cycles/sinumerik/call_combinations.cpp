#include "cycles/sinumerik/call_combinations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "cycles/sinumerik/registry.hpp"

namespace probewright::cycles::sinumerik {

namespace {

void toolCorrection(CallCombinations& call) {
  const auto target = call.number("S_KNUM1");
  if (!target || *target == 0) return;
  const auto upper = call.number("S_TUL"), lower = call.number("S_TLL");
  if (call.asymmetric() && upper && lower && *upper < *lower) {
    call.refuse("S_TUL",
                fmt::format("S_TUL = {} is smaller than S_TLL = {}", formatShortest(*upper), formatShortest(*lower)));
  }
  const auto memories = call.number("S_EVNUM"), weight = call.number("S_K");
  if (memories && *memories >= 10000 && weight && *weight <= 0) {
    call.refuse("S_K", fmt::format("S_K = {}: the weighting factor of mean value {} must be greater than 0",
                                   formatShortest(*weight), truncated<long>(*memories) / 10000));
  }
  const KnownArgument name = call.argument("S_TNAME");
  const bool empty = !name.given || (name.text && name.text->empty());
  // Long D numbers belong to one tool alone.
  if (empty && *target < 1000) {
    call.warn("S_TNAME", "S_TNAME names no tool to correct, which only machines with unique D numbers can do with");
  }
}

}  // namespace

bool CallCombinations::has(std::string_view name) const {
  return std::ranges::find(cycle_.parameters, name, &Parameter::name) != cycle_.parameters.end();
}

bool CallCombinations::asymmetric() const {
  const auto mode = number("_AMODE");
  return mode && variant::digit(truncated(std::abs(*mode)), 1) == 1;
}

void CallCombinations::refuse(std::string_view parameter, std::string text) {
  found_.push_back({parameter, {.text = std::move(text), .refused = true}});
}

void CallCombinations::warn(std::string_view parameter, std::string text) {
  found_.push_back({parameter, {.text = std::move(text), .refused = false}});
}

std::vector<CombinationComplaint> combinationComplaints(
    const CycleDefinition& cycle, int variant, const std::function<KnownArgument(std::string_view)>& argument) {
  CallCombinations call(cycle, variant, argument);
  if (call.digit(3) == 2 && call.has("S_KNUM1")) toolCorrection(call);
  const Entry* entry = findEntry(cycle.name);
  if (entry != nullptr && entry->combinations != nullptr) entry->combinations(call);
  return call.take();
}

}  // namespace probewright::cycles::sinumerik
