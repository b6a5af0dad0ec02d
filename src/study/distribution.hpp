#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/diagnostic.hpp"

/// How a quantity that is not known exactly may be distributed: the distributions of JCGM 101:2008, 6.4, and those that
/// a workshop needs besides.
namespace probewright::study {

struct Normal {
  double mean = 0, deviation = 1;
};
struct Uniform {
  double minimum = 0, maximum = 1;
};
struct Triangular {
  double minimum = -1, mode = 0, maximum = 1;
};
/// Of a value that swings: the arcsine distribution.
struct UShaped {
  double minimum = -1, maximum = 1;
};
/// Scaled and shifted t-distribution: what few observations tell of their mean.
struct Student {
  double mean = 0, scale = 1, degreesOfFreedom = 1;
};
/// A rectangle whose limits are themselves known to +-`inexactness` only (JCGM 101, 6.4.3: curvilinear trapezoid).
struct InexactLimits {
  double minimum = -1, maximum = 1, inexactness = 0;
};
struct Discrete {
  std::vector<double> values;
  std::vector<double> weights;  ///< as many, not negative, some positive
};
/// Each of the values alike likely: what was observed.
struct Samples {
  std::shared_ptr<const std::vector<double>> values;
};

/// A distribution to draw from.
class Distribution {
public:
  using Kind = std::variant<Normal, Uniform, Triangular, UShaped, Student, InexactLimits, Discrete, Samples>;

  /// Fails where the parameters make no distribution: a deviation that is not positive, limits in the wrong order.
  static Result<Distribution> make(Kind kind);
  /// The same, without what lies beyond `between`. Of normal, uniform, triangular, U-shaped and Student's distributions
  /// only; at least one in 1e9 must lie within.
  static Result<Distribution> truncated(Kind kind, std::pair<double, double> between);

  /// The value that two numbers in (0, 1) stand for. All but InexactLimits take the first only, and then it is the
  /// quantile.
  double value(const std::array<double, 2>& uniforms) const;
  /// The value for a draw of the standard normal distribution: its place among the normal distribution's values is that
  /// among these. For what is correlated (a Gaussian copula).
  double valueOfScore(double score) const;

  double mean() const { return mean_; }
  double standardDeviation() const { return deviation_; }
  /// The value to compute with where one is wanted: the mean; of discrete values the most likely.
  double estimate() const;
  /// "normal", "U-shaped"...
  std::string name() const;
  bool isTruncated() const { return low_ > 0 || high_ < 1; }
  const Kind& kind() const { return kind_; }

private:
  explicit Distribution(Kind kind) : kind_(std::move(kind)) {}
  double quantile(double p) const;
  double probabilityBelow(double value) const;
  void findMoments();

  Kind kind_;
  double low_ = 0, high_ = 1;       ///< the part of the untruncated distribution that is left, as probabilities
  std::vector<double> cumulative_;  ///< of discrete values
  double mean_ = 0, deviation_ = 0;
};

}  // namespace probewright::study
