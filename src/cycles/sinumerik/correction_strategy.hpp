#pragma once

#include <optional>

/// Whether and by how much a measured difference corrects a tool: bands about the set value, weighted mean.
namespace probewright::cycles::sinumerik {

/// Limits of a tool correction. All are compared with the size of the difference; 0 switches a band off, except
/// the zero offset range, below which nothing is corrected anyway.
struct CorrectionBands {
  double zeroOffsetRange = 0;        ///< S_TZL: smaller differences are random
  double meanRange = 0;              ///< S_TMV: 2/3 of the tolerance; from here on the whole difference corrects
  double dimensionalDifference = 0;  ///< S_TDIF: from here on the tool is worn out, nothing is corrected
  std::optional<double> tolerance = std::nullopt;  ///< half the width of the workpiece tolerance about its middle
};

/// A sliding mean over several workpieces.
struct WeightedMean {
  double old = 0;     ///< the mean so far, S_EVNUM
  double weight = 1;  ///< k, S_K: the new difference counts 1/k; > 0
};

struct CorrectionDecision {
  enum class Size { Within, Over, Under };
  double correction = 0;  ///< to be corrected; 0: nothing
  bool corrects = false;
  std::optional<double> mean;    ///< what the memory of the mean holds from now on
  std::optional<double> formed;  ///< the mean with this difference in it; none where the whole difference counts
  Size size = Size::Within;      ///< against the tolerance
  bool toolWornOut = false;      ///< the dimensional difference is exceeded
};

/// `difference`: actual minus set value, empirical value taken off. The mean is
///   new = old - (old - difference) / k;
/// once it exceeds the zero offset range it corrects and starts again from 0.
CorrectionDecision decideCorrection(double difference, const CorrectionBands& bands,
                                    const std::optional<WeightedMean>& mean);

}  // namespace probewright::cycles::sinumerik
