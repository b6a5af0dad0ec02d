#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "study/statistics.hpp"

/// Summaries of few and of many values, held against what JCGM 101, 7.7 says of a sorted list, place by place.
namespace probewright::study::testing {
namespace {

/// Values with or without ties.
std::vector<double> drawn(std::size_t count, bool ties, std::mt19937_64& random) {
  std::vector<double> values(count);
  for (double& value : values)
    value = ties ? static_cast<double>(random() % 5) : std::uniform_real_distribution<double>(-3, 9)(random);
  return values;
}

TEST(Summaries, AreThoseOfTheSortedList) {
  std::mt19937_64 random(101);
  for (std::size_t count = 1; count <= 60; ++count) {
    for (const bool ties : {false, true}) {
      for (const double coverage : {0.001, 0.5, 0.6827, 0.95, 0.99}) {
        SCOPED_TRACE(count);
        SCOPED_TRACE(coverage);
        const std::vector<double> values = drawn(count, ties, random);
        const Summary summary = summarize(values, coverage);
        std::vector<double> sorted = values;
        std::ranges::sort(sorted);
        const double n = static_cast<double>(count);
        const double mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / n;
        double squares = 0;
        for (const double value : sorted)
          squares += (value - mean) * (value - mean);
        EXPECT_EQ(summary.count, count);
        EXPECT_NEAR(summary.mean, mean, 1e-12);
        EXPECT_NEAR(summary.deviation, count > 1 ? std::sqrt(squares / (n - 1)) : 0, 1e-12);
        EXPECT_EQ(summary.minimum, sorted.front());
        EXPECT_EQ(summary.maximum, sorted.back());
        EXPECT_NEAR(summary.median, (sorted[(count - 1) / 2] + sorted[count / 2]) / 2, 1e-12);
        const auto q = static_cast<std::size_t>(std::floor(coverage * n + 0.5));
        const bool tooFew = q == 0 || q >= count;
        EXPECT_EQ(summary.symmetric.has_value(), !tooFew);
        EXPECT_EQ(summary.shortest.has_value(), !tooFew);
        if (tooFew || !summary.symmetric || !summary.shortest) continue;
        const std::size_t r = (count - q) % 2 == 0 ? (count - q) / 2 : (count - q + 1) / 2;
        EXPECT_EQ(summary.symmetric->low, sorted[r - 1]);
        EXPECT_EQ(summary.symmetric->high, sorted[r + q - 1]);
        std::size_t best = 0;
        for (std::size_t i = 0; i + q < count; ++i)
          if (sorted[i + q] - sorted[i] < sorted[best + q] - sorted[best]) best = i;
        EXPECT_EQ(summary.shortest->low, sorted[best]);
        EXPECT_EQ(summary.shortest->high, sorted[best + q]);
      }
    }
  }
}

TEST(Summaries, OfNothingHaveNothing) {
  const Summary summary = summarize(std::vector<double>{}, 0.95);
  EXPECT_EQ(summary.count, 0U);
  EXPECT_FALSE(summary.symmetric || summary.shortest);
  const Summary missing = summarize(std::vector<double>{std::nan(""), 2, std::nan("")}, 0.95);
  EXPECT_EQ(missing.count, 1U);
  EXPECT_EQ(missing.mean, 2);
}

/// A bin holds its lower end, the last one its upper end as well; no bin is wider than 2 IQR / cbrt(n) but where fifty
/// do not reach.
TEST(Summaries, HistogramsCountEveryValueOnce) {
  std::mt19937_64 random(102);
  for (std::size_t count = 1; count <= 300; count = count * 3 / 2 + 1) {
    for (const bool ties : {false, true}) {
      std::vector<double> values = drawn(count, ties, random);
      const Histogram histogram = histogramOf(values);
      std::ranges::sort(values);
      const std::size_t bins = histogram.counts.size();
      ASSERT_GE(bins, 1U);
      EXPECT_LE(bins, 50U);
      EXPECT_EQ(histogram.low, values.front());
      EXPECT_NEAR(histogram.low + static_cast<double>(bins) * histogram.width, values.back(), 1e-9);
      const auto quantile = [&](double p) {
        const double place = p * static_cast<double>(count - 1), below = std::floor(place);
        const auto at = static_cast<std::size_t>(below);
        return values[at] + (place - below) * (values[std::min(at + 1, count - 1)] - values[at]);
      };
      const double widest = 2 * (quantile(0.75) - quantile(0.25)) / std::cbrt(static_cast<double>(count));
      if (widest > 0 && bins < 50) {
        EXPECT_LE(histogram.width, widest + 1e-12);
        EXPECT_GT(histogram.width * static_cast<double>(bins), (static_cast<double>(bins) - 1) * widest - 1e-9);
      }
      std::vector<std::size_t> counted(bins);
      for (const double value : values) {
        std::size_t bin = bins - 1;
        while (bin > 0 && value < histogram.low + static_cast<double>(bin) * histogram.width - 1e-12)
          --bin;
        ++counted[bin];
      }
      EXPECT_EQ(histogram.counts, counted) << count;
    }
  }
}

}  // namespace
}  // namespace probewright::study::testing
