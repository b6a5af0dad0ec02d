#include "study/statistics.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>

namespace probewright::study {

namespace {

constexpr std::size_t mostBins = 50;

/// Mean first, then the deviations from it: no digits are lost where the mean is large.
std::pair<double, double> meanAndDeviation(std::span<const double> values) {
  const double count = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values)
    sum += value - values.front();
  const double mean = values.front() + sum / count;
  double squares = 0;
  for (const double value : values)
    squares += (value - mean) * (value - mean);
  return {mean, values.size() > 1 ? std::sqrt(squares / (count - 1)) : 0};
}

double quantileOf(std::span<const double> sorted, double p) {
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

std::vector<double> present(std::span<const double> values) {
  std::vector<double> there;
  there.reserve(values.size());
  std::ranges::copy_if(values, std::back_inserter(there), [](double value) { return !std::isnan(value); });
  return there;
}

Summary summarize(std::span<const double> values, double coverage) {
  std::vector<double> sorted = present(values);
  Summary summary;
  summary.count = sorted.size();
  if (sorted.empty()) return summary;
  std::tie(summary.mean, summary.deviation) = meanAndDeviation(sorted);
  std::ranges::sort(sorted);
  summary.minimum = sorted.front();
  summary.maximum = sorted.back();
  summary.median = quantileOf(sorted, 0.5);
  // JCGM 101, 7.7: q = pM, rounded; r = (M - q) / 2, rounded up; places count from 1 there.
  const auto count = sorted.size();
  const auto q = static_cast<std::size_t>(coverage * static_cast<double>(count) + 0.5);
  if (q >= count || q == 0) return summary;
  const std::size_t r = (count - q + 1) / 2;
  if (r >= 1 && r + q <= count) summary.symmetric = {sorted[r - 1], sorted[r + q - 1]};
  std::size_t best = 0;
  for (std::size_t i = 1; i + q < count; ++i)
    if (sorted[i + q] - sorted[i] < sorted[best + q] - sorted[best]) best = i;
  summary.shortest = {sorted[best], sorted[best + q]};
  return summary;
}

Histogram histogramOf(std::span<const double> values) {
  std::vector<double> sorted = present(values);
  Histogram histogram;
  if (sorted.empty()) return histogram;
  std::ranges::sort(sorted);
  const double range = sorted.back() - sorted.front();
  histogram.low = sorted.front();
  const double middleHalf = quantileOf(sorted, 0.75) - quantileOf(sorted, 0.25);
  const double wanted = 2 * middleHalf / std::cbrt(static_cast<double>(sorted.size()));
  std::size_t bins = 1;
  if (range > 0) bins = wanted > 0 ? static_cast<std::size_t>(std::min(range / wanted, 1e6)) + 1 : mostBins;
  bins = std::min(bins, mostBins);
  histogram.width = range / static_cast<double>(bins);
  histogram.counts.assign(bins, 0);
  for (const double value : sorted) {
    const double place = range > 0 ? (value - histogram.low) / range * static_cast<double>(bins) : 0;
    ++histogram.counts[std::min(static_cast<std::size_t>(place), bins - 1)];
  }
  return histogram;
}

std::optional<double> correlation(std::span<const double> a, std::span<const double> b) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    x.push_back(a[i]);
    y.push_back(b[i]);
  }
  if (x.size() < 2) return std::nullopt;
  const auto [meanX, deviationX] = meanAndDeviation(x);
  const auto [meanY, deviationY] = meanAndDeviation(y);
  if (!(deviationX > 0) || !(deviationY > 0)) return std::nullopt;
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += (x[i] - meanX) * (y[i] - meanY);
  return std::clamp(sum / (static_cast<double>(x.size() - 1) * deviationX * deviationY), -1.0, 1.0);
}

Interval probability(std::size_t hits, std::size_t trials, double confidence) {
  if (trials == 0) return {0, 1};
  const double k = static_cast<double>(hits), n = static_cast<double>(trials), tail = (1 - confidence) / 2;
  return {hits == 0 ? 0 : boost::math::ibeta_inv(k, n - k + 1, tail),
          hits == trials ? 1 : boost::math::ibeta_inv(k + 1, n - k, 1 - tail)};
}

}  // namespace probewright::study
