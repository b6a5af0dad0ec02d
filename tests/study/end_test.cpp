#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/model_bench.hpp"
#include "study/rank_threads.hpp"
#include "study/study_json.hpp"
#include "study/study_text.hpp"

/// How studies end whose trials come to alarms, and what they say of those.
namespace probewright::study::testing {
namespace {

/// `y` follows the second source; the first one decides whether a trial comes to it.
Model stoppedWhere(const std::function<bool(double)>& stops) {
  return [stops](const Draw& draw) {
    Outcome outcome;
    if (stops(draw.inputs[0])) {
      outcome.end = TrialEnd::Alarm;
      outcome.why = "line 4: probe deflected";
      return outcome;
    }
    Observation y;
    y.of.key = "y";
    y.of.main = true;
    y.value = draw.inputs[1];
    outcome.observations.push_back(y);
    return outcome;
  };
}

Study adaptiveStudy() {
  Study study = studyOf({source("place", Uniform{-20, 20}), source("scatter", Normal{5, 0.1})}, 1);
  study.trials.reset();
  study.digits = 1;
  study.block = 600;
  study.mostTrials = 60'000;
  return study;
}

std::string jsonOf(const StudyResult& result) { return studyJson(result, {"p.h", "setup.toml", "test"}).dump(); }

/// The same study by so many ranks that hand in sums; `states` are those that the first one has kept.
std::string jsonOfRanks(const Study& study, const Model& model, int size, std::vector<std::string>* states = nullptr) {
  std::vector<std::string> found(static_cast<std::size_t>(size));
  onRankThreads(size, [&](const Ranks& ranks) {
    StudyRun run;
    run.crew = rankCrew(ranks, 1, {}, {});
    run.summing = Summing{ranks, threadCrew(1, {}), {}, 250};
    if (ranks.rank == 0 && states != nullptr)
      run.keepState = [&](const std::string& state) { states->push_back(state); };
    found[static_cast<std::size_t>(ranks.rank)] = jsonOf(runStudy(study, {}, model, run));
  });
  for (const std::string& each : found)
    EXPECT_EQ(each, found.front());
  return found.front();
}

/// One process, any number of ranks, and going on after any stretch give the same bits, and no trial beyond the end.
void expectTheSameHowever(const Study& study, const Model& model) {
  const StudyResult once = runStudy(study, {}, model, {});
  const std::string expected = jsonOf(once);
  std::vector<std::string> states;
  EXPECT_EQ(jsonOfRanks(study, model, 1, &states), expected);
  EXPECT_EQ(jsonOfRanks(study, model, 2), expected);
  EXPECT_EQ(jsonOfRanks(study, model, 3), expected);
  ASSERT_FALSE(states.empty());
  for (const std::string& state : {states.front(), states[states.size() / 2], states.back()}) {
    StudyRun rest;
    rest.state = state;
    bool more = false;
    rest.report = [&](const std::string& phase, std::uint64_t, std::uint64_t) { more = more || phase == "trials"; };
    EXPECT_EQ(jsonOf(runStudy(study, {}, model, rest)), expected);
    EXPECT_EQ(more, state != states.back());
  }
}

TEST(StudyEnds, WithNoResultWhereNoTrialComesToItsEnd) {
  const Study study = adaptiveStudy();
  const Model model = stoppedWhere([](double) { return true; });
  const StudyResult result = runStudy(study, {}, model, {});
  EXPECT_EQ(result.end, StudyEnd::NoResult);
  EXPECT_EQ(result.trials, study.block) << "the first look is enough";
  EXPECT_THAT(studyText(result), ::testing::HasSubstr("600 trials, 0 came to the end of the program; no trial came to "
                                                      "its end: nothing was measured"));
  EXPECT_THAT(studyText(result), ::testing::Not(::testing::HasSubstr("stable")));
  EXPECT_EQ(studyJson(result, {"p.h", "setup.toml", "test"})["end"], "no result");
  expectTheSameHowever(study, model);
}

TEST(StudyEnds, WithNoResultAfterTheMostTrialsToo) {
  Study study = adaptiveStudy();
  study.mostTrials = 100;
  EXPECT_EQ(runStudy(study, {}, stoppedWhere([](double) { return true; }), {}).end, StudyEnd::NoResult);
  study.trials = 100;
  EXPECT_EQ(runStudy(study, {}, stoppedWhere([](double) { return true; }), {}).end, StudyEnd::AllTrials);
}

/// A program that comes to its end and measures nothing has no digits that could hold.
TEST(StudyEnds, AfterTheMostTrialsWhereNothingIsMeasured) {
  Study study = adaptiveStudy();
  study.mostTrials = 1500;
  const StudyResult result = runStudy(study, {}, [](const Draw&) { return Outcome(); }, {});
  EXPECT_EQ(result.end, StudyEnd::MostTrials);
  EXPECT_EQ(result.trials, 1500U);
  EXPECT_TRUE(result.answers.empty());
}

/// A fifth of the trials comes to the result: its digits are those that count.
TEST(StudyEnds, WhenResultsThatFewTrialsComeToAreStable) {
  const Study study = adaptiveStudy();
  const Model model = stoppedWhere([](double place) { return std::abs(place) > 4; });
  const StudyResult result = runStudy(study, {}, model, {});
  ASSERT_EQ(result.end, StudyEnd::Stable);
  EXPECT_GT(result.trials, study.block) << "one block tells nothing of digits";
  ASSERT_EQ(result.answers.size(), 1U);
  EXPECT_TRUE(result.answers.front().stable);
  EXPECT_NEAR(result.answers.front().standardUncertainty, 0.1, 0.01);
  expectTheSameHowever(study, model);
}

/// Stopped at both ends of the range, not in its middle: one interval would not tell.
TEST(Alarms, TellInWhichTenthsOfTheRangeTheyCome) {
  Study study = adaptiveStudy();
  study.trials = 3000;
  const Model model = stoppedWhere([](double place) { return place < -9 || place > 13.1; });
  std::vector<double> places;
  StudyRun run;
  run.keep = [&](std::span<const Draw> draws, std::span<const Outcome>) {
    for (const Draw& draw : draws)
      places.push_back(draw.inputs[0]);
  };
  const StudyResult result = runStudy(study, {}, model, run);
  ASSERT_EQ(result.stops.size(), 1U);
  const Tenths& tenths = result.stops.front().tenths.front();
  ASSERT_EQ(places.size(), 3000U);
  std::ranges::sort(places);
  EXPECT_EQ(tenths.low, places.front());
  EXPECT_EQ(tenths.high, places.back());
  const double width = (places.back() - places.front()) / 10;
  for (std::size_t i = 0; i < 10; ++i) {
    const double from = places.front() + static_cast<double>(i) * width, to = from + width;
    std::uint64_t all = 0, stopped = 0;
    for (const double place : places) {
      const bool within = i == 9 ? place >= from : place >= from && place < to;
      all += within ? 1 : 0;
      stopped += within && (place < -9 || place > 13.1) ? 1 : 0;
    }
    EXPECT_EQ(tenths.trials[i], all) << i;
    EXPECT_EQ(tenths.stopped[i], stopped) << i;
  }
  // -20 to 20 in steps of 4: all below -12, three quarters from there to -8, nearly three quarters from 12 to 16.
  const std::string text = studyText(result);
  EXPECT_THAT(text, ::testing::HasSubstr("stopped in tenths of its range, %"));
  EXPECT_THAT(text, ::testing::ContainsRegex("100 100 7[0-9] 0 0 0 0 0 7[0-9] 100"));
  const nlohmann::json json = studyJson(result, {"p.h", "setup.toml", "test"});
  EXPECT_EQ(json["alarms"][0]["sources"][0]["histogram"]["stopped"][0], tenths.trials[0]);
  study.trials.reset();
  expectTheSameHowever(study, model);
}

TEST(Alarms, TellTenthsOfASourceThatStands) {
  Study study = studyOf({source("place", Discrete{{3}, {1}}), source("scatter", Normal{5, 0.1})}, 20);
  const StudyResult result = runStudy(study, {}, stoppedWhere([](double) { return true; }), {});
  ASSERT_EQ(result.stops.size(), 1U);
  EXPECT_EQ(result.stops.front().tenths.front().stopped[0], 20U);
  EXPECT_THAT(studyText(result), ::testing::HasSubstr("100 - - - - - - - - -"));
}

}  // namespace
}  // namespace probewright::study::testing
