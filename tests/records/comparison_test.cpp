#include "records/comparison.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "records/results.hpp"
#include "records/sample_run.hpp"

namespace probewright::records {
namespace {

/// A run that calls these cycles.
nlohmann::json runOf(const std::vector<std::string>& names) {
  nlohmann::json run = nlohmann::json::parse(resultsText(sample::journal(), sample::runInfo()));
  const nlohmann::json call = run.at("cycles").at(0);
  run["cycles"] = nlohmann::json::array();
  for (const std::string& name : names) {
    run["cycles"].push_back(call);
    run["cycles"].back()["name"] = name;
  }
  return run;
}

/// "B" is called in both runs, "-A" in the first only, "+A" in the second only.
std::vector<std::string> paired(const std::vector<std::string>& first, const std::vector<std::string>& second) {
  const auto comparison = compare(runOf(first), runOf(second), 0);
  if (!comparison) return {format(comparison.error())};
  std::vector<std::string> found;
  for (const ComparedCycle& each : comparison->cycles)
    found.push_back((each.inBoth() ? "" : each.firstPlace.empty() ? "+" : "-") + each.name);
  return found;
}

/// As many calls as possible have a partner, in their order.
TEST(Comparison, PairsTheLongestSequenceThatBothRunsHave) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(paired({"400", "427", "421", "423", "417"}, {"417", "400", "421", "423"}),
            (Names{"+417", "400", "-427", "421", "423", "-417"}));
  EXPECT_EQ(paired({"417", "400", "421", "423"}, {"400", "427", "421", "423", "417"}),
            (Names{"-417", "400", "+427", "421", "423", "+417"}));
  EXPECT_EQ(paired({"400", "421", "417"}, {"400", "417", "421", "417"}), (Names{"400", "+417", "421", "417"}));
}

}  // namespace
}  // namespace probewright::records
