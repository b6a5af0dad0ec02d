#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

/// Least squares with Ceres, for problems of a few parameters whose derivatives nobody wants to write down.
namespace probewright::kinematics {

/// Residuals from parameters. All parameters must be of the same order: a step of 1e-6 must mean as much for each.
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd& parameters)>;

struct Minimum {
  Eigen::VectorXd parameters;
  Eigen::VectorXd residuals;
  /// (J^T J)^-1 at the minimum: the covariance of the parameters where each residual has the standard deviation 1.
  Eigen::MatrixXd cofactors;
};

/// The derivatives of the residuals, by central differences.
Eigen::MatrixXd jacobian(const Residuals& residuals, const Eigen::VectorXd& at);

/// Levenberg-Marquardt from `start`. Nothing if it does not converge, or if the residuals leave a parameter
/// undetermined.
std::optional<Minimum> minimise(const Residuals& residuals, const Eigen::VectorXd& start);

}  // namespace probewright::kinematics
