#include <cmath>

#include "metrology/fits.hpp"
#include "metrology/least_squares.hpp"
#include "metrology/point_cloud.hpp"
#include "metrology/round_start.hpp"

namespace probewright::metrology {

namespace {

// Radius in units of the points' extent beyond which an arc cannot be told from its chord.
constexpr double straightRadius = 1e7;

/// Orthogonal distances from a circle of the plane or a sphere: centre and radius are free.
template <int D>
struct RoundProblem {
  static constexpr int freedoms = D + 1;
  using State = RoundShape<D>;
  const std::vector<Eigen::Matrix<double, D, 1>>& points;

  void evaluate(const State& state, Eigen::VectorXd& residuals,
                Eigen::Matrix<double, Eigen::Dynamic, freedoms>& jacobian) const {
    const auto count = static_cast<Eigen::Index>(points.size());
    residuals.resize(count);
    jacobian.resize(count, freedoms);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Matrix<double, D, 1> spoke = points[static_cast<std::size_t>(i)] - state.centre;
      const double length = spoke.norm();
      residuals[i] = length - state.radius;
      jacobian.row(i).template head<D>() = spoke / -std::max(length, 1e-300);
      jacobian(i, D) = -1;
    }
  }
  State moved(const State& state, const Eigen::Matrix<double, freedoms, 1>& step) const {
    return {state.centre + step.template head<D>(), state.radius + step[D]};
  }
};

tl::unexpected<Diagnostic> tooStraight(const std::string& shape, const std::string& flat) {
  return fail("the points lie on one " + flat + ", so no " + shape + " is determined",
              "measure points that spread over a larger arc");
}

/// The common core: the fit of a unit cloud and the cofactors of its parameters.
template <int D>
struct RoundSolution {
  RoundShape<D> round;
  Eigen::VectorXd residuals;
  Eigen::Matrix<double, D + 1, D + 1> cofactors;
};

template <int D>
Result<RoundSolution<D>> solveRound(const PointCloud<D>& cloud, const std::string& shape, const std::string& flat) {
  if (cloud.isFlat(D - 1)) return tooStraight(shape, flat);
  const auto start = algebraicRound<D>(cloud.points);
  if (!start) return tooStraight(shape, flat);
  const RoundProblem<D> problem{cloud.points};
  LeastSquares<RoundProblem<D>> solver(problem, *start);
  const bool reached = solver.minimise();
  RoundSolution<D> solution{solver.state(), solver.residuals(), {}};
  if (!reached || !(solution.round.radius < straightRadius) || !solver.cofactors(solution.cofactors)) {
    return tooStraight(shape, flat);
  }
  return solution;
}

}  // namespace

Result<Circle2Fit> fitCircle(std::span<const Vector2> points, const FitOptions& options) {
  auto cloud = pointCloud<2>(points, 3, "a circle");
  if (!cloud) return tl::unexpected(cloud.error());
  auto solution = solveRound<2>(*cloud, "circle", "straight line");
  if (!solution) return tl::unexpected(solution.error());
  Circle2Fit fit;
  fit.shape = {cloud->centroid + solution->round.centre * cloud->scale, solution->round.radius * cloud->scale};
  const Eigen::VectorXd residuals = solution->residuals * cloud->scale;
  fit.residuals.assign(residuals.begin(), residuals.end());
  summarize(fit, residuals.squaredNorm(), static_cast<int>(points.size()), 3, options);
  fit.covariance = fit.pointDeviation * fit.pointDeviation * solution->cofactors;
  return fit;
}

Result<SphereFit> fitSphere(std::span<const Vector3> points, const FitOptions& options) {
  auto cloud = pointCloud<3>(points, 4, "a sphere");
  if (!cloud) return tl::unexpected(cloud.error());
  auto solution = solveRound<3>(*cloud, "sphere", "plane");
  if (!solution) return tl::unexpected(solution.error());
  SphereFit fit;
  fit.shape = {cloud->centroid + solution->round.centre * cloud->scale, solution->round.radius * cloud->scale};
  const Eigen::VectorXd residuals = solution->residuals * cloud->scale;
  fit.residuals.assign(residuals.begin(), residuals.end());
  summarize(fit, residuals.squaredNorm(), static_cast<int>(points.size()), 4, options);
  fit.covariance = fit.pointDeviation * fit.pointDeviation * solution->cofactors;
  return fit;
}

