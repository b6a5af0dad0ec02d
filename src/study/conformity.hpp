#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/statistics.hpp"

/// What a measured value with an uncertainty says of a tolerance: JCGM 106:2012, ISO 14253-1:2017.
namespace probewright::study {

/// Limits of a tolerance; either may be missing, not both.
struct Tolerance {
  std::optional<double> lower, upper;
  bool contains(double value) const { return (!lower || value >= *lower) && (!upper || value <= *upper); }
};

/// The probability that a quantity measured as `value` with the standard uncertainty `uncertainty` is within, for a
/// normal distribution (JCGM 106, 7.2). Without uncertainty it is 0 or 1.
double conformanceProbability(double value, double uncertainty, const Tolerance& tolerance);

/// What may be said of a measured value by the decision rule of ISO 14253-1.
enum class Decision {
  Conforms,       ///< within by more than the guard band
  Undecided,      ///< nearer to a limit than the guard band
  DoesNotConform  ///< beyond by more than the guard band
};
Decision decide(double value, double guardBand, const Tolerance& tolerance);
/// "conforms", "undecided", "does not conform".
std::string nameOf(Decision decision);

/// The zone in which a measured value proves conformity: the tolerance less a guard band at each limit. Nothing if the
/// guard bands leave none.
std::optional<Tolerance> acceptanceZone(const Tolerance& tolerance, double guardBand);

/// How often measured values and true values disagree on `tolerance` in a population of items (global risks of
/// JCGM 106, 9.5), where the measured value counts as it is or within `acceptance`.
struct Risks {
  std::size_t count = 0;
  std::size_t trulyWithin = 0, accepted = 0;
  std::size_t falselyAccepted = 0, falselyRejected = 0;
  double consumer = 0, producer = 0;            ///< shares of all items
  Interval consumerInterval, producerInterval;  ///< 95 %, Clopper and Pearson

  /// Those of other items.
  void add(const Risks& other);
};
Risks risksOf(std::span<const double> measured, std::span<const double> truth, const Tolerance& tolerance,
              const Tolerance& acceptance);

}  // namespace probewright::study
