#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "study/program_bench.hpp"
#include "study/rank_threads.hpp"
#include "study/study_json.hpp"
#include "study/study_text.hpp"
#include "study/trial_file.hpp"

namespace probewright::study::testing {
namespace {

const std::string place = R"(
[[source]]
quantity = "part.pose.x"
distribution = "uniform"
half_width = 0.3
)";

/// Without the name of the folder, which is another one in each study.
std::string jsonOf(StudyResult result) {
  result.study.file.clear();
  return studyJson(result, {"p.h", "setup.toml", "test"}).dump();
}

TEST(ProgramStudy, GivesTheSameBitsOnAnyNumberOfThreads) {
  const std::string study =
      "trials = 150\nsensitivity = \"sobol\"\nsensitivity_trials = 20\n[gauge]\nparts = 2\n" + place;
  StudyRun one, two, three;
  one.crew = threadCrew(1, {});
  two.crew = threadCrew(2, {});
  three.crew = threadCrew(3, {});
  one.repeat = two.repeat = three.repeat = 5;
  const std::string expected = jsonOf(studyOfProgram(plateSetup(), program(bore(3, 4)), study, one));
  EXPECT_TRUE(jsonOf(studyOfProgram(plateSetup(), program(bore(3, 4)), study, two)) == expected);
  EXPECT_TRUE(jsonOf(studyOfProgram(plateSetup(), program(bore(3, 4)), study, three)) == expected);
}

TEST(ProgramStudy, KeepsBeliefsWhereTheTruthVaries) {
  const auto bias = [](const std::string& more) {
    return answer(studyOfProgram(plateSetup(""), program(bore(3, 4)), R"(
trials = 40
sensitivity = "none"
[[measurand]]
result = "Q153"
truth = "part.feature[2].diameter"
[[source]]
quantity = "tool[PROBE].pretravel"
distribution = "uniform"
minimum = 0.009999999
maximum = 0.010000001
)" + more),
                  "421@4 Q153")
        .error->mean;
  };
  // The ball goes 10 um further on each side, and nobody has told the control.
  EXPECT_NEAR(bias(""), 0.020, 1e-6);
  EXPECT_NEAR(bias("known = true\n"), 0, 1e-6);
}

/// The diameter varies by 0.1 mm: what is measured follows it, and the error stays that of a perfect probe.
TEST(ProgramStudy, BuildsPartsWhoseSizesVary) {
  const StudyResult result = studyOfProgram(plateSetup(""), program(bore(3, 4, "Q275=+30.05 ~\nQ276=+29.95 ~\n")), R"(
trials = 40
sensitivity = "none"
[[source]]
quantity = "part.feature[2].diameter"
distribution = "normal"
standard_deviation = 0.1
[[measurand]]
result = "Q153"
truth = "part.feature[2].diameter"
)");
  const Answer& found = answer(result, "421@4 Q153");
  EXPECT_NEAR(found.values.deviation, 0.1, 0.04);
  EXPECT_LT(found.error->deviation, 1e-5);
  EXPECT_LT(std::abs(found.error->mean), 1e-5);
  ASSERT_TRUE(found.risks);
  EXPECT_EQ(found.risks->consumer, 0) << "a perfect measurement accepts and rejects rightly";
  EXPECT_EQ(found.risks->producer, 0);
  EXPECT_LT(found.risks->accepted, 40U);
  EXPECT_GT(found.risks->accepted, 5U);
}

/// Parts whose size varies are built anew in each trial; where they lie changes nothing about them.
TEST(ProgramStudy, KnowsThePartsThatItBuildsAnew) {
  const auto rebuilt = [](const std::string& quantity) {
    const TestFolder folder;
    Diagnostics mistakes;
    auto document = setup::SetupDocument::parse(plateSetup(""), "setup.toml", mistakes);
    const auto study = parseStudy("trials = 2\n[[source]]\nquantity = \"" + quantity +
                                      "\"\ndistribution = \"normal\"\nstandard_deviation = 0.1\n",
                                  "study.toml", document->table(), mistakes);
    const auto model =
        study ? ProgramModel::make(folder.file("p.h", program(bore(3, 4))), std::move(*document), *study, {}, mistakes)
              : nullptr;
    return model ? model->rebuilt() : std::vector<std::string>{"no model"};
  };
  EXPECT_EQ(rebuilt("part.feature[2].diameter"), std::vector<std::string>{"plate"});
  EXPECT_EQ(rebuilt("part.pose.x"), std::vector<std::string>{});
}

TEST(ProgramStudy, CountsAlarmsAndSaysWhereTheyCame) {
  // From 9 mm aside on, the bore is not where the program looks for it: the probe meets the plate on its way down.
  const StudyResult result = studyOfProgram(plateSetup(), program(bore(3, 4)), R"(
trials = 200
sensitivity = "none"
[[source]]
name = "aside"
quantity = "part.pose.x"
distribution = "uniform"
minimum = 0
maximum = 20
)");
  ASSERT_FALSE(result.stops.empty());
  std::size_t stopped = 0;
  double nearest = 100;
  for (const Stop& stop : result.stops) {
    stopped += stop.count;
    nearest = std::min(nearest, stop.sources.front().minimum);
    EXPECT_LE(stop.probability.low, static_cast<double>(stop.count) / 200);
    EXPECT_GE(stop.probability.high, static_cast<double>(stop.count) / 200);
  }
  EXPECT_EQ(stopped + result.finished, 200U);
  EXPECT_GT(result.finished, 20U);
  EXPECT_GT(nearest, 3) << "up to there the bore is found";
  EXPECT_EQ(answer(result, "421@4 Q151").values.count, result.finished);
  EXPECT_THAT(studyText(result), ::testing::HasSubstr("aside"));
}

TEST(ProgramStudy, BelievesWhatTheCalibrationHasFound) {
  // A ring of known size: cycle 462 finds the radius. The control begins with a radius that is 0.05 mm wrong.
  const std::string setup = plateSetup("repeatability = 0.001\npretravel = 0.004\nbelieved_radius = 2.95\n",
                                       "[ring]\ndiameter = 50\nheight = 20\npose = { x = 200, y = 0, z = -500 }\n");
  const std::string calibrate =
      "0 BEGIN PGM C MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n3 L X+200 Y+0 R0 FMAX\n4 L Z-25 R0 FMAX\n"
      "5 TCH PROBE 462 RING ~\nQ407=+25 ~\nQ320=+2 ~\nQ423=+8 ~\nQ380=+0\n6 L Z+50 R0 FMAX\n7 END PGM C MM\n";
  const std::string study = R"(
trials = 100
sensitivity = "none"
calibrate = "calibrate.h"
[[source]]
quantity = "part.pose.x"
distribution = "uniform"
half_width = 0.1
[[measurand]]
result = "421@4 Q153"
truth = "part.feature[2].diameter"
)";
  const StudyResult result = studyOfProgram(setup, program(bore(3, 4)), study, {}, calibrate);
  ASSERT_EQ(result.finished, 100U) << (result.stops.empty() ? "" : result.stops.front().why);
  const Answer& found = answer(result, "421@4 Q153");
  // 8 touches in the ring and 4 in the bore scatter: about 2 s / root(8) and 2 s / root(4).
  const double expected = 0.001 * std::sqrt(4.0 / 8 + 4.0 / 4);
  EXPECT_NEAR(found.error->mean, 0, 5 * expected / 10);
  EXPECT_NEAR(found.error->deviation, expected, 0.4 * expected);
}

