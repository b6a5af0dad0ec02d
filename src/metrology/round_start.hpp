#pragma once

#include <Eigen/Core>
#include <Eigen/SVD>
#include <cmath>
#include <optional>
#include <vector>

#include "metrology/householder.hpp"

/// The algebraic fit that circles and spheres start from.
namespace probewright::metrology {

template <int D>
struct RoundShape {
  Eigen::Matrix<double, D, 1> centre = Eigen::Matrix<double, D, 1>::Zero();
  double radius = 0;
};

/// Circle (D = 2) or sphere (D = 3) by G. Taubin's method (IEEE Trans. PAMI 13 (1991) 1115): nearly unbiased also on
/// short arcs. Nothing if the points are best fitted by a line or a plane. Points near their centroid, of size 1.
template <int D>
std::optional<RoundShape<D>> algebraicRound(const std::vector<Eigen::Matrix<double, D, 1>>& points) {
  const double count = static_cast<double>(points.size());
  double meanSquare = 0;
  for (const auto& point : points)
    meanSquare += point.squaredNorm() / count;
  if (!(meanSquare > 0)) return std::nullopt;
  const double root = 2 * std::sqrt(meanSquare);
  const auto rows = static_cast<Eigen::Index>(std::max<std::size_t>(points.size(), D + 1));
  Eigen::Matrix<double, Eigen::Dynamic, D + 1> design = Eigen::Matrix<double, Eigen::Dynamic, D + 1>::Zero(rows, D + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    design(row, 0) = (points[i].squaredNorm() - meanSquare) / root;
    design.row(row).template tail<D>() = points[i];
  }
  using Square = Eigen::Matrix<double, D + 1, D + 1>;
  Eigen::VectorXd none;
  triangularize(design, none);
  const Square upper = design.template topRows<D + 1>().template triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Square> svd(upper, Eigen::ComputeFullV);
  const Eigen::Matrix<double, D + 1, 1> solution = svd.matrixV().col(D);
  const double quadratic = solution[0] / root;
  const Eigen::Matrix<double, D, 1> linear = solution.template tail<D>();
  if (!(std::abs(quadratic) > 1e-9 * linear.norm())) return std::nullopt;
  RoundShape<D> round;
  round.centre = linear / (-2 * quadratic);
  round.radius = std::sqrt(round.centre.squaredNorm() + meanSquare);
  return round;
}

}  // namespace probewright::metrology
