#include "metrology/point_cloud.hpp"

#include <Eigen/SVD>

#include "metrology/householder.hpp"

namespace probewright::metrology {

template <int D>
Result<PointCloud<D>> pointCloud(std::span<const Eigen::Matrix<double, D, 1>> points, std::size_t needed,
                                 const std::string& shape) {
  if (points.size() < needed) {
    return fail(shape + " needs at least " + std::to_string(needed) + " points, " + std::to_string(points.size()) +
                    (points.size() == 1 ? " was given" : " were given"),
                "measure more points");
  }
  PointCloud<D> cloud;
  const double count = static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) return fail("coordinate of point " + std::to_string(i + 1) + " is not a finite number");
    cloud.centroid += points[i] / count;
  }
  Eigen::Matrix<double, Eigen::Dynamic, D> rows(static_cast<Eigen::Index>(std::max<std::size_t>(points.size(), D)), D);
  rows.setZero();
  for (std::size_t i = 0; i < points.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = points[i] - cloud.centroid;
  // The mean of large coordinates is rounded; what is left over is small and can be taken out exactly.
  const typename PointCloud<D>::Vector rest = rows.colwise().sum() / count;
  for (std::size_t i = 0; i < points.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) -= rest;
  cloud.centroid += rest;
  cloud.scale = rows.norm() / std::sqrt(count);
  if (!(cloud.scale > 1e-9)) return fail("all points coincide", "measure points that are apart from each other");
  if (!std::isfinite(cloud.scale)) return fail("coordinates are too large");
  rows /= cloud.scale;
  cloud.points.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    cloud.points.push_back(rows.row(static_cast<Eigen::Index>(i)));
  Eigen::VectorXd none;
  triangularize(rows, none);
  const typename PointCloud<D>::Square upper = rows.template topRows<D>().template triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<typename PointCloud<D>::Square> svd(upper, Eigen::ComputeFullV);
  cloud.axes = svd.matrixV();
  cloud.spreads = svd.singularValues() / std::sqrt(count);
  return cloud;
}

template Result<PointCloud<2>> pointCloud<2>(std::span<const Vector2>, std::size_t, const std::string&);
template Result<PointCloud<3>> pointCloud<3>(std::span<const Vector3>, std::size_t, const std::string&);

}  // namespace probewright::metrology
