#include "cycles/sinumerik/correction_strategy.hpp"

#include <cmath>

namespace probewright::cycles::sinumerik {
namespace {

/// Decimal numbers on a limit are within it, whatever their binary rounding.
constexpr double rounding = 1e-9;

bool exceeds(double value, double limit) { return std::abs(value) > limit + rounding; }
bool reaches(double value, double limit) { return std::abs(value) >= limit - rounding; }

}  // namespace

CorrectionDecision decideCorrection(double difference, const CorrectionBands& bands,
                                    const std::optional<WeightedMean>& mean) {
  CorrectionDecision decision;
  if (mean) decision.mean = mean->old;
  if (bands.dimensionalDifference > 0 && exceeds(difference, bands.dimensionalDifference)) {
    decision.toolWornOut = true;
    return decision;
  }
  const bool outOfTolerance = bands.tolerance && exceeds(difference, *bands.tolerance);
  if (outOfTolerance) {
    decision.size = difference > 0 ? CorrectionDecision::Size::Over : CorrectionDecision::Size::Under;
  }
  const bool large = outOfTolerance || (bands.meanRange > 0 && reaches(difference, bands.meanRange));
  double candidate = difference;
  if (mean && !large) {
    candidate = mean->old - (mean->old - difference) / mean->weight;
    decision.mean = decision.formed = candidate;
  }
  if (large || exceeds(candidate, bands.zeroOffsetRange)) {
    decision.correction = candidate;
    decision.corrects = true;
    if (mean) decision.mean = 0;
  }
  return decision;
}

}  // namespace probewright::cycles::sinumerik
