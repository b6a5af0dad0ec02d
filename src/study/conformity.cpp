#include "study/conformity.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace probewright::study {

double conformanceProbability(double value, double uncertainty, const Tolerance& tolerance) {
  if (!(uncertainty > 0)) return tolerance.contains(value) ? 1 : 0;
  const boost::math::normal distribution(value, uncertainty);
  // From the tail that is the smaller, so that small risks keep their digits.
  const double below = tolerance.lower ? boost::math::cdf(distribution, *tolerance.lower) : 0;
  const double above = tolerance.upper ? boost::math::cdf(boost::math::complement(distribution, *tolerance.upper)) : 0;
  return std::clamp(1 - below - above, 0.0, 1.0);
}

Decision decide(double value, double guardBand, const Tolerance& tolerance) {
  const auto zone = acceptanceZone(tolerance, guardBand);
  if (zone && zone->contains(value)) return Decision::Conforms;
  const bool tooLow = tolerance.lower && value < *tolerance.lower - guardBand;
  const bool tooHigh = tolerance.upper && value > *tolerance.upper + guardBand;
  return tooLow || tooHigh ? Decision::DoesNotConform : Decision::Undecided;
}

std::string nameOf(Decision decision) {
  switch (decision) {
    case Decision::Conforms:
      return "conforms";
    case Decision::Undecided:
      return "undecided";
    case Decision::DoesNotConform:
      return "does not conform";
  }
  return "undecided";
}

std::optional<Tolerance> acceptanceZone(const Tolerance& tolerance, double guardBand) {
  Tolerance zone = tolerance;
  if (zone.lower) *zone.lower += guardBand;
  if (zone.upper) *zone.upper -= guardBand;
  if (zone.lower && zone.upper && *zone.lower > *zone.upper) return std::nullopt;
  return zone;
}

Risks risksOf(std::span<const double> measured, std::span<const double> truth, const Tolerance& tolerance,
              const Tolerance& acceptance) {
  Risks risks;
  for (std::size_t i = 0; i < std::min(measured.size(), truth.size()); ++i) {
    if (std::isnan(measured[i]) || std::isnan(truth[i])) continue;
    const bool within = tolerance.contains(truth[i]), accepted = acceptance.contains(measured[i]);
    ++risks.count;
    risks.trulyWithin += within ? 1 : 0;
    risks.accepted += accepted ? 1 : 0;
    risks.falselyAccepted += accepted && !within ? 1 : 0;
    risks.falselyRejected += !accepted && within ? 1 : 0;
  }
  risks.add({});
  return risks;
}

void Risks::add(const Risks& other) {
  count += other.count;
  trulyWithin += other.trulyWithin;
  accepted += other.accepted;
  falselyAccepted += other.falselyAccepted;
  falselyRejected += other.falselyRejected;
  if (count == 0) return;
  consumer = static_cast<double>(falselyAccepted) / static_cast<double>(count);
  producer = static_cast<double>(falselyRejected) / static_cast<double>(count);
  consumerInterval = probability(falselyAccepted, count);
  producerInterval = probability(falselyRejected, count);
}

}  // namespace probewright::study