TEST(ProgramStudy, GoesOnWhereItWasBrokenOff) {
  const TestFolder folder;
  const std::string study = "trials = 1200\nsensitivity = \"none\"\n" + place;
  const std::string expected = jsonOf(studyOfProgram(plateSetup(), program(bore(3, 4)), study));
  std::stop_source stop;
  TrialWriter writer(folder.path() / "trials.csv", "mark", {"part.pose.x"});
  StudyRun run;
  run.stop = stop.get_token();
  run.keep = [&](std::span<const Draw> draws, std::span<const Outcome> outcomes) {
    ASSERT_TRUE(writer.write(draws, outcomes));
    stop.request_stop();
  };
  const StudyResult broken = studyOfProgram(plateSetup(), program(bore(3, 4)), study, run);
  EXPECT_EQ(broken.end, StudyEnd::Interrupted);
  EXPECT_LT(broken.trials, 1200U);
  // A line that was cut off by a crash does not count.
  std::ofstream(folder.path() / "trials.csv", std::ios::app) << "500,finished,,0.1,3";
  auto kept = TrialReader::open(folder.path() / "trials.csv", "mark");
  ASSERT_TRUE(kept) << format(kept.error());
  StudyRun rest;
  rest.done = [&]() -> std::optional<Outcome> {
    const auto trial = kept->next();
    return trial ? std::optional(trial->outcome) : std::nullopt;
  };
  TrialWriter more(folder.path() / "trials.csv", "mark", {"part.pose.x"});
  bool begun = false;
  rest.keep = [&](std::span<const Draw> draws, std::span<const Outcome> outcomes) {
    if (!std::exchange(begun, true)) {
      ASSERT_TRUE(more.goOn(*kept));
    }
    ASSERT_TRUE(more.write(draws, outcomes));
  };
  EXPECT_TRUE(jsonOf(studyOfProgram(plateSetup(), program(bore(3, 4)), study, rest)) == expected);
  EXPECT_EQ(kept->trials(), broken.trials);
  auto whole = TrialReader::open(folder.path() / "trials.csv", "mark");
  ASSERT_TRUE(whole);
  std::uint64_t trials = 0;
  while (whole->next())
    ++trials;
  EXPECT_EQ(trials, 1200U);
  EXPECT_FALSE(TrialReader::open(folder.path() / "trials.csv", "another"));
  EXPECT_TRUE(whyNotTrials(folder.file("mine.csv", "a,b\n")));
  EXPECT_FALSE(whyNotTrials(folder.path() / "trials.csv"));
}

