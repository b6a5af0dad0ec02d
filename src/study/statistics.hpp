#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

/// What a sample tells of its distribution (JCGM 101:2008, 7.5 to 7.7). Values that are NaN do not count.
namespace probewright::study {

struct Interval {
  double low = 0, high = 0;
};

struct Histogram {
  double low = 0, width = 0;        ///< of the first bin; of each bin
  std::vector<std::size_t> counts;  ///< the last bin holds its upper end
};

struct Summary {
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;  ///< of the values: the standard uncertainty; 0 of one value
  double minimum = 0, maximum = 0, median = 0;
  std::optional<Interval> symmetric;  ///< as many values below as above
  std::optional<Interval> shortest;
  /// By how much median and ends of the intervals may be wrong because values were counted in cells; 0: not at all.
  double quantileError = 0;
};

/// Values in ascending order, each with how often it came.
using Counted = std::vector<std::pair<double, std::uint64_t>>;

/// Count, mean and sum of the squares of deviations from it.
struct Moments {
  double count = 0, mean = 0, squares = 0;
  void add(const Moments& other);
  double deviation() const;
};
Moments momentsOf(std::span<const double> values);

/// The values that are there.
std::vector<double> present(std::span<const double> values);

/// Intervals for `coverage`; none where the sample is too small to have one.
Summary summarize(std::span<const double> values, double coverage);
Summary summarize(const Counted& values, const Moments& moments, double coverage);

/// At most 50 bins of equal width, by the rule of Freedman and Diaconis.
Histogram histogramOf(std::span<const double> values);
Histogram histogramOf(const Counted& values);

/// Pearson's coefficient of the pairs that are both there; nothing if fewer than 2 or one of the two stands still.
std::optional<double> correlation(std::span<const double> a, std::span<const double> b);

/// The probability of what came `hits` times of `trials`, between the limits of Clopper and Pearson.
Interval probability(std::size_t hits, std::size_t trials, double confidence = 0.95);

}  // namespace probewright::study