Result<CircleFit> fitCircleInPlane(std::span<const Vector3> points, const Vector3& normal, const FitOptions& options) {
  if (!normal.allFinite() || !(normal.norm() > 0)) return fail("the circle's normal is not a direction");
  const Vector3 axis = normal.normalized();
  const auto [u, v] = crossAxes(axis);
  std::vector<Vector2> projected;
  double height = 0;
  for (const Vector3& point : points) {
    projected.emplace_back(u.dot(point), v.dot(point));
    height += axis.dot(point) / static_cast<double>(points.size());
  }
  auto flat = fitCircle(std::span<const Vector2>(projected), options);
  if (!flat) return tl::unexpected(flat.error());
  CircleFit fit;
  fit.shape = {u * flat->shape.centre.x() + v * flat->shape.centre.y() + axis * height, axis, flat->shape.radius};
  fit.residuals = flat->residuals;
  fit.formDeviation = flat->formDeviation;
  fit.rms = flat->rms;
  fit.degreesOfFreedom = flat->degreesOfFreedom;
  fit.pointDeviation = flat->pointDeviation;
  for (const Vector3& point : points)
    fit.axialResiduals.push_back(axis.dot(point) - height);
  Eigen::Matrix<double, 7, 3> members = Eigen::Matrix<double, 7, 3>::Zero();
  members.block<3, 1>(0, 0) = u;
  members.block<3, 1>(0, 1) = v;
  members(6, 2) = 1;
  fit.covariance = members * flat->covariance * members.transpose();
  return fit;
}

namespace {

/// Distances from a circle in space, radial ones first, then axial ones. The steps are the centre's along (u, v,
/// normal), the normal's tilts towards u and v, and the radius.
struct SpaceCircleProblem {
  static constexpr int freedoms = 6;
  using State = Circle;
  const std::vector<Vector3>& points;

  void evaluate(const Circle& circle, Eigen::VectorXd& residuals,
                Eigen::Matrix<double, Eigen::Dynamic, freedoms>& jacobian) const {
    const auto count = static_cast<Eigen::Index>(points.size());
    residuals.resize(2 * count);
    jacobian.setZero(2 * count, freedoms);
    const auto [u, v] = crossAxes(circle.normal);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vector3 offset = points[static_cast<std::size_t>(i)] - circle.centre;
      const double height = offset.dot(circle.normal);
      const double alongU = offset.dot(u);
      const double alongV = offset.dot(v);
      const double radial = std::hypot(alongU, alongV);
      const double divisor = std::max(radial, 1e-300);
      residuals[i] = radial - circle.radius;
      residuals[count + i] = height;
      jacobian.row(i) << -alongU / divisor, -alongV / divisor, 0, -height * alongU / divisor,
          -height * alongV / divisor, -1;
      jacobian.row(count + i) << 0, 0, -1, alongU, alongV, 0;
    }
  }
  Circle moved(const Circle& circle, const Eigen::Matrix<double, freedoms, 1>& step) const {
    const auto [u, v] = crossAxes(circle.normal);
    return {circle.centre + u * step[0] + v * step[1] + circle.normal * step[2],
            (circle.normal + u * step[3] + v * step[4]).normalized(), circle.radius + step[5]};
  }
};

}  // namespace

Result<CircleFit> fitCircle(std::span<const Vector3> points, const FitOptions& options) {
  auto cloud = pointCloud<3>(points, 3, "a circle");
  if (!cloud) return tl::unexpected(cloud.error());
  if (cloud->isFlat(1)) return tooStraight("circle", "straight line");
  std::vector<Vector2> projected;
  for (const Vector3& point : cloud->points) {
    projected.emplace_back(cloud->axes.col(0).dot(point), cloud->axes.col(1).dot(point));
  }
  const auto start = algebraicRound<2>(projected);
  if (!start) return tooStraight("circle", "straight line");
  const Vector3 centre = cloud->axes.col(0) * start->centre.x() + cloud->axes.col(1) * start->centre.y();
  const SpaceCircleProblem problem{cloud->points};
  LeastSquares<SpaceCircleProblem> solver(problem, Circle{centre, cloud->axes.col(2).normalized(), start->radius});
  Eigen::Matrix<double, 6, 6> cofactors;
  if (!solver.minimise() || !(solver.state().radius < straightRadius) || !solver.cofactors(cofactors)) {
    return tooStraight("circle", "straight line");
  }

  CircleFit fit;
  const double scale = cloud->scale;
  const Vector3 found = solver.state().normal;
  const Vector3 normal = canonicalSide(found);
  const double side = normal.dot(found) > 0 ? 1 : -1;
  fit.shape = {cloud->centroid + solver.state().centre * scale, normal, solver.state().radius * scale};
  const auto count = static_cast<Eigen::Index>(points.size());
  const Eigen::VectorXd residuals = solver.residuals() * scale;
  fit.residuals.assign(residuals.begin(), residuals.begin() + count);
  for (Eigen::Index i = count; i < 2 * count; ++i)
    fit.axialResiduals.push_back(side * residuals[i]);
  summarize(fit, residuals.squaredNorm(), static_cast<int>(2 * count), 6, options);
  const auto [u, v] = crossAxes(found);
  Eigen::Matrix<double, 7, 6> members = Eigen::Matrix<double, 7, 6>::Zero();
  members.block<3, 1>(0, 0) = u;
  members.block<3, 1>(0, 1) = v;
  members.block<3, 1>(0, 2) = found;
  members.block<3, 1>(3, 3) = side * u / scale;
  members.block<3, 1>(3, 4) = side * v / scale;
  members(6, 5) = 1;
  fit.covariance = fit.pointDeviation * fit.pointDeviation * members * cofactors * members.transpose();
  return fit;
}

}  // namespace probewright::metrology
