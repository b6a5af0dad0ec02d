#include "metrology/uncertainty.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace probewright::metrology {

namespace {
tl::unexpected<Diagnostic> tooFew() {
  return fail("a standard deviation needs at least 2 observations", "repeat the measurement");
}
}  // namespace

Result<TypeA> typeA(std::span<const double> observations) {
  if (observations.size() < 2) return tooFew();
  const Eigen::Map<const Eigen::VectorXd> values(observations.data(), static_cast<Eigen::Index>(observations.size()));
  const double count = static_cast<double>(observations.size());
  TypeA result;
  result.mean = values.mean();
  result.standardDeviation = (values.array() - result.mean).matrix().norm() / std::sqrt(count - 1);
  result.standardUncertainty = result.standardDeviation / std::sqrt(count);
  result.degreesOfFreedom = static_cast<int>(observations.size()) - 1;
  return result;
}

Result<double> coverageFactor(double confidence, double degreesOfFreedom) {
  if (!(confidence > 0 && confidence < 1)) {
    return fail("a confidence level lies between 0 and 1", "write 0.95 for 95 percent");
  }
  if (!(degreesOfFreedom > 0)) {
    return fail("without degrees of freedom there is no confidence interval", "repeat the measurement");
  }
  const boost::math::students_t_distribution<double> student(degreesOfFreedom);
  return boost::math::quantile(boost::math::complement(student, (1 - confidence) / 2));
}

Result<double> confidenceInterval(const TypeA& observed, double confidence) {
  return coverageFactor(confidence, observed.degreesOfFreedom).map([&](double factor) {
    return factor * observed.standardUncertainty;
  });
}

double rectangular(double halfWidth) { return std::abs(halfWidth) / std::sqrt(3.0); }

Combined combine(std::span<const Contribution> contributions) {
  double variance = 0;
  for (const Contribution& c : contributions)
    variance += std::pow(c.sensitivity * c.standardUncertainty, 2);
  double unsureness = 0;
  for (const Contribution& c : contributions) {
    if (c.degreesOfFreedom > 0) unsureness += std::pow(c.sensitivity * c.standardUncertainty, 4) / c.degreesOfFreedom;
  }
  return {std::sqrt(variance),
          unsureness > 0 ? variance * variance / unsureness : std::numeric_limits<double>::infinity()};
}

Eigen::MatrixXd propagate(const Eigen::Ref<const Eigen::MatrixXd>& jacobian,
                          const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  return jacobian * covariance * jacobian.transpose();
}

Result<ObservedTogether> observedTogether(const Eigen::Ref<const Eigen::MatrixXd>& observations) {
  if (observations.rows() < 2) return tooFew();
  const double count = static_cast<double>(observations.rows());
  const Eigen::VectorXd means = observations.colwise().mean().transpose();
  const Eigen::MatrixXd centred = observations.rowwise() - means.transpose();
  return ObservedTogether{means, centred.transpose() * centred / (count * (count - 1))};
}

}  // namespace probewright::metrology
