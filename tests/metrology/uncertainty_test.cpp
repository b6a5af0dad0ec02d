#include "metrology/uncertainty.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "metrology/fits.hpp"

namespace probewright::metrology {
namespace {

TEST(TypeAEvaluation, OfFiveObservations) {
  const std::array<double, 5> observations{10.001, 10.003, 9.999, 10.002, 10.0};
  const auto result = typeA(observations);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->mean, 10.001, 1e-14);
  EXPECT_NEAR(result->standardDeviation, std::sqrt(2.5e-6), 1e-14);
  EXPECT_NEAR(result->standardUncertainty, std::sqrt(0.5e-6), 1e-14);
  EXPECT_EQ(result->degreesOfFreedom, 4);
  // Two are enough: half of their distance is the standard uncertainty of their mean.
  const auto two = typeA(std::array<double, 2>{10.002, 10.008});
  ASSERT_TRUE(two);
  EXPECT_NEAR(two->standardUncertainty, 0.003, 1e-14);
  EXPECT_EQ(two->degreesOfFreedom, 1);
  EXPECT_FALSE(typeA(std::array<double, 1>{1.0}));
}

// Four probings of a bore at right angles: each centre coordinate has u = s / root(2), the radius s / 2.
TEST(FitCovariance, OfFourProbings) {
  const std::vector<Vector2> points = {{10, 0}, {0, 10}, {-10, 0}, {0, -10}};
  const auto fit = fitCircle(std::span<const Vector2>(points), FitOptions{0.002});
  ASSERT_TRUE(fit);
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected.diagonal() << 0.5, 0.5, 0.25;
  EXPECT_LT((fit->covariance - 4e-6 * expected).norm(), 1e-18);
}

/// Covariances against the spread of many noisy fits of the same feature.
TEST(FitCovariance, OfPlaneLineAndCirclePredictsTheSpread) {
  constexpr int runs = 4000;
  constexpr double deviation = 0.01;
  std::mt19937_64 random(42);
  std::normal_distribution<double> noise(0, deviation);
  Eigen::MatrixXd planes(runs, 6);
  Eigen::MatrixXd lines(runs, 4);
  Eigen::MatrixXd circles(runs, 7);
  Eigen::MatrixXd planeSum = Eigen::MatrixXd::Zero(6, 6);
  Eigen::MatrixXd lineSum = Eigen::MatrixXd::Zero(4, 4), circleSum = Eigen::MatrixXd::Zero(7, 7);
  const Vector3 axis = Vector3(1, 2, 6).normalized();
  const Vector3 u = axis.unitOrthogonal();
  const Vector3 v = axis.cross(u);
  for (int run = 0; run < runs; ++run) {
    std::vector<Vector3> flat, ring;
    std::vector<Vector2> edge;
    for (int i = 0; i < 9; ++i) {
      flat.push_back(20.0 * (i % 3) * u + 35.0 * (i / 3) * v + (7 + noise(random)) * axis);
      const Vector3 spoke = u * std::cos(1.1 * i) + v * std::sin(1.1 * i);
      ring.push_back((12 + noise(random)) * spoke + noise(random) * axis + Vector3(5, 6, 7));
      const double beside = noise(random);
      edge.emplace_back(3.0 * i - 0.8 * beside, 4.0 * i + 0.6 * beside);
    }
    const auto plane = fitPlane(flat, FitOptions{deviation});
    const auto line = fitLine(std::span<const Vector2>(edge), FitOptions{deviation});
    const auto circle = fitCircle(std::span<const Vector3>(ring), FitOptions{deviation});
    ASSERT_TRUE(plane && line && circle);
    planes.row(run) << plane->shape.point.transpose(), plane->shape.normal.transpose();
    lines.row(run) << line->shape.point.transpose(), line->shape.direction.transpose();
    circles.row(run) << circle->shape.centre.transpose(), circle->shape.normal.transpose(), circle->shape.radius;
    planeSum += plane->covariance;
    lineSum += line->covariance;
    circleSum += circle->covariance;
  }
  const auto spread = [&](const Eigen::MatrixXd& samples) {
    const Eigen::MatrixXd off = samples.rowwise() - samples.colwise().mean();
    return Eigen::MatrixXd(off.transpose() * off / (runs - 1));
  };
  // Position and direction differ in size: compare each block with its own norm.
  const auto expectAlike = [&](const char* name, const Eigen::MatrixXd& samples, const Eigen::MatrixXd& predicted) {
    const Eigen::MatrixXd seen = spread(samples);
    const Eigen::MatrixXd difference = seen - predicted / runs;
    for (Eigen::Index a = 0; a < seen.rows(); ++a) {
      for (Eigen::Index b = 0; b < seen.cols(); ++b) {
        const double size = std::sqrt(predicted(a, a) * predicted(b, b)) / runs;
        EXPECT_LT(std::abs(difference(a, b)), 0.1 * size + 1e-12) << name << " " << a << "," << b;
      }
    }
  };
  expectAlike("plane", planes, planeSum);
  expectAlike("line", lines, lineSum);
  expectAlike("circle", circles, circleSum);
}

}  // namespace
}  // namespace probewright::metrology
