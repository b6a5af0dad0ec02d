#pragma once

#include <span>

#include "base/diagnostic.hpp"

/// Measurement uncertainty after the GUM (JCGM 100:2008). Standard uncertainties carry the unit of their quantity.
namespace probewright::metrology {

/// Repeated observations of one quantity (GUM 4.2).
struct TypeA {
  double mean = 0;
  double standardDeviation = 0;    ///< of one observation, s
  double standardUncertainty = 0;  ///< of the mean, s / root(n)
  int degreesOfFreedom = 0;        ///< n - 1
};

/// Fails on fewer than 2 observations.
Result<TypeA> typeA(std::span<const double> observations);

}  // namespace probewright::metrology
