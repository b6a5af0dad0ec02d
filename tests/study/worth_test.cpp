#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/model_bench.hpp"
#include "study/study_json.hpp"
#include "study/study_text.hpp"

/// What a measured value is worth where the true values vary: by closed forms.
namespace probewright::study::testing {
namespace {

using ::testing::HasSubstr;

constexpr double s = 0.002, bias = 0.01;

/// A length of 30 mm whose true value varies by +-1 mm and is measured with an error: source "error".
Model lengthOf(double truth = 30, const std::string& unit = "mm", const Formula& error = nullptr) {
  return [=](const Draw& draw) {
    Outcome outcome;
    Observation y;
    y.of.key = "y";
    y.of.label = "a length";
    y.of.unit = unit;
    y.of.main = true;
    y.of.lower = truth - 0.5;
    y.of.upper = truth + 0.5;
    y.truth = truth + draw.inputs[0];
    y.value = *y.truth + (error ? error(draw.inputs) : draw.inputs[1]);
    outcome.observations.push_back(y);
    return outcome;
  };
}

Study varied(std::uint64_t trials, double spread = 1) {
  return studyOf({source("part", Uniform{-spread, spread}), source("error", Normal{bias, s})}, trials);
}

TEST(Worth, IsOfTheErrorsAndTheSpreadIsOfTheValues) {
  Study study = varied(50'000);
  study.sensitivity = Sensitivity::OneAtATime;
  study.sensitivityTrials = 5000;
  const StudyResult result = runStudy(study, {}, lengthOf(), {});
  const Answer& y = result.answers.front();
  EXPECT_NEAR(*y.estimate, 30 + bias, 1e-12);
  EXPECT_NEAR(y.standardUncertainty, s, 0.02 * s);
  // The estimate less the errors: the true value of this item is 30, known to +-1.96 s.
  for (const auto& interval : {y.symmetric, y.shortest}) {
    ASSERT_TRUE(interval);
    EXPECT_NEAR(interval->low, 30 - 1.96 * s, 0.1 * s);
    EXPECT_NEAR(interval->high, 30 + 1.96 * s, 0.1 * s);
  }
  EXPECT_NEAR(*y.corrected, 30, 0.05 * s);
  EXPECT_NEAR(y.error->mean, bias, 0.05 * s);
  // The values spread by what the parts vary by.
  EXPECT_NEAR(y.values.deviation, 1 / std::sqrt(3.0), 0.01);
  EXPECT_NEAR(y.values.symmetric->low, 30 + bias - 0.95, 0.02);
  EXPECT_NEAR(y.values.symmetric->high, 30 + bias + 0.95, 0.02);
  ASSERT_TRUE(y.truths);
  EXPECT_TRUE(y.truths->vary());
  EXPECT_NEAR(y.truths->least, 29, 0.001);
  EXPECT_NEAR(y.truths->greatest, 31, 0.001);
  // Each histogram is of its own.
  const auto width = [](const Histogram& h) { return h.width * static_cast<double>(h.counts.size()); };
  EXPECT_NEAR(width(y.histogram), 2, 0.05);
  EXPECT_NEAR(width(*y.errorHistogram), 8 * s, 2 * s);
  // The budget is that of u: the part has no share in it.
  EXPECT_LT(*y.contributions[0].uncertainty, 1e-9);
  EXPECT_NEAR(*y.contributions[1].uncertainty, s, 0.05 * s);
}

/// The bias is known, so it is corrected: the item behind 30.01 is one of 30.
TEST(Worth, JudgesTheItemBehindTheEstimate) {
  const auto judged = [](double lower, double upper) {
    Study study = varied(20'000);
    study.measurands = {{.result = "y", .truth = {}, .lower = lower, .upper = upper, .place = {}}};
    return runStudy(study, {}, lengthOf(), {}).answers.front();
  };
  const Answer well = judged(30 - 4 * s, 30 + 4 * s);
  EXPECT_EQ(well.decision, Decision::Conforms);
  EXPECT_NEAR(*well.conformance, std::erf(4 / std::sqrt(2.0)), 1e-4);
  const Answer onTheLimit = judged(30, 30.5);
  EXPECT_EQ(onTheLimit.decision, Decision::Undecided);
  EXPECT_NEAR(*onTheLimit.conformance, 0.5, 0.02);
  const Answer beyond = judged(30 + 2 * s, 30.5);
  EXPECT_EQ(beyond.decision, Decision::DoesNotConform);
  EXPECT_NEAR(*beyond.conformance, std::erfc(2 / std::sqrt(2.0)) / 2, 0.004);
}

/// Errors are skew: an exponential distribution of mean s. Its symmetric interval of 95 % is -s ln(0.975) to
/// -s ln(0.025), the shortest one 0 to -s ln(0.05); turned about the estimate.
TEST(Worth, TurnsSkewErrorsAboutTheEstimate) {
  const StudyResult result =
      runStudy(studyOf({source("part", Uniform{-1, 1}), source("u", Uniform{0, 1})}, 100'000), {},
               lengthOf(30, "mm", [](const std::vector<double>& x) { return -s * std::log(x[1]); }), {});
  const Answer& y = result.answers.front();
  const double estimate = 30 - s * std::log(0.5);
  EXPECT_NEAR(*y.estimate, estimate, 1e-12);
  EXPECT_NEAR(y.symmetric->high, estimate + s * std::log(0.975), 0.03 * s);
  EXPECT_NEAR(y.symmetric->low, estimate + s * std::log(0.025), 0.12 * s);
  EXPECT_NEAR(y.shortest->high, estimate, 0.03 * s);
  EXPECT_NEAR(y.shortest->low, estimate + s * std::log(0.05), 0.12 * s);
}

/// The digits that count are those of u, whatever the parts vary by.
TEST(Worth, IsStableWhenItsOwnDigitsAre) {
  const auto trials = [](double spread) {
    Study study = varied(1, spread);
    study.trials.reset();
    study.block = 1000;
    study.mostTrials = 300'000;
    const StudyResult result = runStudy(study, {}, lengthOf(), {});
    EXPECT_EQ(result.end, StudyEnd::Stable);
    EXPECT_TRUE(result.answers.front().stable);
    return result.trials;
  };
  EXPECT_EQ(trials(1), trials(1e-9));
}

TEST(Worth, IsToldApartFromTheSpread) {
  const StudyResult result = runStudy(varied(2000), {}, lengthOf(), {});
  const std::string text = studyText(result);
  EXPECT_THAT(text, HasSubstr("the true value behind the estimate lies in the interval"));
  EXPECT_THAT(text, HasSubstr("Spread of the measured values over the trials: the true values vary, too"));
  const auto json = studyJson(result, {"p.h", "s.toml", "test"})["results"][0];
  EXPECT_EQ(json["coverage"]["of"], "true value");
  EXPECT_LT(json["coverage"]["symmetricInterval"][1].get<double>() - 30, 0.01);
  EXPECT_GT(json["values"]["symmetricInterval"][1].get<double>() - 30, 0.9);
  EXPECT_NEAR(json["truths"][0].get<double>(), 29, 0.01);
  EXPECT_TRUE(json.contains("errorHistogram"));
  // Where the truth stands still nothing is to be told apart.
  EXPECT_THAT(studyText(runStudy(varied(600, 1e-300), {}, lengthOf(), {})), ::testing::Not(HasSubstr("Spread of")));
}

/// The measured values of nobody knows what: they are all that there is.
TEST(Worth, IsOfTheValuesWhereNoTruthIsKnown) {
  const StudyResult result = runStudy(studyOf({source("a", Normal{5, 1})}, 20'000), {},
                                      modelOf([](const std::vector<double>& x) { return x[0]; }), {});
  const Answer& y = result.answers.front();
  EXPECT_EQ(y.symmetric->low, y.values.symmetric->low);
  EXPECT_EQ(y.shortest->high, y.values.shortest->high);
  EXPECT_EQ(y.standardUncertainty, y.values.deviation);
  EXPECT_EQ(*y.corrected, *y.estimate);
  EXPECT_THAT(studyText(result), HasSubstr("* of the measured values: no true value is known"));
}

/// Parts vary by 0.12, are measured to 0.04, tolerance +-0.2: the global risks of JCGM 106 (9.5) are integrals over the
/// product of both normal distributions.
TEST(Worth, CountsTheGlobalRisksOfJcgm106) {
  const double u0 = 0.12, um = 0.04, limit = 0.2, guard = 0.02;
  const auto within = [&](double truth, double zone) {
    const double root = um * std::sqrt(2.0);
    return (std::erf((zone - truth) / root) - std::erf((-zone - truth) / root)) / 2;
  };
  const auto integral = [&](double from, double to, const auto& share) {
    constexpr int steps = 20'000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double truth = from + (to - from) * (i + 0.5) / steps;
      sum += std::exp(-truth * truth / (2 * u0 * u0)) * share(truth) * (to - from) / steps;
    }
    return sum / (u0 * std::sqrt(2 * std::acos(-1.0)));
  };
  Study study = studyOf({source("part", Normal{0, u0}), source("error", Normal{0, um})}, 200'000);
  study.guardFactor = guard / um;
  study.measurands = {{.result = "y", .truth = {}, .lower = 30 - limit, .upper = 30 + limit, .place = {}}};
  const Answer y = runStudy(study, {}, lengthOf(), {}).answers.front();
  for (const auto& [zone, risks] : {std::pair(limit, y.risks), std::pair(limit - guard, y.guardedRisks)}) {
    ASSERT_TRUE(risks);
    const double consumer = 2 * integral(limit, limit + 1, [&](double truth) { return within(truth, zone); });
    const double producer = integral(-limit, limit, [&](double truth) { return 1 - within(truth, zone); });
    // Four standard deviations of what is counted.
    EXPECT_NEAR(risks->consumer, consumer, 4 * std::sqrt(consumer / 200'000)) << zone;
    EXPECT_NEAR(risks->producer, producer, 4 * std::sqrt(producer / 200'000)) << zone;
  }
}

/// One value says nothing of how far others may lie: there is no uncertainty, and nothing is decided with it.
TEST(Worth, IsNotKnownOfOneTrial) {
  const StudyResult result = runStudy(varied(1), {}, lengthOf(), {});
  const auto json = studyJson(result, {"p.h", "s.toml", "test"})["results"][0];
  EXPECT_TRUE(json["standardUncertainty"].is_null());
  EXPECT_TRUE(json["values"]["standardDeviation"].is_null());
  EXPECT_FALSE(json["conformity"].contains("decision"));
  EXPECT_FALSE(json["conformity"].contains("probability"));
  EXPECT_FALSE(result.answers.front().symmetric);
  EXPECT_THAT(studyCsv(result), ::testing::Not(HasSubstr("nan")));
  EXPECT_THAT(studyText(result), ::testing::Not(HasSubstr("nan")));
  EXPECT_NEAR(runStudy(varied(2), {}, lengthOf(), {}).answers.front().standardUncertainty, s, 3 * s);
}

/// An angle that is measured as 359.99 degrees or as 0.01: it varies by a little about 0, not by a turn.
TEST(Worth, TakesAnglesOnBothSidesOfZeroTogether) {
  const Formula turned = [](const std::vector<double>& x) {
    const double angle = std::fmod(x[0] + x[1] + 720, 360.0);
    return angle - x[0];  // the truth is added
  };
  Study study = studyOf({source("part", Uniform{-0.1, 0.1}), source("error", Normal{0, s})}, 5000);
  study.sensitivity = Sensitivity::OneAtATime;
  const Answer y = runStudy(study, {}, lengthOf(0, "deg", turned), {}).answers.front();
  EXPECT_NEAR(y.standardUncertainty, s, 0.06 * s);
  EXPECT_NEAR(y.values.mean, 0, 0.01);
  EXPECT_NEAR(y.values.deviation, 0.1 / std::sqrt(3.0), 0.003);
  EXPECT_NEAR(y.symmetric->high, 1.96 * s, 0.2 * s);
  EXPECT_NEAR(*y.contributions[1].uncertainty, s, 0.15 * s);
  // The sources of an angle are not lengths: of those a value of 360 is another one than 0.
  EXPECT_GT(runStudy(study, {}, lengthOf(0, "mm", turned), {}).answers.front().values.deviation, 100);
}

/// Scatter x makes y = x + k x^2: the standard deviation is root(s^2 + 2 k^2 s^4), to first order s.
TEST(FirstOrderVerdicts, AreRightOnBothSidesOfFivePercent) {
  const auto verdictOf = [](double apart) {
    const double u = 1, k = std::sqrt((std::pow(1 / (1 - apart), 2) - 1) / 2);
    std::vector<double> values;
    for (std::uint64_t i = 0; i < 10'000; ++i) {
      const double x = distribution(Normal{0, u}).value(uniforms({3, i, Purpose::Trial}, 0));
      values.push_back(x + k * x * x);
    }
    return compareWithFirstOrder(values, u);
  };
  EXPECT_EQ(verdictOf(0), FirstOrderVerdict::Holds);
  EXPECT_EQ(verdictOf(0.02), FirstOrderVerdict::Holds);
  EXPECT_EQ(verdictOf(0.05), FirstOrderVerdict::Unclear);
  EXPECT_EQ(verdictOf(0.09), FirstOrderVerdict::Differs);
  EXPECT_EQ(verdictOf(0.3), FirstOrderVerdict::Differs);
  EXPECT_EQ(compareWithFirstOrder({1, 1, 1}, 0.1), FirstOrderVerdict::Differs);
  EXPECT_EQ(compareWithFirstOrder({1, 1, 1}, 0), FirstOrderVerdict::Holds);
}

/// A value on the edge of a zone belongs to the side that the zone has it on, whatever the last bit of a difference is.
TEST(Decisions, AreOneWithTheAcceptanceZoneAtTheLimits) {
  for (int i = 0; i < 1000; ++i) {
    const double lower = 10 + 0.001 * i, upper = lower + 0.1, guard = 0.001 * (1 + i % 40);
    const Tolerance tolerance{lower, upper};
    const auto zone = acceptanceZone(tolerance, guard);
    ASSERT_TRUE(zone);
    EXPECT_EQ(decide(*zone->lower, guard, tolerance), Decision::Conforms) << i;
    EXPECT_EQ(decide(*zone->upper, guard, tolerance), Decision::Conforms) << i;
    EXPECT_EQ(decide(std::nextafter(*zone->lower, 0), guard, tolerance), Decision::Undecided) << i;
    EXPECT_EQ(decide(std::nextafter(*zone->upper, 99), guard, tolerance), Decision::Undecided) << i;
    EXPECT_EQ(decide(lower - guard, guard, tolerance), Decision::Undecided) << i;
    EXPECT_EQ(decide(std::nextafter(upper + guard, 99), guard, tolerance), Decision::DoesNotConform) << i;
  }
}

}  // namespace
}  // namespace probewright::study::testing
