#include "cycles/main_results.hpp"

#include <algorithm>

#include "cycles/catalogue.hpp"

namespace probewright::cycles {

namespace {

using control::CycleRecord;
using control::Rank;
using control::ResultRecord;

constexpr std::size_t mostOfUnknownCycle = 6;

}  // namespace

std::vector<bool> mainResults(const CycleRecord& cycle) {
  std::vector<bool> isMain(cycle.results.size(), false);
  const CycleDefinition* definition = cycleNamed(cycle.name);
  const auto rankOf = [&](const ResultRecord& result) {
    const auto& results = definition->results;
    auto listed = std::ranges::find(results, result.name, &ResultDefinition::name);
    // An index can mean different things in different variants.
    const auto meant = std::ranges::find_if(results, [&](const ResultDefinition& each) {
      return each.name == result.name && each.kind.role == result.kind.role && each.kind.of == result.kind.of;
    });
    if (meant != results.end()) listed = meant;
    if (listed != results.end()) return listed->kind.rank;
    return result.name.starts_with("_OV") ? Rank::Aside : Rank::Main;
  };
  if (definition == nullptr) {
    std::fill_n(isMain.begin(), std::min(isMain.size(), mostOfUnknownCycle), true);
  } else {
    for (const Rank rank : {Rank::Main, Rank::Fallback}) {
      std::transform(cycle.results.begin(), cycle.results.end(), isMain.begin(),
                     [&](const ResultRecord& result) { return rankOf(result) == rank; });
      if (std::ranges::find(isMain, true) != isMain.end()) break;
    }
  }
  for (std::size_t i = 0; i < isMain.size(); ++i) {
    if (cycle.results[i].verdict != control::Verdict::None) isMain[i] = true;
  }
  return isMain;
}

}  // namespace probewright::cycles
