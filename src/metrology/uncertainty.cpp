#include "metrology/uncertainty.hpp"

#include <Eigen/Core>
#include <cmath>

namespace probewright::metrology {

Result<TypeA> typeA(std::span<const double> observations) {
  if (observations.size() < 2)
    return fail("a standard deviation needs at least 2 observations", "repeat the measurement");
  const Eigen::Map<const Eigen::VectorXd> values(observations.data(), static_cast<Eigen::Index>(observations.size()));
  const double count = static_cast<double>(observations.size());
  TypeA result;
  result.mean = values.mean();
  result.standardDeviation = (values.array() - result.mean).matrix().norm() / std::sqrt(count - 1);
  result.standardUncertainty = result.standardDeviation / std::sqrt(count);
  result.degreesOfFreedom = static_cast<int>(observations.size()) - 1;
  return result;
}

}  // namespace probewright::metrology
