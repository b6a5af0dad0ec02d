#include "kinematics/minimum.hpp"

#include <ceres/ceres.h>

#include <Eigen/SVD>
#include <utility>
#include <vector>

namespace probewright::kinematics {

namespace {

/// All residuals as one cost, with the derivatives of jacobian().
class WholeCost : public ceres::CostFunction {
public:
  WholeCost(const Residuals& residuals, Eigen::Index count, Eigen::Index parameters) : residuals_(residuals) {
    set_num_residuals(static_cast<int>(count));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters));
  }

  bool Evaluate(const double* const* blocks, double* values, double** jacobians) const override {
    const Eigen::Index parameters = parameter_block_sizes()[0];
    const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(blocks[0], parameters);
    Eigen::Map<Eigen::VectorXd>(values, num_residuals()) = residuals_(at);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      const Eigen::MatrixXd slopes = jacobian(residuals_, at);
      for (Eigen::Index row = 0; row < slopes.rows(); ++row) {
        for (Eigen::Index column = 0; column < slopes.cols(); ++column)
          jacobians[0][row * slopes.cols() + column] = slopes(row, column);
      }
    }
    return true;
  }

private:
  const Residuals& residuals_;
};

}  // namespace

Eigen::MatrixXd jacobian(const Residuals& residuals, const Eigen::VectorXd& at) {
  constexpr double step = 1e-3;
  Eigen::MatrixXd slopes;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    Eigen::VectorXd above = at, below = at;
    above[i] += step;
    below[i] -= step;
    const Eigen::VectorXd difference = residuals(above) - residuals(below);
    if (i == 0) slopes.resize(difference.size(), at.size());
    slopes.col(i) = difference / (2 * step);
  }
  return slopes;
}

std::optional<Minimum> minimise(const Residuals& residuals, const Eigen::VectorXd& start) {
  Minimum minimum;
  minimum.parameters = start;
  minimum.residuals = residuals(start);
  const auto count = minimum.residuals.size();
  if (start.size() == 0 || count < start.size() || !minimum.residuals.allFinite()) return std::nullopt;

  ceres::Problem problem;
  double* values = minimum.parameters.data();
  problem.AddResidualBlock(new WholeCost(residuals, count, start.size()), nullptr, values);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 40;
  options.function_tolerance = 0;
  options.gradient_tolerance = 0;
  options.parameter_tolerance = 1e-15;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return std::nullopt;

  // Ceres would say so on the standard error stream.
  const Eigen::VectorXd weights =
      Eigen::JacobiSVD<Eigen::MatrixXd>(jacobian(residuals, minimum.parameters)).singularValues();
  if (!(weights[weights.size() - 1] > 2e-7 * weights[0])) return std::nullopt;

  ceres::Covariance::Options quality;
  quality.algorithm_type = ceres::DENSE_SVD;
  quality.num_threads = 1;
  ceres::Covariance covariance(quality);
  const std::vector<const double*> blocks = {values};
  if (!covariance.Compute(blocks, &problem)) return std::nullopt;
  std::vector<double> block(static_cast<std::size_t>(start.size() * start.size()));
  covariance.GetCovarianceBlock(values, values, block.data());
  minimum.cofactors = Eigen::Map<Eigen::MatrixXd>(block.data(), start.size(), start.size());
  minimum.residuals = residuals(minimum.parameters);
  return minimum;
}

}  // namespace probewright::kinematics
