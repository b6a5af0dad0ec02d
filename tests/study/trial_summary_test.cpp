#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "study/findings.hpp"
#include "study/model_bench.hpp"

/// Sums of trials against all values: the same bits in any order, and quantiles no farther off than is said.
namespace probewright::study::testing {
namespace {

const Sampler nothing({}, {}, 1);
constexpr std::size_t trials = 20'000, first = 500;

/// What results x, y and z are in each trial. True values of x are known; some trials stop before z.
struct World {
  std::vector<double> x, y, z, truth;
  explicit World(double scale) {
    std::mt19937_64 random(20261122);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < trials; ++i) {
      const double a = normal(random), b = normal(random);
      truth.push_back(30 + scale * 0.5 * a);
      x.push_back(truth.back() + scale * (0.3 * b + 0.1));
      y.push_back(std::exp(2 * b));                     // long tail
      z.push_back(std::floor(3 * std::abs(a)) - 1000);  // steps
    }
  }
  Outcome outcome(std::size_t i) const {
    Outcome outcome;
    const auto tell = [&](const char* key, double value, std::optional<double> known = {}) {
      Observation observation;
      observation.of.key = key;
      observation.value = value;
      observation.truth = known;
      outcome.observations.push_back(observation);
    };
    tell("x", x[i], truth[i]);
    tell("y", y[i]);
    if (i % 97 == 5) {
      outcome.end = TrialEnd::Alarm;
      outcome.why = "no contact";
    } else {
      tell("z", z[i]);
    }
    return outcome;
  }
  std::shared_ptr<const Grid> grid(const Tolerance& tolerance) const {
    TrialSummary begin;
    for (std::size_t i = 0; i < first; ++i)
      begin.add(i, outcome(i));
    return gridOf(Findings(begin, nothing).kept(),
                  [&](const Characteristic& of) { return of.key == "x" ? std::optional(tolerance) : std::nullopt; });
  }
  /// Those that came to z.
  std::vector<double> whole(const std::vector<double>& values) const {
    std::vector<double> some;
    for (std::size_t i = 0; i < trials; ++i)
      if (i % 97 != 5) some.push_back(values[i]);
    return some;
  }
};

constexpr Tolerance limits{29.9, 30.1};

TrialSummary sumOf(const World& world, std::shared_ptr<const Grid> grid, std::size_t begin, std::size_t end) {
  TrialSummary sum(std::move(grid));
  for (std::size_t i = begin; i < end; ++i)
    sum.add(i, world.outcome(i));
  return sum;
}

class Sums : public ::testing::TestWithParam<double> {};

void expectNear(const Summary& found, const Summary& exact) {
  EXPECT_EQ(found.count, exact.count);
  EXPECT_NEAR(found.mean, exact.mean, 1e-9 * exact.deviation);
  EXPECT_NEAR(found.deviation, exact.deviation, 1e-8 * exact.deviation);
  EXPECT_EQ(found.minimum, exact.minimum);
  EXPECT_EQ(found.maximum, exact.maximum);
  const double error = found.quantileError;
  EXPECT_GT(error, 0);
  EXPECT_NEAR(found.median, exact.median, error);
  EXPECT_NEAR(found.symmetric->low, exact.symmetric->low, error);
  EXPECT_NEAR(found.symmetric->high, exact.symmetric->high, error);
  // Where it lies may change much with little; how wide it is may not.
  EXPECT_NEAR(found.shortest->high - found.shortest->low, exact.shortest->high - exact.shortest->low, 2 * error);
}

TEST_P(Sums, SayWhatAllValuesSay) {
  const World world(GetParam());
  const TrialSummary sum = sumOf(world, world.grid(limits), 0, trials);
  EXPECT_EQ(sum.size(), trials);
  EXPECT_GT(sum.regular(), trials * 9 / 10);
  const Findings found(sum, nothing);
  EXPECT_EQ(found.finished(), world.whole(world.x).size());
  expectNear(found.values(0, 0.95), summarize(world.x, 0.95));
  expectNear(found.values(1, 0.95), summarize(world.y, 0.95));
  expectNear(found.values(2, 0.95), summarize(world.whole(world.z), 0.95));
  std::vector<double> errors(trials);
  std::ranges::transform(world.x, world.truth, errors.begin(), std::minus{});
  expectNear(*found.errors(0, 0.95), summarize(errors, 0.95));
  // Of a normal distribution the ends of the interval are known to a thousandth of its standard deviation.
  EXPECT_LT(found.values(0, 0.95).quantileError, 1e-3 * found.values(0, 0.95).deviation);
  EXPECT_FALSE(found.errors(1, 0.95));
  EXPECT_NEAR(found.truths(0).mean, summarize(world.truth, 0.95).mean, 1e-9);
  EXPECT_NEAR(found.correlation(0, 1).value(), correlation(world.x, world.y).value(), 1e-8);
  EXPECT_NEAR(found.correlation(2, 1).value(), correlation(world.whole(world.y), world.whole(world.z)).value(), 1e-8);
  const auto counts = histogramOf(world.x).counts, sketched = found.histogram(0).counts;
  EXPECT_EQ(std::accumulate(sketched.begin(), sketched.end(), std::size_t{0}), trials);
  ASSERT_EQ(counts.size(), sketched.size());
  for (std::size_t i = 0; i < counts.size(); ++i)
    EXPECT_NEAR(static_cast<double>(sketched[i]), static_cast<double>(counts[i]), 0.002 * trials);
  const Risks risks = found.risks(0, limits), exact = risksOf(world.x, world.truth, limits, limits);
  EXPECT_EQ(risks.falselyAccepted, exact.falselyAccepted);
  EXPECT_EQ(risks.falselyRejected, exact.falselyRejected);
  EXPECT_EQ(risks.trulyWithin, exact.trulyWithin);
  const Tolerance zone{29.95, 30.05};
  const Risks guarded = found.guardedRisks(0, limits, zone), exactly = risksOf(world.x, world.truth, limits, zone);
  EXPECT_EQ(guarded.count, exactly.count);
  EXPECT_NEAR(guarded.producer, exactly.producer, 1e-3);
  EXPECT_NEAR(guarded.consumer, exactly.consumer, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Scatter, Sums, ::testing::Values(0.1, 1e-6));

TEST(TrialSums, AreTheSameBitsInAnyOrderAndThroughMessages) {
  const World world(0.1);
  const auto grid = world.grid(limits);
  const auto bits = [](const TrialSummary& sum) {
    const Findings found(sum, nothing);
    std::vector<double> numbers;
    for (const std::size_t i : {0, 1, 2}) {
      const Summary each = found.values(i, 0.9);
      numbers.insert(numbers.end(), {each.mean, each.deviation, each.median, each.symmetric->low, each.shortest->high});
      for (const std::size_t k : {0, 1})
        numbers.push_back(found.correlation(i, k).value());
    }
    return numbers;
  };
  const TrialSummary atOnce = sumOf(world, grid, 0, trials);
  for (const std::size_t parts : {2U, 3U, 7U}) {
    std::vector<std::string> messages;
    for (std::size_t part = 0; part < parts; ++part)
      messages.push_back(sumOf(world, grid, trials * part / parts, trials * (part + 1) / parts).message());
    for (const bool backwards : {false, true}) {
      if (backwards) std::ranges::reverse(messages);
      TrialSummary sum(grid);
      for (const std::string& message : messages)
        sum.merge(TrialSummary::read(message, grid));
      EXPECT_EQ(bits(sum), bits(atOnce)) << parts;
      EXPECT_EQ(sum.size(), trials);
    }
  }
}

/// Many results, a million trials: what a rank hands in grows with the cells, not with the trials.
TEST(TrialSums, AreShorterThanTheirValues) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr std::size_t results = 40, many = 20'000;
  const auto answered = [&] {
    Outcome outcome;
    for (std::size_t i = 0; i < results; ++i) {
      Observation observation;
      observation.of.key = std::to_string(i);
      observation.value = 10 + normal(random);
      outcome.observations.push_back(observation);
    }
    return outcome;
  };
  TrialSummary begin;
  for (std::size_t i = 0; i < first; ++i)
    begin.add(i, answered());
  TrialSummary sum(gridOf(Findings(begin, nothing).kept(), [](const Characteristic&) { return std::nullopt; }));
  std::size_t half = 0;
  for (std::size_t i = 0; i < many; ++i) {
    sum.add(first + i, answered());
    if (i + 1 == many / 2) half = sum.message().size();
  }
  const std::size_t whole = sum.message().size();
  EXPECT_LT(whole, many * results * 8 / 5);
  EXPECT_LT(whole, half * 9 / 5);
}

/// A value that no cell holds, a result that was not there before: such trials are kept whole.
TEST(TrialSums, KeepTrialsThatDoNotFit) {
  World world(0.1);
  const auto grid = world.grid(limits);
  world.x[900] = 1e9;
  TrialSummary sum = sumOf(world, grid, 0, 1000);
  const Findings found(sum, nothing);
  EXPECT_EQ(found.values(0, 0.9).maximum, 1e9);
  EXPECT_EQ(found.values(0, 0.9).count, 1000U);
  EXPECT_NEAR(found.values(0, 0.9).mean, 1e6 + 30 * 0.999, 1);
  // Also where the error of what does not fit is as small as any.
  world.truth[900] = 1e9;
  const TrialSummary right = sumOf(world, grid, 0, 1000);
  const Findings both(right, nothing);
  EXPECT_EQ(both.values(0, 0.9).maximum, 1e9);
  EXPECT_NEAR(both.values(0, 0.9).mean, 1e6 + 30 * 0.999, 1);
  Outcome more = world.outcome(1000);
  more.observations.back().of.key = "new";
  sum.add(1000, more);
  const Findings others(sum, nothing);
  ASSERT_EQ(others.characteristics().size(), 4U);
  EXPECT_EQ(others.count(3), 1U);
  EXPECT_EQ(others.values(3, 0.9).mean, world.z[1000]);
}

}  // namespace
}  // namespace probewright::study::testing
