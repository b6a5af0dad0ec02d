#include "study/adaptive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace probewright::study {

double numericalTolerance(double standardUncertainty, int digits) {
  if (!(standardUncertainty > 0)) return 0;
  // As c * 10^l with c of so many digits; rounding may carry into one digit more.
  int exponent = static_cast<int>(std::floor(std::log10(standardUncertainty))) - (digits - 1);
  if (std::round(standardUncertainty / std::pow(10, exponent)) >= std::pow(10, digits)) ++exponent;
  return 0.5 * std::pow(10, exponent);
}

void Stability::add(std::span<const double> block) { add(summarize(block, coverage_)); }

void Stability::add(const Summary& block) {
  if (block.count > 0) blocks_.push_back(block);
}

bool Stability::stable() const { return excess() <= 1; }

double Stability::excess() const {
  const double count = static_cast<double>(blocks_.size());
  if (blocks_.size() < 2) return std::numeric_limits<double>::infinity();
  // The uncertainty of all values, from those of the blocks, which are of one size.
  double uncertainty = 0;
  for (const Summary& block : blocks_)
    uncertainty += block.deviation * block.deviation / count;
  uncertainty = std::sqrt(uncertainty);
  const double tolerance = numericalTolerance(uncertainty, digits_);
  const auto spread = [&](const auto& of) {
    double mean = 0;
    for (const Summary& block : blocks_)
      mean += of(block) / count;
    double squares = 0;
    for (const Summary& block : blocks_)
      squares += std::pow(of(block) - mean, 2);
    return 2 * std::sqrt(squares / (count * (count - 1)));
  };
  const double worst =
      std::max({spread([](const Summary& s) { return s.mean; }), spread([](const Summary& s) { return s.deviation; }),
                spread([](const Summary& s) { return s.symmetric ? s.symmetric->low : s.minimum; }),
                spread([](const Summary& s) { return s.symmetric ? s.symmetric->high : s.maximum; })});
  // Below that they differ by the last digits of computing only, which no number of trials makes stable.
  constexpr double lastDigits = 1e-12;
  double largest = 1;
  for (const Summary& block : blocks_)
    largest = std::max(largest, std::abs(block.mean));
  if (worst <= lastDigits * largest) return 0;
  return tolerance > 0 ? worst / tolerance : std::numeric_limits<double>::infinity();
}

}  // namespace probewright::study
