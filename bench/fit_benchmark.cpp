// Fits of probed features beside Ceres Solver, which minimises the same distances with automatic derivatives, dense QR
// and its default tolerances, starting from the true shape. A fit starts from nothing but the points.
#include <benchmark/benchmark.h>
#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "metrology/fits.hpp"

namespace probewright::metrology {
namespace {

constexpr double radius = 25;
constexpr double noise = 0.003;
const Vector3 centre(120, -80, 40);

std::vector<Vector2> circlePoints(int count) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> error(0, noise);
  std::vector<Vector2> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.push_back(centre.head<2>() + (radius + error(random)) * Vector2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// Rings of a sphere at five heights.
std::vector<Vector3> spherePoints(int count) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> error(0, noise);
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i * 5 / count;
    const double height = 10.0 * (i % 5) - 20;
    const double across = std::sqrt(radius * radius - height * height);
    const Vector3 ideal(across * std::cos(angle), across * std::sin(angle), height);
    points.push_back(centre + ideal * (1 + error(random) / radius));
  }
  return points;
}

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
    residual[0] = (point.cast<T>() - Eigen::Map<const Eigen::Matrix<T, 3, 1>>(p)).norm() - p[3];
    return true;
  }
};

template <class Distance, int Parameters, class Point>
double solveWithCeres(const std::vector<Point>& points, std::array<double, Parameters> p) {
  ceres::Problem problem;
  for (const Point& point : points) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Distance, 1, Parameters>(new Distance{point}), nullptr,
                             p.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return p.back();
}

void circle(benchmark::State& state) {
  const auto points = circlePoints(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(fitCircle(std::span<const Vector2>(points))->shape.radius);
}
void circleCeres(benchmark::State& state) {
  const auto points = circlePoints(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(solveWithCeres<CircleDistance, 3>(points, {centre.x(), centre.y(), radius}));
  }
}
void sphere(benchmark::State& state) {
  const auto points = spherePoints(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(fitSphere(points)->shape.radius);
}
void sphereCeres(benchmark::State& state) {
  const auto points = spherePoints(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(solveWithCeres<SphereDistance, 4>(points, {centre.x(), centre.y(), centre.z(), radius}));
  }
}

BENCHMARK(circle)->Arg(4)->Arg(16)->Arg(1000);
BENCHMARK(circleCeres)->Arg(4)->Arg(16)->Arg(1000);
BENCHMARK(sphere)->Arg(10)->Arg(1000);
BENCHMARK(sphereCeres)->Arg(10)->Arg(1000);

}  // namespace
}  // namespace probewright::metrology
