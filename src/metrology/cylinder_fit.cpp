#include <algorithm>
#include <cmath>
#include <numbers>

#include "metrology/fits.hpp"
#include "metrology/least_squares.hpp"
#include "metrology/point_cloud.hpp"
#include "metrology/round_start.hpp"

namespace probewright::metrology {

namespace {

constexpr double straightRadius = 1e7;

/// Distances from a cylinder. The steps are the axis point's along u and v, the axis' tilts towards u and v, and the
/// radius; the axis point stays at the height of the centroid.
struct CylinderProblem {
  static constexpr int freedoms = 5;
  using State = Cylinder;
  const std::vector<Vector3>& points;

  void evaluate(const Cylinder& cylinder, Eigen::VectorXd& residuals,
                Eigen::Matrix<double, Eigen::Dynamic, freedoms>& jacobian) const {
    const auto count = static_cast<Eigen::Index>(points.size());
    residuals.resize(count);
    jacobian.resize(count, freedoms);
    const auto [u, v] = crossAxes(cylinder.direction);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vector3 offset = points[static_cast<std::size_t>(i)] - cylinder.point;
      const double height = offset.dot(cylinder.direction);
      const double alongU = offset.dot(u);
      const double alongV = offset.dot(v);
      const double radial = std::hypot(alongU, alongV);
      const double cosine = alongU / std::max(radial, 1e-300);
      const double sine = alongV / std::max(radial, 1e-300);
      residuals[i] = radial - cylinder.radius;
      jacobian.row(i) << -cosine, -sine, -height * cosine, -height * sine, -1;
    }
  }
  Cylinder moved(const Cylinder& cylinder, const Eigen::Matrix<double, freedoms, 1>& step) const {
    const auto [u, v] = crossAxes(cylinder.direction);
    const Vector3 direction = (cylinder.direction + u * step[2] + v * step[3]).normalized();
    const Vector3 point = cylinder.point + u * step[0] + v * step[1];
    return {point - direction * direction.dot(point), direction, cylinder.radius + step[4]};
  }
};

struct Candidate {
  Cylinder cylinder;
  double cost = 0;
};

/// The cylinder along `axis` that Taubin's circle gives, and its sum of squared distances.
std::optional<Candidate> startAlong(const std::vector<Vector3>& points, const Vector3& axis) {
  const auto [u, v] = crossAxes(axis);
  std::vector<Vector2> projected;
  projected.reserve(points.size());
  for (const Vector3& point : points)
    projected.emplace_back(u.dot(point), v.dot(point));
  const auto circle = algebraicRound<2>(projected);
  if (!circle || !(circle->radius < straightRadius)) return std::nullopt;
  Candidate candidate{{u * circle->centre.x() + v * circle->centre.y(), axis, circle->radius}, 0};
  for (const Vector2& point : projected) {
    candidate.cost += std::pow((point - circle->centre).norm() - circle->radius, 2);
  }
  return candidate;
}

/// Starts along the principal axes and evenly over the hemisphere, the best first.
std::vector<Candidate> startsEverywhere(const PointCloud<3>& cloud) {
  constexpr int directions = 200;
  constexpr std::size_t kept = 6;
  std::vector<Candidate> starts;
  for (int i = 0; i < directions; ++i) {
    const double height = (i + 0.5) / directions;
    const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double across = std::sqrt(1 - height * height);
    const auto start = startAlong(cloud.points, Vector3(across * std::cos(turn), across * std::sin(turn), height));
    if (start) starts.push_back(*start);
  }
  const auto byCost = [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; };
  const std::size_t best = std::min(kept, starts.size());
  std::partial_sort(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(best), starts.end(), byCost);
  starts.resize(best);
  for (int axis = 0; axis < 3; ++axis) {
    if (const auto start = startAlong(cloud.points, cloud.axes.col(axis).normalized())) starts.push_back(*start);
  }
  return starts;
}

Result<CylinderFit> fitFrom(std::span<const Vector3> points, std::optional<Vector3> axis, const FitOptions& options) {
  auto cloud = pointCloud<3>(points, axis ? 5 : 6, axis ? "a cylinder" : "a cylinder of unknown direction");
  if (!cloud) return tl::unexpected(cloud.error());
  if (cloud->isFlat(2)) {
    return fail("the points lie in one plane, so no cylinder is determined", "measure at two heights at least");
  }
  std::vector<Candidate> starts;
  if (!axis) {
    starts = startsEverywhere(*cloud);
  } else if (const auto start = startAlong(cloud->points, axis->normalized())) {
    starts.push_back(*start);
  }

  const CylinderProblem problem{cloud->points};
  std::optional<LeastSquares<CylinderProblem>> best;
  Eigen::Matrix<double, 5, 5> cofactors, bestCofactors;
  for (const Candidate& start : starts) {
    LeastSquares<CylinderProblem> solver(problem, start.cylinder);
    if (!solver.minimise() || !(solver.state().radius < straightRadius) || !(solver.state().radius > 0)) continue;
    if (!solver.cofactors(cofactors)) continue;
    if (best && !(solver.cost() < best->cost())) continue;
    best.emplace(std::move(solver));
    bestCofactors = cofactors;
  }
  if (!best) {
    return fail("the points do not determine a cylinder", "measure at least three points at each of two heights");
  }

  CylinderFit fit;
  const double scale = cloud->scale;
  const Vector3 found = best->state().direction;
  const Vector3 direction = axis ? Vector3(found.dot(*axis) < 0 ? -found : found) : canonicalSide(found);
  const double side = direction.dot(found) > 0 ? 1 : -1;
  fit.shape = {cloud->centroid + best->state().point * scale, direction, best->state().radius * scale};
  const Eigen::VectorXd residuals = best->residuals() * scale;
  fit.residuals.assign(residuals.begin(), residuals.end());
  summarize(fit, residuals.squaredNorm(), static_cast<int>(points.size()), 5, options);
  const auto [u, v] = crossAxes(found);
  const Vector3 foot = best->state().point;
  Eigen::Matrix<double, 7, 5> members = Eigen::Matrix<double, 7, 5>::Zero();
  members.block<3, 1>(0, 0) = u;
  members.block<3, 1>(0, 1) = v;
  // The reported point stays at the centroid's height: a tilt slides it along the axis.
  members.block<3, 1>(0, 2) = -found * u.dot(foot);
  members.block<3, 1>(0, 3) = -found * v.dot(foot);
  members.block<3, 1>(3, 2) = side * u / scale;
  members.block<3, 1>(3, 3) = side * v / scale;
  members(6, 4) = 1;
  fit.covariance = fit.pointDeviation * fit.pointDeviation * members * bestCofactors * members.transpose();
  return fit;
}

}  // namespace

Result<CylinderFit> fitCylinder(std::span<const Vector3> points, const FitOptions& options) {
  return fitFrom(points, std::nullopt, options);
}

Result<CylinderFit> fitCylinder(std::span<const Vector3> points, const Vector3& axis, const FitOptions& options) {
  if (!axis.allFinite() || !(axis.norm() > 0)) return fail("the cylinder's axis is not a direction");
  return fitFrom(points, axis, options);
}

}  // namespace probewright::metrology
