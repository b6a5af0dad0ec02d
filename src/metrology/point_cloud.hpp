#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "metrology/fits.hpp"

/// What all fits share: points brought around their centroid at unit size, and the statistics of residuals.
namespace probewright::metrology {

inline constexpr double undeterminedRatio = 1e-9;

/// Points shifted to their centroid and divided by their root mean square distance from it, with their principal axes.
template <int D>
struct PointCloud {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Square = Eigen::Matrix<double, D, D>;
  Vector centroid = Vector::Zero();
  double scale = 1;
  std::vector<Vector> points;
  Square axes = Square::Identity();  ///< columns: directions of greatest to least spread
  Vector spreads = Vector::Zero();   ///< root mean square along each axis, unit cloud: squares add up to 1

  bool isFlat(int dimension) const { return spreads[dimension] <= undeterminedRatio * spreads[0]; }
  bool isAlike(int greater, int less) const {
    return spreads[greater] - spreads[less] <= undeterminedRatio * spreads[0];
  }
};

/// Fails on coordinates that are not finite, on fewer than `needed` points and on coincident ones.
template <int D>
Result<PointCloud<D>> pointCloud(std::span<const Eigen::Matrix<double, D, 1>> points, std::size_t needed,
                                 const std::string& shape);

/// Fills the figures that follow from the residuals; `equations` and `freedoms` decide the degrees of freedom.
template <class Shape, int Members>
void summarize(Fit<Shape, Members>& fit, double sumOfSquares, int equations, int freedoms, const FitOptions& options) {
  const auto [least, greatest] = std::minmax_element(fit.residuals.begin(), fit.residuals.end());
  fit.formDeviation = *greatest - *least;
  fit.rms = std::sqrt(sumOfSquares / static_cast<double>(fit.residuals.size()));
  fit.degreesOfFreedom = equations - freedoms;
  const double scatter = fit.degreesOfFreedom > 0 ? std::sqrt(sumOfSquares / fit.degreesOfFreedom) : 0;
  fit.pointDeviation = options.pointDeviation.value_or(scatter);
}

/// A vector at right angles to the unit vector `axis`, and the third one of the right-handed frame (u, v, axis).
inline std::pair<Vector3, Vector3> crossAxes(const Vector3& axis) {
  const Vector3 u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

/// `direction` or its opposite, so that its greatest component is positive.
inline Vector3 canonicalSide(const Vector3& direction) {
  Eigen::Index greatest = 0;
  direction.cwiseAbs().maxCoeff(&greatest);
  return direction[greatest] < 0 ? Vector3(-direction) : direction;
}

}  // namespace probewright::metrology
