#pragma once

#include <Eigen/Core>
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

/// The factor t for which a mean lies within +-t standard uncertainties with probability `confidence` (two-sided
/// Student quantile); `degreesOfFreedom` may be fractional or infinite. 0 < confidence < 1, degreesOfFreedom > 0.
Result<double> coverageFactor(double confidence, double degreesOfFreedom);

/// Half the width of the confidence interval about the mean.
Result<double> confidenceInterval(const TypeA& observed, double confidence = 0.95);

/// One contribution to a result: standard uncertainty of an input, how strongly the result follows it, and how well the
/// uncertainty itself is known.
struct Contribution {
  double standardUncertainty = 0;
  double sensitivity = 1;
  double degreesOfFreedom = 0;  ///< 0: known exactly (infinite)
};

/// Standard uncertainty of an input known to lie within +-`halfWidth`, all values alike likely (GUM 4.3.7).
double rectangular(double halfWidth);

struct Combined {
  double standardUncertainty = 0;
  double effectiveDegreesOfFreedom = 0;  ///< Welch-Satterthwaite (GUM G.4); infinity if all contributions are exact
  double expanded(double coverage = 2) const { return coverage * standardUncertainty; }
};

/// Root of the sum of squares of independent contributions (GUM 5.1).
Combined combine(std::span<const Contribution> contributions);

/// Covariance of y = f(x): J C J^T, with J the derivatives dy/dx (GUM H.2.3). The columns of J match C.
Eigen::MatrixXd propagate(const Eigen::Ref<const Eigen::MatrixXd>& jacobian,
                          const Eigen::Ref<const Eigen::MatrixXd>& covariance);

/// Means and their covariance of quantities observed together: a row an observation, a column a quantity (GUM 5.2.3).
/// Fails on fewer than 2 rows.
struct ObservedTogether {
  Eigen::VectorXd means;
  Eigen::MatrixXd covarianceOfMeans;
};
Result<ObservedTogether> observedTogether(const Eigen::Ref<const Eigen::MatrixXd>& observations);

}  // namespace probewright::metrology
