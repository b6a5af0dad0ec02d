// Fits of random features against Ceres, which minimises the same distances from the planted shape as its start.
#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "metrology/fits.hpp"

namespace probewright::metrology {
namespace {

double distance(const Vector3& point, const Line& line) {
  return (point - line.point).cross(line.direction.normalized()).norm();
}

constexpr double agreement = 1e-9;

ceres::Solver::Options strictOptions() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-30;
  options.gradient_tolerance = 1e-30;
  options.parameter_tolerance = 1e-16;
  options.max_num_iterations = 200;
  options.logging_type = ceres::SILENT;
  return options;
}

class World {
public:
  explicit World(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double noise(double deviation) { return std::normal_distribution<double>(0, deviation)(random_); }
  int count(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Vector3 place() { return {between(-500, 500), between(-500, 500), between(-500, 500)}; }
  Vector3 direction() {
    Vector3 result;
    do {
      result = {between(-1, 1), between(-1, 1), between(-1, 1)};
    } while (result.norm() > 1 || result.norm() < 0.1);
    return result.normalized();
  }

private:
  std::mt19937_64 random_;
};

struct CircleDistance {
  Vector2 point;
  template <class T>
  bool operator()(const T* p, T* residual) const {
    const T x = T(point.x()) - p[0];
    const T y = T(point.y()) - p[1];
    residual[0] = ceres::sqrt(x * x + y * y) - p[2];
    return true;
  }
};

struct SphereDistance {
  Vector3 point;
  template <class T>
  bool operator()(const T* p, T* residual) const {
    const Eigen::Matrix<T, 3, 1> offset = point.cast<T>() - Eigen::Map<const Eigen::Matrix<T, 3, 1>>(p);
    residual[0] = offset.norm() - p[3];
    return true;
  }
};

/// Axis through `origin` + p0 u + p1 v along axis + p2 u + p3 v: four parameters and the radius, no constraint.
struct PlaneDistance {
  Vector3 point, origin, normal, u, v;
  template <class T>
  bool operator()(const T* p, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Vector upright = (normal.cast<T>() + u.cast<T>() * p[1] + v.cast<T>() * p[2]).normalized();
    residual[0] = (point - origin).cast<T>().dot(upright) - p[0];
    return true;
  }
};

struct LineDistance {
  Vector3 point, origin, axis, u, v;
  template <class T>
  bool operator()(const T* p, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Vector foot = origin.cast<T>() + u.cast<T>() * p[0] + v.cast<T>() * p[1];
    const Vector along = (axis.cast<T>() + u.cast<T>() * p[2] + v.cast<T>() * p[3]).normalized();
    Eigen::Map<Vector> result(residual);
    result = (point.cast<T>() - foot).cross(along);
    return true;
  }
};

/// Distance from a circle in space: radial and axial.
struct SpaceCircleDistance {
  Vector3 point, origin, axis, u, v;
  template <class T>
  bool operator()(const T* p, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Vector normal = (axis.cast<T>() + u.cast<T>() * p[3] + v.cast<T>() * p[4]).normalized();
    const Vector offset = point.cast<T>() - origin.cast<T>() - Eigen::Map<const Vector>(p);
    residual[0] = offset.cross(normal).norm() - p[5];
    residual[1] = offset.dot(normal);
    return true;
  }
};

template <class Functor, int Residuals, int Parameters>
ceres::CostFunction* cost(Functor functor) {
  return new ceres::AutoDiffCostFunction<Functor, Residuals, Parameters>(new Functor(std::move(functor)));
}

void solve(ceres::Problem& problem) {
  ceres::Solver::Summary summary;
  ceres::Solve(strictOptions(), &problem, &summary);
  ASSERT_TRUE(summary.IsSolutionUsable()) << summary.BriefReport();
}

TEST(AgainstCeres, Circle) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    World world(seed);
    const Vector2 centre(world.between(-500, 500), world.between(-500, 500));
    const double radius = world.between(1, 150);
    const double arc = world.between(0.8, 2 * std::numbers::pi);
    const double start = world.between(0, 6);
    const int count = world.count(4, 40);
    std::vector<Vector2> points;
    double p[3] = {centre.x(), centre.y(), radius};
    ceres::Problem problem;
    for (int i = 0; i < count; ++i) {
      const double angle = start + arc * i / count;
      const double r = radius + world.noise(0.005);
      points.push_back(centre + r * Vector2(std::cos(angle), std::sin(angle)));
      problem.AddResidualBlock(cost<CircleDistance, 1, 3>({points.back()}), nullptr, p);
    }
    solve(problem);
    const auto fit = fitCircle(std::span<const Vector2>(points));
    ASSERT_TRUE(fit) << fit.error().message;
    EXPECT_LT((fit->shape.centre - Vector2(p[0], p[1])).norm() / radius, agreement) << "seed " << seed;
    EXPECT_LT(std::abs(fit->shape.radius - p[2]) / radius, agreement) << "seed " << seed;
  }
}

TEST(AgainstCeres, Sphere) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    World world(seed);
    const Vector3 centre = world.place();
    const double radius = world.between(5, 50);
    std::vector<Vector3> points;
    double p[4] = {centre.x(), centre.y(), centre.z(), radius};
    ceres::Problem problem;
    const int count = world.count(6, 30);
    for (int i = 0; i < count; ++i) {
      points.push_back(centre + (radius + world.noise(0.003)) * world.direction());
      problem.AddResidualBlock(cost<SphereDistance, 1, 4>({points.back()}), nullptr, p);
    }
    solve(problem);
    const auto fit = fitSphere(points);
    ASSERT_TRUE(fit) << fit.error().message;
    EXPECT_LT((fit->shape.centre - Vector3(p[0], p[1], p[2])).norm() / radius, agreement) << "seed " << seed;
    EXPECT_LT(std::abs(fit->shape.radius - p[3]) / radius, agreement) << "seed " << seed;
  }
}

