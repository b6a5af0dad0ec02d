#include "study/first_order.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "setup/simulated_run.hpp"
#include "study/program_bench.hpp"

namespace probewright::study::testing {
namespace {

struct Ran {
  std::map<std::string, std::optional<double>> uncertainties;  ///< by cycle and name
  FirstOrder done;
};

Ran runWith(const std::string& setupText, const std::string& text) {
  Diagnostics mistakes;
  const auto setup = setup::parseSetup(setupText, "setup.toml", mistakes);
  EXPECT_TRUE(setup);
  auto run = setup::runText("p.h", text, *setup, {});
  EXPECT_EQ(run.outcome.result.end, execution::RunEnd::Finished);
  Ran ran;
  ran.done = addUncertainties(run.outcome.journal, setup->world.truth);
  for (const auto& cycle : run.outcome.journal.cycles)
    for (const auto& result : cycle.results)
      ran.uncertainties[cycle.name + " " + result.name] = result.uncertainty;
  return ran;
}

const std::string side =
    "5 TCH PROBE 427 SIDE ~\nQ263=+40 ~\nQ264=+0 ~\nQ261=-5 ~\nQ320=+2 ~\nQ272=+1 ~\nQ267=-1 ~\n"
    "Q260=+30 ~\nQ281=+0 ~\nQ288=+0 ~\nQ289=+0 ~\nQ309=+0 ~\nQ330=+0\n";
const std::string width =
    "6 TCH PROBE 426 WIDTH ~\nQ263=+20 ~\nQ264=-30 ~\nQ265=+20 ~\nQ266=+30 ~\nQ272=+2 ~\nQ261=-5 ~\n"
    "Q320=+2 ~\nQ260=+30 ~\nQ311=+60 ~\nQ288=+0 ~\nQ289=+0 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n";
const std::string edge =
    "7 TCH PROBE 420 EDGE ~\nQ263=-30 ~\nQ264=-30 ~\nQ265=+30 ~\nQ266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\n"
    "Q261=-5 ~\nQ320=+2 ~\nQ260=+30 ~\nQ301=+0 ~\nQ281=+0\n";
const std::string plane =
    "8 TCH PROBE 431 PLANE ~\nQ263=-30 ~\nQ264=-25 ~\nQ294=+0 ~\nQ265=+30 ~\nQ266=-25 ~\nQ295=+0 ~\nQ296=-30 ~\n"
    "Q297=+25 ~\nQ298=+0 ~\nQ320=+2 ~\nQ260=+30 ~\nQ281=+0\n";

TEST(FirstOrder, IsTheClosedFormOfEachCycle) {
  const double s = 0.002, degree = 180 / std::numbers::pi;
  const Ran ran = runWith(plateSetup(), program(bore(3, 4) + side + width + edge + plane));
  const std::map<std::string, double> expected = {
      {"421 Q151", s / std::sqrt(2.0)},
      {"421 Q153", s},
      {"427 Q160", s},
      {"426 Q156", s * std::sqrt(2.0)},
      {"426 Q157", s / std::sqrt(2.0)},
      {"420 Q150", s * std::sqrt(2.0) / 60 * degree},
      {"431 Q159", s * std::sqrt(2.0) / 60 * degree},
      {"431 Q158", s * std::sqrt(2.0) / 50 * degree},
  };
  for (const auto& [key, u] : expected) {
    ASSERT_TRUE(ran.uncertainties.contains(key)) << key;
    ASSERT_TRUE(ran.uncertainties.at(key)) << key;
    // The scattered touches do not lie quite evenly.
    EXPECT_NEAR(*ran.uncertainties.at(key), 2 * u, 2 * u * 1e-3) << key;
  }
  EXPECT_FALSE(ran.uncertainties.at("431 Q170")) << "space angles are not known to first order";
  EXPECT_GT(ran.done.given, 8U);
  EXPECT_GT(ran.done.withheld, 0U);
  EXPECT_TRUE(ran.done.notHeld.empty());
}

TEST(FirstOrder, SaysWhatItDoesNotHold) {
  const Ran lobes =
      runWith(plateSetup("repeatability = 0.001\nlobing = 0.001\n", "[errors.axis.X]\nbacklash = 0.001\n"),
              program(bore(3, 4)));
  EXPECT_THAT(lobes.done.notHeld,
              ::testing::ElementsAre(::testing::HasSubstr("lobes"), ::testing::HasSubstr("machine")));
  // A preset of its own scatters, and what is measured from it scatters by that as well.
  const std::string preset =
      "3 TCH PROBE 417 REF. POINT TS.-AXIS ~\nQ263=+30 ~\nQ264=+20 ~\nQ294=+0 ~\nQ320=+2 ~\nQ260=+20 ~\nQ305=+1 "
      "~\nQ333=+0 ~\nQ303=+1\n";
  const auto earlier = ::testing::ElementsAre(::testing::HasSubstr("earlier cycles have set"));
  EXPECT_THAT(runWith(plateSetup(), program(preset + bore(11, 4))).done.notHeld, earlier);
  EXPECT_THAT(runWith(plateSetup(), program(bore(3, 4) + preset)).done.notHeld, ::testing::Not(earlier));
  const Ran none = runWith(plateSetup(""), program(bore(3, 4)));
  EXPECT_EQ(none.done.given, 0U);
  EXPECT_FALSE(none.uncertainties.at("421 Q151"));
  EXPECT_THAT(none.done.notHeld, ::testing::ElementsAre(::testing::HasSubstr("no repeatability")));
}

/// 2,000 worlds whose part lies anyhow: the interval of +-1.96 u about each measured value holds the true one in 95 %
/// of them.
TEST(FirstOrder, CoversTheTruthAsOftenAsItSays) {
  const TestFolder folder;
  Diagnostics mistakes;
  auto document = setup::SetupDocument::parse(plateSetup(), "setup.toml", mistakes);
  ASSERT_TRUE(document);
  const auto study = parseStudy(R"(
seed = 5
trials = 1
[[source]]
quantity = "part.pose.x"
distribution = "uniform"
half_width = 0.8
[[source]]
quantity = "part.pose.y"
distribution = "uniform"
half_width = 0.8
)",
                                "study.toml", document->table(), mistakes);
  ASSERT_TRUE(study);
  const auto model = ProgramModel::make(folder.file("p.h", program(bore(3, 4) + side + width)), std::move(*document),
                                        *study, {}, mistakes);
  ASSERT_TRUE(model);
  const Sampler sampler(*study);
  std::vector<Draw> draws;
  for (std::uint64_t trial = 0; trial < 2000; ++trial)
    draws.push_back(sampler.draw(trial));
  const auto outcomes = runTrials([&](const Draw& draw) { return model->run(draw); }, draws, 0);
  std::map<std::string, int> covered;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const double x = draws[i].inputs[0], y = draws[i].inputs[1];
    const std::map<std::string, double> truths = {{"421@4 Q151", x},       {"421@4 Q152", y},   {"421@4 Q153", 30},
                                                  {"427@23 Q160", 40 + x}, {"426@36 Q156", 60}, {"426@36 Q157", y}};
    for (const Observation& observation : outcomes[i].observations) {
      const auto truth = truths.find(observation.of.key);
      if (truth == truths.end()) continue;
      ASSERT_TRUE(observation.of.firstOrder) << observation.of.key;
      const bool within = std::abs(observation.value - truth->second) <= 1.96 * *observation.of.firstOrder;
      covered[observation.of.key] += within ? 1 : 0;
    }
  }
  ASSERT_EQ(covered.size(), 6U);
  for (const auto& [key, count] : covered) {
    EXPECT_GE(count, 2000 * 0.94) << key;
    EXPECT_LE(count, 2000 * 0.96) << key;
  }
}

}  // namespace
}  // namespace probewright::study::testing
