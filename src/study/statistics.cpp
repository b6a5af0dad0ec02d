#include "study/statistics.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>

namespace probewright::study {

namespace {

constexpr std::size_t mostBins = 50;

/// Values by their place in ascending order, counted from 0.
class Places {
public:
  explicit Places(const Counted& values) : values_(values) {
    for (const auto& [value, count] : values) {
      begins_.push_back(size_);
      size_ += count;
    }
  }
  std::uint64_t size() const { return size_; }
  std::uint64_t begin(std::size_t i) const { return begins_[i]; }
  double operator[](std::uint64_t place) const {
    const auto after = std::ranges::upper_bound(begins_, place);
    return values_[static_cast<std::size_t>(after - begins_.begin()) - 1].first;
  }
  double quantile(double p) const {
    const double place = p * static_cast<double>(size_ - 1);
    const auto below = static_cast<std::uint64_t>(place);
    const double low = (*this)[below], high = (*this)[std::min(below + 1, size_ - 1)];
    return low + (place - static_cast<double>(below)) * (high - low);
  }

private:
  const Counted& values_;
  std::vector<std::uint64_t> begins_;
  std::uint64_t size_ = 0;
};

Counted countedOf(std::span<const double> values) {
  std::vector<double> sorted = present(values);
  std::ranges::sort(sorted);
  Counted counted;
  counted.reserve(sorted.size());
  for (const double value : sorted)
    counted.emplace_back(value, 1);
  return counted;
}

}  // namespace

std::vector<double> present(std::span<const double> values) {
  std::vector<double> there;
  there.reserve(values.size());
  std::ranges::copy_if(values, std::back_inserter(there), [](double value) { return !std::isnan(value); });
  return there;
}

void Moments::add(const Moments& other) {
  if (other.count == 0) return;
  const double sum = count + other.count, apart = other.mean - mean;
  squares += other.squares + apart * apart * count * other.count / sum;
  mean = count == 0 ? other.mean : mean + apart * other.count / sum;
  count = sum;
}

double Moments::deviation() const { return count > 1 ? std::sqrt(squares / (count - 1)) : 0; }

/// Mean first, then the deviations from it: no digits are lost where the mean is large.
Moments momentsOf(std::span<const double> values) {
  Moments moments;
  moments.count = static_cast<double>(values.size());
  if (values.empty()) return moments;
  double sum = 0;
  for (const double value : values)
    sum += value - values.front();
  moments.mean = values.front() + sum / moments.count;
  for (const double value : values)
    moments.squares += (value - moments.mean) * (value - moments.mean);
  return moments;
}

Summary summarize(std::span<const double> values, double coverage) {
  return summarize(countedOf(values), momentsOf(present(values)), coverage);
}

Summary summarize(const Counted& values, const Moments& moments, double coverage) {
  Summary summary;
  const Places sorted(values);
  const std::uint64_t count = sorted.size();
  summary.count = static_cast<std::size_t>(count);
  if (count == 0) return summary;
  summary.mean = moments.mean;
  summary.deviation = moments.deviation();
  summary.minimum = values.front().first;
  summary.maximum = values.back().first;
  summary.median = sorted.quantile(0.5);
  // JCGM 101, 7.7: q = pM, rounded; r = (M - q) / 2, rounded up; places count from 1 there.
  const auto q = static_cast<std::uint64_t>(coverage * static_cast<double>(count) + 0.5);
  if (q >= count || q == 0) return summary;
  const std::uint64_t r = (count - q + 1) / 2;
  if (r >= 1 && r + q <= count) summary.symmetric = {sorted[r - 1], sorted[r + q - 1]};
  // The upper end goes up with the lower one; of values that are the same the first is the best.
  Interval best{sorted[0], sorted[q]};
  std::size_t upper = 0;
  for (std::size_t lower = 0; lower < values.size() && sorted.begin(lower) + q < count; ++lower) {
    const std::uint64_t place = sorted.begin(lower) + q;
    while (upper + 1 < values.size() && sorted.begin(upper + 1) <= place)
      ++upper;
    const Interval here{values[lower].first, values[upper].first};
    if (here.high - here.low < best.high - best.low) best = here;
  }
  summary.shortest = best;
  return summary;
}

Histogram histogramOf(std::span<const double> values) { return histogramOf(countedOf(values)); }

Histogram histogramOf(const Counted& values) {
  Histogram histogram;
  if (values.empty()) return histogram;
  const Places sorted(values);
  const double range = values.back().first - values.front().first;
  histogram.low = values.front().first;
  const double middleHalf = sorted.quantile(0.75) - sorted.quantile(0.25);
  const double wanted = 2 * middleHalf / std::cbrt(static_cast<double>(sorted.size()));
  std::size_t bins = 1;
  if (range > 0) bins = wanted > 0 ? static_cast<std::size_t>(std::min(range / wanted, 1e6)) + 1 : mostBins;
  bins = std::min(bins, mostBins);
  histogram.width = range / static_cast<double>(bins);
  histogram.counts.assign(bins, 0);
  for (const auto& [value, count] : values) {
    const double place = range > 0 ? (value - histogram.low) / range * static_cast<double>(bins) : 0;
    histogram.counts[std::min(static_cast<std::size_t>(place), bins - 1)] += count;
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
  const Moments ofX = momentsOf(x), ofY = momentsOf(y);
  if (!(ofX.squares > 0) || !(ofY.squares > 0)) return std::nullopt;
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += (x[i] - ofX.mean) * (y[i] - ofY.mean);
  return std::clamp(sum / std::sqrt(ofX.squares * ofY.squares), -1.0, 1.0);
}

Interval probability(std::size_t hits, std::size_t trials, double confidence) {
  if (trials == 0) return {0, 1};
  const double k = static_cast<double>(hits), n = static_cast<double>(trials), tail = (1 - confidence) / 2;
  return {hits == 0 ? 0 : boost::math::ibeta_inv(k, n - k + 1, tail),
          hits == trials ? 1 : boost::math::ibeta_inv(k + 1, n - k, 1 - tail)};
}

}  // namespace probewright::study