TEST(AgainstCeres, PlaneLineAndSpaceCircle) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    World world(seed);
    const Vector3 origin = world.place();
    const Vector3 axis = world.direction();
    const Vector3 u = axis.unitOrthogonal();
    const Vector3 v = axis.cross(u);
    const double size = world.between(10, 300);
    const int count = world.count(5, 30);
    std::vector<Vector3> onPlane, onLine, onCircle;
    double plane[3] = {0, 0, 0};
    double line[4] = {0, 0, 0, 0};
    double circle[6] = {0, 0, 0, 0, 0, size};
    ceres::Problem planeProblem, lineProblem, circleProblem;
    for (int i = 0; i < count; ++i) {
      onPlane.push_back(origin + size * (u * world.between(-1, 1) + v * world.between(-1, 1)) +
                        axis * world.noise(0.01));
      onLine.push_back(origin + size * axis * world.between(-1, 1) + u * world.noise(0.01) + v * world.noise(0.01));
      const double angle = 5.5 * i / count;
      const double r = size + world.noise(0.01);
      onCircle.push_back(origin + r * (u * std::cos(angle) + v * std::sin(angle)) + axis * world.noise(0.01));
      planeProblem.AddResidualBlock(cost<PlaneDistance, 1, 3>({onPlane.back(), origin, axis, u, v}), nullptr, plane);
      lineProblem.AddResidualBlock(cost<LineDistance, 3, 4>({onLine.back(), origin, axis, u, v}), nullptr, line);
      circleProblem.AddResidualBlock(cost<SpaceCircleDistance, 2, 6>({onCircle.back(), origin, axis, u, v}), nullptr,
                                     circle);
    }
    solve(planeProblem);
    solve(lineProblem);
    solve(circleProblem);

    const auto planeFit = fitPlane(onPlane);
    ASSERT_TRUE(planeFit);
    const Vector3 upright = (axis + u * plane[1] + v * plane[2]).normalized();
    EXPECT_LT(planeFit->shape.normal.cross(upright).norm(), agreement) << "seed " << seed;
    EXPECT_LT(std::abs((planeFit->shape.point - origin).dot(upright) - plane[0]) / size, agreement) << "seed " << seed;

    const auto lineFit = fitLine(std::span<const Vector3>(onLine));
    ASSERT_TRUE(lineFit);
    const Line solved{origin + u * line[0] + v * line[1], (axis + u * line[2] + v * line[3]).normalized()};
    EXPECT_LT(lineFit->shape.direction.cross(solved.direction).norm(), agreement) << "seed " << seed;
    EXPECT_LT(distance(lineFit->shape.point, solved) / size, agreement) << "seed " << seed;

    const auto circleFit = fitCircle(std::span<const Vector3>(onCircle));
    ASSERT_TRUE(circleFit);
    const Vector3 normal = (axis + u * circle[3] + v * circle[4]).normalized();
    const Vector3 centre = origin + Vector3(circle[0], circle[1], circle[2]);
    EXPECT_LT(circleFit->shape.normal.cross(normal).norm(), agreement) << "seed " << seed;
    EXPECT_LT((circleFit->shape.centre - centre).norm() / size, agreement) << "seed " << seed;
    EXPECT_LT(std::abs(circleFit->shape.radius - circle[5]) / size, agreement) << "seed " << seed;
  }
}

/// Ceres' own covariance of (x, y, radius) for unit point deviation.
TEST(AgainstCeres, CovarianceOfACircle) {
  World world(7);
  std::vector<Vector2> points;
  double p[3] = {10, -20, 30};
  ceres::Problem problem;
  for (int i = 0; i < 9; ++i) {
    const double angle = 0.2 * i;
    points.push_back(Vector2(10, -20) + (30 + world.noise(0.01)) * Vector2(std::cos(angle), std::sin(angle)));
    problem.AddResidualBlock(cost<CircleDistance, 1, 3>({points.back()}), nullptr, p);
  }
  solve(problem);
  ceres::Covariance covariance{ceres::Covariance::Options()};
  ASSERT_TRUE(covariance.Compute(std::vector<std::pair<const double*, const double*>>{{p, p}}, &problem));
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> expected;
  covariance.GetCovarianceBlock(p, p, expected.data());
  const auto fit = fitCircle(std::span<const Vector2>(points), FitOptions{1.0});
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->covariance - expected).norm() / expected.norm(), agreement);
  const auto estimated = fitCircle(std::span<const Vector2>(points));
  EXPECT_NEAR(estimated->pointDeviation, estimated->rms * std::sqrt(9.0 / 6.0), 1e-15);
  EXPECT_LT((estimated->covariance - estimated->pointDeviation * estimated->pointDeviation * expected).norm(),
            agreement * expected.norm());
}

}  // namespace
}  // namespace probewright::metrology