/// A trial is a line, whatever stopped it: other programs read the file line by line.
TEST(ProgramStudy, WritesATrialInOneLine) {
  const TestFolder folder;
  TrialWriter writer(folder.path() / "trials.csv", "mark", {});
  const std::vector<std::string> reasons = {"first\nsecond", "first\rsecond", "first\r\nsecond", "with, \"comma\""};
  std::vector<Draw> draws;
  std::vector<Outcome> outcomes;
  for (const std::string& why : reasons) {
    draws.push_back({draws.size(), {}, {}});
    outcomes.push_back({TrialEnd::Alarm, why, {}});
  }
  ASSERT_TRUE(writer.write(draws, outcomes));
  std::ifstream file(folder.path() / "trials.csv", std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(std::ranges::count(text, '\n'), 2 + 4) << "the mark, the heading, and a line a trial:\n" << text;
  EXPECT_EQ(std::ranges::count(text, '\r'), 0) << text;
  auto kept = TrialReader::open(folder.path() / "trials.csv", "mark");
  ASSERT_TRUE(kept);
  for (const char* why : {"first second", "first second", "first  second", "with, \"comma\""}) {
    const auto trial = kept->next();
    ASSERT_TRUE(trial) << why;
    EXPECT_EQ(trial->outcome.why, why);
  }
}

/// Where the part lies varies by a millimetre; the machine knows where, and what is left is the scatter.
TEST(ProgramStudy, TakesTrueValuesFromTheVirtualMachine) {
  const std::string aside = "[[source]]\nquantity = \"part.pose.x\"\ndistribution = \"uniform\"\nhalf_width = 1\n";
  const StudyResult result = studyOfProgram(plateSetup("repeatability = 0.001\n"), program(bore(3, 4)),
                                            "trials = 400\nsensitivity_trials = 400\n" + aside);
  const Answer& found = answer(result, "421@4 Q151");
  EXPECT_NEAR(found.values.deviation, 1 / std::sqrt(3.0), 0.08);
  ASSERT_TRUE(found.error);
  EXPECT_NEAR(found.standardUncertainty, 0.001 / std::sqrt(2.0), 0.15 * 0.001);
  EXPECT_NEAR(found.error->mean, 0, 5 * 0.001 / std::sqrt(800.0));
  // The budget is that of the error, too: all of it is scatter.
  EXPECT_LT(found.contributions.front().uncertainty.value(), 1e-5);
  EXPECT_NEAR(found.contributions.back().uncertainty.value(), 0.001 / std::sqrt(2.0), 0.15 * 0.001);
  EXPECT_EQ(found.firstOrder, FirstOrderVerdict::Holds);
  // A deviation is as wrong as what it is the deviation of.
  const Answer& deviation = answer(result, "421@4 Q161");
  ASSERT_TRUE(deviation.error);
  EXPECT_NEAR(deviation.standardUncertainty, found.standardUncertainty, 1e-9);
  EXPECT_NEAR(deviation.values.deviation, found.values.deviation, 1e-9);
  EXPECT_EQ(deviation.firstOrder, FirstOrderVerdict::Holds);
  const StudyResult blind = studyOfProgram(plateSetup("repeatability = 0.001\n"), program(bore(3, 4)),
                                           "trials = 20\nsensitivity = \"none\"\ntrue_values = false\n" + aside);
  EXPECT_FALSE(answer(blind, "421@4 Q151").error);
}

/// Ranks that exchange messages, without MPI: each is a thread here, and all come to what one process finds.
TEST(ProgramStudy, GivesTheSameBitsOnAnyNumberOfRanks) {
  const std::string study = "trials = 150\nsensitivity_trials = 20\n" + place;
  const std::string expected = jsonOf(studyOfProgram(plateSetup(), program(bore(3, 4)), study));
  for (const int size : {2, 4}) {
    std::vector<std::string> found(static_cast<std::size_t>(size));
    onRankThreads(size, [&](const Ranks& ranks) {
      StudyRun run;
      run.stretch = size == 2 ? 500 : 40;
      run.crew = rankCrew(ranks, 1, {}, {});
      found[static_cast<std::size_t>(ranks.rank)] =
          jsonOf(studyOfProgram(plateSetup(), program(bore(3, 4)), study, run));
    });
    for (const std::string& each : found)
      EXPECT_TRUE(each == expected);
  }
}

/// Ranks that hand in sums, each on its thread, and one that goes on alone where they were stopped.
TEST(ProgramStudy, GivesTheSameBitsWhereRanksHandInSums) {
  const std::string study =
      "sensitivity_trials = 20\nblock = 700\ndigits = 1\nmost_trials = 2100\n[[measurand]]\nresult = \"Q153\"\nlower = "
      "29.9\n"
      "upper = 30.1\n" +
      place;
  const std::string setup = plateSetup("repeatability = 0.001\n");
  const std::string expected = jsonOf(studyOfProgram(setup, program(bore(3, 4)), study));
  std::string state;
  for (const int size : {1, 2, 3, 4}) {
    std::vector<std::string> found(static_cast<std::size_t>(size));
    onRankThreads(size, [&](const Ranks& ranks) {
      StudyRun run;
      run.crew = rankCrew(ranks, 1, {}, {});
      run.summing = Summing{ranks, threadCrew(1, {}), {}, 300};
      int states = 0;
      run.keepState = [&](const std::string& told) {
        if (ranks.rank == 0 && size == 3 && ++states == 3) state = told;
      };
      found[static_cast<std::size_t>(ranks.rank)] = jsonOf(studyOfProgram(setup, program(bore(3, 4)), study, run));
    });
    for (const std::string& each : found)
      EXPECT_TRUE(each == expected) << size;
  }
  ASSERT_FALSE(state.empty());
  StudyRun rest;
  rest.state = state;
  std::uint64_t begun = 0;
  rest.report = [&](const std::string&, std::uint64_t done, std::uint64_t) { begun = begun == 0 ? done : begun; };
  EXPECT_TRUE(jsonOf(studyOfProgram(setup, program(bore(3, 4)), study, rest)) == expected);
  EXPECT_GT(begun, 700U);
}

/// One of two ranks is stopped: both end after the same trial.
TEST(ProgramStudy, StopsAllRanksAfterTheSameTrial) {
  const std::string study = "trials = 5000\nsensitivity = \"none\"\n" + place;
  std::vector<StudyResult> found(2);
  std::stop_source stopOfTheSecond;
  onRankThreads(2, [&](const Ranks& ranks) {
    std::stop_source all;
    StudyRun run;
    run.stop = all.get_token();
    int stretches = 0;
    const auto exchange = [&](const std::string& mine) {
      const std::vector<std::string> both = ranks.exchange(mine);
      if (ranks.rank == 1 && ++stretches == 3) stopOfTheSecond.request_stop();
      return both;
    };
    run.crew =
        rankCrew({ranks.rank, 2, exchange}, 1, ranks.rank == 1 ? stopOfTheSecond.get_token() : std::stop_token(), all);
    found[static_cast<std::size_t>(ranks.rank)] = studyOfProgram(plateSetup(), program(bore(3, 4)), study, run);
  });
  EXPECT_EQ(found[0].end, StudyEnd::Interrupted);
  EXPECT_LT(found[0].trials, 5000U);
  EXPECT_GE(found[0].trials, 1000U);
  EXPECT_TRUE(jsonOf(found[0]) == jsonOf(found[1]));
}

TEST(ProgramStudy, NamesMeasurandsThatNoResultFits) {
  const StudyResult result =
      studyOfProgram(plateSetup(), program(bore(3, 4)),
                     "trials = 2\nsensitivity = \"none\"\n[[measurand]]\nresult = \"Q999\"\n" + place);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_THAT(format(result.diagnostics.front()), ::testing::HasSubstr("\"Q999\""));
}

/// Without the place of its cycle a name is enough where one cycle has such a result.
TEST(ProgramStudy, SaysWhereAMeasurandIsMoreThanOneResult) {
  const std::string study = "trials = 2\nsensitivity = \"none\"\n[[measurand]]\nresult = \"Q153\"\n" + place;
  EXPECT_TRUE(studyOfProgram(plateSetup(), program(bore(3, 4)), study).diagnostics.empty());
  const StudyResult two = studyOfProgram(plateSetup(), program(bore(3, 4) + bore(4, 4)), study);
  ASSERT_EQ(two.diagnostics.size(), 1U);
  EXPECT_THAT(format(two.diagnostics.front()), ::testing::HasSubstr("2 results of the program are called \"Q153\""));
}

/// What no setup can have is a mistake of the study, found before the first trial; what some trials cannot have is not.
TEST(ProgramStudy, RefusesNumbersThatNoSetupHas) {
  const auto mistakesOf = [](const std::string& quantity, const std::string& distribution) {
    return mistakesOfModel(plateSetup(), program(bore(3, 4)),
                           "trials = 5\n" + place + "[[source]]\nquantity = \"" + quantity + "\"\n" + distribution);
  };
  const std::string uniform = "distribution = \"uniform\"\nminimum = 0.25\nmaximum = 3\n";
  for (const auto& [quantity, why] : std::vector<std::pair<std::string, std::string>>{
           {"part.pose.q", "quantity \"part.pose.q\": unknown key \"q\""},
           {"preset[row=1].rotation", "quantity \"preset[row=1].rotation\": "},
           {"preset[row=1].row", "must be a whole number from 0 to 9999"},
           {"tool[1].number", "must be a whole number from 1 to 32767"},
           {"tool[1].retraction", "unknown key"}}) {
    const Diagnostics mistakes = mistakesOf(quantity, uniform);
    ASSERT_EQ(mistakes.size(), 1U) << quantity;
    EXPECT_THAT(mistakes.front().message, ::testing::HasSubstr(why));
    EXPECT_EQ(mistakes.front().place.line, 8U);
    EXPECT_GT(mistakes.front().place.column, 0U);
    EXPECT_FALSE(mistakes.front().advice.empty());
  }
  // The estimate alone would do.
  const Diagnostics fractions =
      mistakesOf("tool[1].number", "distribution = \"normal\"\nmean = 1\nstandard_deviation = 0.001\n");
  ASSERT_EQ(fractions.size(), 1U);
  EXPECT_THAT(fractions.front().message, ::testing::HasSubstr("must be a whole number from 1 to 32767"));
  EXPECT_TRUE(mistakesOf("part.pose.y", uniform).empty());
  EXPECT_TRUE(
      mistakesOf("part.feature[2].diameter", "distribution = \"uniform\"\nminimum = -5\nmaximum = 30\n").empty());
  EXPECT_TRUE(
      mistakesOf("part.feature[2].diameter", "distribution = \"uniform\"\nminimum = -5\nmaximum = 4\n").empty());
  EXPECT_TRUE(mistakesOf("part.feature[2].diameter", "distribution = \"discrete\"\nvalues = [-1, 30]\n").empty());
}

/// Parts lie elsewhere along X, appraisers clamp them elsewhere along Y: each is told in the coordinate where it acts.
/// By four touches a diameter scatters as much as a touch, a coordinate of the centre by 1/sqrt(2) of it.
TEST(ProgramStudy, TellsPartsAppraisersAndRepeatsApart) {
  const auto study = [](const std::string& alongX, const std::string& alongY) {
    const std::string source = R"([[source]]
quantity = "part.pose.{}"
distribution = "uniform"
half_width = 0.1
drawn = "{}"
)";
    return studyOfProgram(plateSetup(), program(bore(3, 4)),
                          "trials = 2\nsensitivity = \"none\"\n[gauge]\nparts = 6\nappraisers = 4\nrepeats = 2\n" +
                              fmt::format(fmt::runtime(source + source), "x", alongX, "y", alongY));
  };
  const double ofTouches = 0.002 / std::sqrt(2), ofPlaces = 0.1 / std::sqrt(3);
  const StudyResult result = study("part", "appraiser");
  const auto gaugeOf = [](const StudyResult& found, const char* name) {
    const Answer& each = answer(found, name);
    EXPECT_TRUE(each.gauge) << name;
    return each.gauge.value_or(GaugeRR());
  };
  const GaugeRR x = gaugeOf(result, "421@4 Q151"), y = gaugeOf(result, "421@4 Q152"),
                diameter = gaugeOf(result, "421@4 Q153");
  EXPECT_EQ(x.parts, 6U);
  EXPECT_EQ(x.appraisers, 4U);
  EXPECT_EQ(x.repeats, 2U);
  EXPECT_NEAR(x.repeatability, ofTouches, 0.4 * ofTouches);
  EXPECT_NEAR(x.partVariation, ofPlaces, 0.7 * ofPlaces);
  EXPECT_LT(x.reproducibility, 2 * ofTouches);
  EXPECT_NEAR(y.repeatability, ofTouches, 0.4 * ofTouches);
  EXPECT_NEAR(y.reproducibility, ofPlaces, 0.8 * ofPlaces);
  EXPECT_LT(y.partVariation, 2 * ofTouches);
  EXPECT_NEAR(diameter.repeatability, 0.002, 0.4 * 0.002);
  EXPECT_LT(diameter.partVariation, 0.003);
  for (const Answer& each : result.answers)
    EXPECT_EQ(each.gauge.has_value(), each.of.main) << each.of.key;
  // What is drawn in each trial is the gauge's own.
  EXPECT_NEAR(gaugeOf(study("trial", "part"), "421@4 Q151").repeatability, ofPlaces, 0.4 * ofPlaces);
}

}  // namespace
}  // namespace probewright::study::testing
