#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "study/program_bench.hpp"

/// The interval that a study states, turned about the measured value, in worlds that the study has not seen.
namespace probewright::study::testing {
namespace {

struct Seen {
  double value, truth;
};

/// What each result is in the trials of a seed, and what it should be.
std::map<std::string, std::vector<Seen>> seenIn(std::uint64_t seed, std::uint64_t trials) {
  const TestFolder folder;
  Diagnostics mistakes;
  auto document =
      setup::SetupDocument::parse(plateSetup("repeatability = 0.001\ntip_offset = [0, 0]\n"), "setup.toml", mistakes);
  const auto study = parseStudy("seed = " + std::to_string(seed) + R"(
trials = 1
[[source]]
quantity = "part.pose.x"
distribution = "uniform"
half_width = 0.8
[[source]]
quantity = "part.pose.y"
distribution = "triangular"
half_width = 0.8
[[source]]
name = "calibrated radius"
quantity = "tool[PROBE].believed_radius"
distribution = "normal"
mean = 3
standard_deviation = 0.001
[[source]]
quantity = "tool[PROBE].tip_offset[1]"
distribution = "u-shaped"
mean = 0
half_width = 0.001
)",
                                "study.toml", document->table(), mistakes);
  EXPECT_TRUE(study) << (mistakes.empty() ? "" : format(mistakes.front()));
  if (!study) return {};
  const std::string width =
      "23 TCH PROBE 426 WIDTH ~\nQ263=+20 ~\nQ264=-30 ~\nQ265=+20 ~\nQ266=+30 ~\nQ272=+2 ~\nQ261=-5 "
      "~\nQ320=+2 ~\nQ260=+30 ~\nQ311=+60 ~\nQ288=+0 ~\nQ289=+0 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n";
  const auto model =
      ProgramModel::make(folder.file("p.h", program(bore(3, 4) + width)), std::move(*document), *study, {}, mistakes);
  const Sampler sampler(*study);
  std::vector<Draw> draws;
  for (std::uint64_t trial = 0; trial < trials; ++trial)
    draws.push_back(sampler.draw(trial));
  std::map<std::string, std::vector<Seen>> seen;
  for (const Outcome& outcome : runTrials([&](const Draw& draw) { return model->run(draw); }, draws, 0))
    for (const Observation& observation : outcome.observations)
      if (observation.truth) seen[observation.of.key].push_back({observation.value, *observation.truth});
  return seen;
}

TEST(Coverage, IsWhatTheIntervalOfAStudySays) {
  const auto studied = seenIn(1, 4000), worlds = seenIn(2, 2000);
  int results = 0;
  for (const char* key : {"421@4 Q151", "421@4 Q152", "421@4 Q153", "426@23 Q156", "426@23 Q157"}) {
    SCOPED_TRACE(key);
    ASSERT_TRUE(studied.contains(key));
    std::vector<double> errors;
    for (const Seen& each : studied.at(key))
      errors.push_back(each.value - each.truth);
    ASSERT_EQ(errors.size(), 4000U);
    const Summary stated = summarize(errors, 0.95);
    const auto held = std::ranges::count_if(worlds.at(key), [&](const Seen& each) {
      return each.truth >= each.value - stated.symmetric->high && each.truth <= each.value - stated.symmetric->low;
    });
    // 4,000 trials know the ends to 0.35 % of probability, 2,000 worlds are counted to 0.5 %.
    EXPECT_GE(static_cast<double>(held), 2000 * 0.94);
    EXPECT_LE(static_cast<double>(held), 2000 * 0.96);
    ++results;
  }
  EXPECT_EQ(results, 5);
}

}  // namespace
}  // namespace probewright::study::testing
