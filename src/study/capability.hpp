#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/diagnostic.hpp"

/// Whether a gauge is good enough for a tolerance: type-1 study and gauge R&R (AIAG MSA, 4th edition; VDA 5).
namespace probewright::study {

/// One part of known size, measured again and again.
struct Type1 {
  std::size_t count = 0;
  double mean = 0, deviation = 0, bias = 0;
  double cg = 0;   ///< 0.2 T / (6 s); infinite without scatter
  double cgk = 0;  ///< (0.1 T - |bias|) / (3 s)
};
/// Fails on fewer than 2 values or without a tolerance above 0.
Result<Type1> type1(std::span<const double> values, double reference, double tolerance);

/// A table of analysis of variance: parts, appraisers, their interaction, repeats.
struct GaugeRR {
  std::size_t parts = 0, appraisers = 0, repeats = 0;
  struct Row {
    double sumOfSquares = 0;
    double degreesOfFreedom = 0;
    double meanSquare() const { return degreesOfFreedom > 0 ? sumOfSquares / degreesOfFreedom : 0; }
  };
  Row part, appraiser, interaction, repeat, total;
  bool pooled = false;  ///< the interaction is not significant (p above 0.25) and counts as repeatability
  // Standard deviations.
  double repeatability = 0;                                                           ///< EV
  double reproducibility = 0;                                                         ///< AV, with the interaction
  double gauge = 0;                                                                   ///< GRR
  double partVariation = 0;                                                           ///< PV
  double totalVariation = 0;                                                          ///< TV
  double ofTotal() const { return totalVariation > 0 ? gauge / totalVariation : 0; }  ///< %GRR / 100
  std::optional<double> ofTolerance;                                                  ///< 6 GRR / T
  int distinctCategories = 0;                                                         ///< ndc: 1.41 PV / GRR, cut
};
/// `values`: part by part, within a part appraiser by appraiser, within these the repeats. Fails unless there are at
/// least 2 of each and all values are there.
Result<GaugeRR> gaugeRR(std::span<const double> values, std::size_t parts, std::size_t appraisers, std::size_t repeats,
                        std::optional<double> tolerance);

}  // namespace probewright::study
