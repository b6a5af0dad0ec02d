#include "study/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "study/adaptive.hpp"
#include "study/capability.hpp"
#include "study/conformity.hpp"
#include "study/model_bench.hpp"
#include "study/random.hpp"

namespace probewright::study::testing {
namespace {

TEST(Random, AgreesWithThePublishedPhilox) {
  // Known answer of Random123 for key 0 and counter 0: 6627e8d5 e169c58d bc57ac4c 9b00dbd8.
  const auto drawn = uniforms({0, 0, Purpose::Trial}, 0);
  EXPECT_EQ(drawn[0], (static_cast<double>(0xe169c58d6627e8d5U >> 12U) + 0.5) * std::pow(2, -52));
  EXPECT_EQ(drawn[1], (static_cast<double>(0x9b00dbd8bc57ac4cU >> 12U) + 0.5) * std::pow(2, -52));
}

TEST(Random, DiffersByTrialSourcePurposeAndSeed) {
  const auto one = uniforms({1, 7, Purpose::Trial}, 3);
  EXPECT_EQ(uniforms({1, 7, Purpose::Trial}, 3), one);
  EXPECT_NE(uniforms({2, 7, Purpose::Trial}, 3), one);
  EXPECT_NE(uniforms({1, 8, Purpose::Trial}, 3), one);
  EXPECT_NE(uniforms({1, 7, Purpose::Resample}, 3), one);
  EXPECT_NE(uniforms({1, 7, Purpose::Trial}, 4), one);
}

/// Mean and standard deviation of each distribution, beside those of 40,000 draws.
TEST(Distributions, HaveTheMomentsThatTheySay) {
  const auto samples = std::make_shared<const std::vector<double>>(std::vector<double>{1, 2, 2, 7});
  const std::vector<std::pair<Distribution, std::pair<double, double>>> cases = {
      {distribution(Normal{3, 0.5}), {3, 0.5}},
      {distribution(Uniform{-1, 5}), {2, 6 / std::sqrt(12.0)}},
      {distribution(Triangular{0, 0, 3}), {1, std::sqrt(0.5)}},
      {distribution(UShaped{-2, 2}), {0, std::sqrt(2.0)}},
      {distribution(Student{1, 2, 10}), {1, 2 * std::sqrt(10.0 / 8)}},
      {distribution(InexactLimits{-1, 1, 0.5}), {0, std::sqrt(4.0 / 12 + 0.25 / 9)}},
      {distribution(Discrete{{0, 10}, {3, 1}}), {2.5, std::sqrt(18.75)}},
      {distribution(Samples{samples}), {3, std::sqrt(22.0 / 4)}},
      // A normal distribution cut at one standard deviation on both sides.
      {Distribution::truncated(Normal{0, 1}, {-1, 1}).value(),
       {0, std::sqrt(1 - 2 * std::exp(-0.5) / std::sqrt(2 * std::numbers::pi) / std::erf(1 / std::sqrt(2.0)))}},
      {Distribution::truncated(Uniform{2, 6}, {3, 5}).value(), {4, 2 / std::sqrt(12.0)}},
      {Distribution::truncated(Uniform{2, 6}, {-3, 5}).value(), {3.5, 3 / std::sqrt(12.0)}},
      // From its mode on a triangle falls to its end. Above three quarters of its width the arcsine is that of a sixth
      // of a turn: 1 + 2 sin, from 30 to 90 degrees.
      {Distribution::truncated(Triangular{0, 1, 4}, {1, 9}).value(), {2, std::sqrt(0.5)}},
      {Distribution::truncated(UShaped{-1, 3}, {2, 9}).value(),
       {1 + 3 * std::sqrt(3.0) / std::numbers::pi,
        std::sqrt(2 + 3 * std::sqrt(3.0) / (2 * std::numbers::pi) - 27 / (std::numbers::pi * std::numbers::pi))}},
      // Half of Student's t with 4 degrees of freedom: the mean of |t| is 1, that of its square 2.
      {Distribution::truncated(Student{10, 0.5, 4}, {10, 1e6}).value(), {10.5, 0.5}},
  };
  for (const auto& [each, moments] : cases) {
    EXPECT_NEAR(each.mean(), moments.first, 1e-9) << each.name();
    EXPECT_NEAR(each.standardDeviation(), moments.second, 1e-7) << each.name();
    std::vector<double> values;
    for (std::uint64_t trial = 0; trial < 40'000; ++trial)
      values.push_back(each.value(uniforms({5, trial, Purpose::Trial}, 0)));
    const Summary drawn = summarize(values, 0.95);
    EXPECT_NEAR(drawn.mean, moments.first, 5 * moments.second / 200) << each.name();
    EXPECT_NEAR(drawn.deviation, moments.second, 0.03 * moments.second) << each.name();
  }
}

/// The value of a score lies at the same place of its distribution as the score in the standard normal distribution.
TEST(Distributions, HaveAValueForEachScore) {
  const auto below = [](double score) { return std::erfc(-score / std::sqrt(2.0)) / 2; };
  for (const double score : {-1.7, -0.4, 0.0, 0.9, 2.1}) {
    EXPECT_NEAR(Distribution::make(Normal{1, 2})->valueOfScore(score), 1 + 2 * score, 1e-12);
    EXPECT_NEAR(Distribution::make(Uniform{2, 6})->valueOfScore(score), 2 + 4 * below(score), 1e-12);
    EXPECT_NEAR(Distribution::make(UShaped{-1, 3})->valueOfScore(score),
                1 - 2 * std::cos(std::numbers::pi * below(score)), 1e-12);
    const double cut = Distribution::truncated(Normal{1, 2}, {0, 4})->valueOfScore(score);
    EXPECT_NEAR((below((cut - 1) / 2) - below(-0.5)) / (below(1.5) - below(-0.5)), below(score), 1e-9);
  }
}

TEST(Distributions, RefuseWhatIsNone) {
  EXPECT_FALSE(Distribution::make(Normal{0, 0}));
  EXPECT_FALSE(Distribution::make(Uniform{1, 1}));
  EXPECT_FALSE(Distribution::make(Triangular{0, 4, 3}));
  EXPECT_FALSE(Distribution::make(Student{0, 1, 2}));
  EXPECT_FALSE(Distribution::make(Discrete{{1, 2}, {0, 0}}));
  EXPECT_FALSE(Distribution::make(Samples{}));
  EXPECT_FALSE(Distribution::make(Normal{NAN, 1}));
  EXPECT_FALSE(Distribution::truncated(Normal{0, 1}, {20, 21}));
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& limits : {std::pair(1.0, 0.0), {1.0, 1.0}, {-infinite, 1.0}, {0.0, infinite}, {std::nan(""), 1.0}}) {
    const auto refused = Distribution::truncated(Normal{0, 1}, limits);
    ASSERT_FALSE(refused) << limits.first << " to " << limits.second;
    EXPECT_NE(refused.error().message.find("the lower first"), std::string::npos) << refused.error().message;
  }
}

TEST(Summary, TakesTheIntervalsOfJcgm101) {
  // 1 .. 100: q = 95, r = 3; y(3) and y(98). All intervals of 95 steps are as short; the first one counts.
  std::vector<double> values;
  for (int i = 100; i > 0; --i)
    values.push_back(i);
  const Summary summary = summarize(values, 0.95);
  EXPECT_EQ(summary.symmetric->low, 3);
  EXPECT_EQ(summary.symmetric->high, 98);
  EXPECT_EQ(summary.shortest->low, 1);
  EXPECT_EQ(summary.shortest->high, 96);
  EXPECT_EQ(summary.mean, 50.5);
  EXPECT_NEAR(summary.deviation, std::sqrt(100 * 101 / 12.0), 1e-9);
  // The fewest values that have one: of 81 .. 100 q = 19, r = 1; y(1) and y(20). Of 9 values q = 9: none.
  values.resize(20);
  const Summary few = summarize(values, 0.95);
  ASSERT_TRUE(few.symmetric);
  EXPECT_EQ(few.symmetric->low, 81);
  EXPECT_EQ(few.symmetric->high, 100);
  values.resize(9);
  EXPECT_FALSE(summarize(values, 0.95).symmetric);
}

TEST(Summary, LeavesOutWhatIsMissing) {
  const std::vector<double> values = {1, missing, 3};
  const Summary summary = summarize(values, 0.95);
  EXPECT_EQ(summary.count, 2U);
  EXPECT_EQ(summary.mean, 2);
  EXPECT_FALSE(summary.symmetric) << "two values have no interval of 95 %";
  EXPECT_EQ(summarize(std::vector<double>{missing}, 0.95).count, 0U);
}

TEST(Histogram, CountsEveryValueOnce) {
  std::vector<double> values;
  for (std::uint64_t trial = 0; trial < 5000; ++trial)
    values.push_back(uniforms({9, trial, Purpose::Trial}, 1)[0]);
  const Histogram histogram = histogramOf(values);
  std::size_t sum = 0;
  for (const std::size_t count : histogram.counts)
    sum += count;
  EXPECT_EQ(sum, values.size());
  EXPECT_GT(histogram.counts.size(), 5U);
  EXPECT_EQ(histogramOf(std::vector<double>{4, 4}).counts, std::vector<std::size_t>{2});
}

TEST(Correlation, IsThatOfAStraightLine) {
  const std::vector<double> x = {1, 2, 3, missing, 5}, up = {2, 4, 6, 8, 10}, flat = {1, 1, 1, 1, 1};
  EXPECT_NEAR(correlation(x, up).value(), 1, 1e-12);
  EXPECT_FALSE(correlation(x, flat));
}

/// No hits in n trials: 1 - (alpha/2)^(1/n).
TEST(Probability, HasTheLimitsOfClopperAndPearson) {
  EXPECT_EQ(probability(0, 100).low, 0);
  EXPECT_NEAR(probability(0, 100).high, 1 - std::pow(0.025, 0.01), 1e-12);
  EXPECT_NEAR(probability(100, 100).low, std::pow(0.025, 0.01), 1e-12);
  // 10 of 100: published 4.90 % to 17.62 %.
  EXPECT_NEAR(probability(10, 100).low, 0.0490, 5e-5);
  EXPECT_NEAR(probability(10, 100).high, 0.1762, 5e-5);
}

/// The examples of JCGM 101, 7.9.2: 0.35 with two digits, 0.41 with two, 0.4 with one.
TEST(Adaptive, KnowsTheToleranceOfANumber) {
  EXPECT_NEAR(numericalTolerance(0.35, 2), 0.005, 1e-12);
  EXPECT_NEAR(numericalTolerance(0.41, 2), 0.005, 1e-12);
  EXPECT_NEAR(numericalTolerance(0.4, 1), 0.05, 1e-12);
  EXPECT_NEAR(numericalTolerance(0.0997, 2), 0.005, 1e-12) << "0.0997 is 0.10 with two digits";
  EXPECT_EQ(numericalTolerance(0, 2), 0);
}

TEST(Adaptive, IsStableWhereBlocksAgree) {
  Stability stability(1, 0.95);
  const std::vector<double> block = {1, 2, 3, 4, 5};
  stability.add(block);
  EXPECT_FALSE(stability.stable()) << "one block agrees with nothing";
  stability.add(block);
  EXPECT_TRUE(stability.stable());
  stability.add(std::vector<double>{11, 12, 13, 14, 15});
  EXPECT_FALSE(stability.stable());
}

/// Values that are the same but for the last digits of a double: no number of trials would make those stable.
TEST(Adaptive, IsStableWhereOnlyTheLastDigitsDiffer) {
  for (const double value : {0.0, 30.01, 480.0}) {
    Stability stability(2, 0.95);
    double digit = 1e-15;
    for (int i = 0; i < 4; ++i, digit *= -1.7)
      stability.add(std::vector<double>{value, value * (1 + 1e-15) + digit, value - digit / 3});
    EXPECT_TRUE(stability.stable()) << value;
  }
  Stability nanometre(2, 0.95);
  nanometre.add(std::vector<double>{30, 30 + 1e-6});
  nanometre.add(std::vector<double>{30 + 1e-6, 30 + 3e-6});
  EXPECT_FALSE(nanometre.stable());
}

/// Probabilities of the normal distribution: 0.5 on a limit, 95 % at 1.6449 standard uncertainties from it.
TEST(Conformity, IsTheNormalDistributionWithinTheLimits) {
  EXPECT_NEAR(conformanceProbability(10, 0.1, {std::nullopt, 10.0}), 0.5, 1e-12);
  EXPECT_NEAR(conformanceProbability(10 - 0.16448536, 0.1, {std::nullopt, 10.0}), 0.95, 1e-7);
  EXPECT_NEAR(conformanceProbability(0, 1, {-1.0, 1.0}), std::erf(1 / std::sqrt(2.0)), 1e-12);
  EXPECT_EQ(conformanceProbability(1, 0, {-1.0, 1.0}), 1);
}

TEST(Conformity, DecidesByTheGuardBand) {
  const Tolerance tolerance{10.0, 10.1};
  EXPECT_EQ(decide(10.05, 0.02, tolerance), Decision::Conforms);
  EXPECT_EQ(decide(10.09, 0.02, tolerance), Decision::Undecided);
  EXPECT_EQ(decide(10.11, 0.02, tolerance), Decision::Undecided);
  EXPECT_EQ(decide(10.13, 0.02, tolerance), Decision::DoesNotConform);
  EXPECT_FALSE(acceptanceZone(tolerance, 0.06));
}

TEST(Conformity, CountsBothKindsOfWrongDecisions) {
  const std::vector<double> truth = {1, 1, 3, 3, missing}, measured = {1, 3, 1, 3, 1};
  const Risks risks = risksOf(measured, truth, {std::nullopt, 2.0}, {std::nullopt, 2.0});
  EXPECT_EQ(risks.count, 4U);
  EXPECT_EQ(risks.consumer, 0.25);
  EXPECT_EQ(risks.producer, 0.25);
}

TEST(Capability, IsWhatType1StudiesCompute) {
  // s = 1 (five values around 10.5), T = 60: Cg = 12 / 6, Cgk = (6 - 0.5) / 3.
  const std::vector<double> values = {9.5, 9.5, 10.5, 11.5, 11.5};
  const auto study = type1(values, 10, 60);
  ASSERT_TRUE(study);
  EXPECT_NEAR(study->cg, 2, 1e-12);
  EXPECT_NEAR(study->cgk, 5.5 / 3, 1e-12);
  EXPECT_FALSE(type1(values, 10, 0));
}

}  // namespace
}  // namespace probewright::study::testing
