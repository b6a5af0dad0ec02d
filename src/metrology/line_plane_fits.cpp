#include <cmath>

#include "metrology/fits.hpp"
#include "metrology/point_cloud.hpp"

namespace probewright::metrology {

Result<Line2Fit> fitLine(std::span<const Vector2> points, const FitOptions& options) {
  auto cloud = pointCloud<2>(points, 2, "a line");
  if (!cloud) return tl::unexpected(cloud.error());
  if (cloud->isAlike(0, 1)) {
    return fail("the points have no preferred direction, so no line fits them best", "measure along one edge");
  }
  Line2Fit fit;
  Vector2 along = cloud->axes.col(0);
  if (along.dot(points.back() - points.front()) < 0) along = -along;
  const Vector2 left(-along.y(), along.x());
  fit.shape = {cloud->centroid, along};

  double sumOfSquares = 0;
  for (const Vector2& point : cloud->points) {
    fit.residuals.push_back(left.dot(point) * cloud->scale);
    sumOfSquares += fit.residuals.back() * fit.residuals.back();
  }
  const int count = static_cast<int>(points.size());
  summarize(fit, sumOfSquares, count, 2, options);
  // About the centroid, offset and slope are not correlated.
  const double variance = fit.pointDeviation * fit.pointDeviation;
  const double momentOfLength = count * std::pow(cloud->spreads[0] * cloud->scale, 2);
  fit.covariance.topLeftCorner<2, 2>() = variance / count * left * left.transpose();
  fit.covariance.bottomRightCorner<2, 2>() = variance / momentOfLength * left * left.transpose();
  return fit;
}

Result<LineFit> fitLine(std::span<const Vector3> points, const FitOptions& options) {
  auto cloud = pointCloud<3>(points, 2, "a line");
  if (!cloud) return tl::unexpected(cloud.error());
  if (cloud->isAlike(0, 1)) {
    return fail("the points have no preferred direction, so no line fits them best", "measure along one edge");
  }
  LineFit fit;
  Vector3 along = cloud->axes.col(0).normalized();
  if (along.dot(points.back() - points.front()) < 0) along = -along;
  fit.shape = {cloud->centroid, along};

  double sumOfSquares = 0;
  for (const Vector3& point : cloud->points) {
    fit.residuals.push_back((point - along * along.dot(point)).norm() * cloud->scale);
    sumOfSquares += fit.residuals.back() * fit.residuals.back();
  }
  const int count = static_cast<int>(points.size());
  summarize(fit, sumOfSquares, 2 * count, 4, options);
  fit.formDeviation = 2 * *std::max_element(fit.residuals.begin(), fit.residuals.end());
  const double variance = fit.pointDeviation * fit.pointDeviation;
  const double momentOfLength = count * std::pow(cloud->spreads[0] * cloud->scale, 2);
  const Matrix3 across = Matrix3::Identity() - along * along.transpose();
  fit.covariance.topLeftCorner<3, 3>() = variance / count * across;
  fit.covariance.bottomRightCorner<3, 3>() = variance / momentOfLength * across;
  return fit;
}

Result<PlaneFit> fitPlane(std::span<const Vector3> points, const FitOptions& options) {
  auto cloud = pointCloud<3>(points, 3, "a plane");
  if (!cloud) return tl::unexpected(cloud.error());
  if (cloud->isFlat(1)) {
    return fail("the points lie on one straight line, so no plane is determined", "measure a point beside the line");
  }
  if (cloud->isAlike(1, 2)) {
    return fail("the points have no preferred plane, so no plane fits them best", "measure on one flat face");
  }
  PlaneFit fit;
  const Vector3 normal = canonicalSide(cloud->axes.col(2).normalized());
  fit.shape = {cloud->centroid, normal};

  double sumOfSquares = 0;
  for (const Vector3& point : cloud->points) {
    fit.residuals.push_back(normal.dot(point) * cloud->scale);
    sumOfSquares += fit.residuals.back() * fit.residuals.back();
  }
  const int count = static_cast<int>(points.size());
  summarize(fit, sumOfSquares, count, 3, options);
  // Along the principal axes, offset and the two tilts are not correlated.
  const double variance = fit.pointDeviation * fit.pointDeviation;
  fit.covariance.topLeftCorner<3, 3>() = variance / count * normal * normal.transpose();
  for (int axis = 0; axis < 2; ++axis) {
    const Vector3 within = cloud->axes.col(axis);
    const double momentOfLength = count * std::pow(cloud->spreads[axis] * cloud->scale, 2);
    fit.covariance.bottomRightCorner<3, 3>() += variance / momentOfLength * within * within.transpose();
  }
  return fit;
}

}  // namespace probewright::metrology
