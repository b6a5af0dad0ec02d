#include "metrology/uncertainty.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "metrology/fits.hpp"

namespace probewright::metrology {
namespace {

// JCGM 100:2008, H.1: calibration of a 50 mm end gauge, lengths in nanometres.
TEST(GumExampleH1, EndGauge) {
  const std::array<Contribution, 3> comparison{{{5.8, 1, 24}, {3.9, 1, 5}, {6.7, 1, 8}}};
  const Combined difference = combine(comparison);
  EXPECT_NEAR(difference.standardUncertainty, 9.7, 0.05);
  EXPECT_NEAR(difference.effectiveDegreesOfFreedom, 25.6, 0.4);  // from 5.8, 3.9, 6.7 rounded to two digits

  const double length = 50.000623e6;  // nm
  const std::array<Contribution, 4> contributions{
      {{25, 1, 18}, {9.7, 1, 25.6}, {0.58e-6, -length * -0.1, 50}, {0.029, -length * 11.5e-6, 2}}};
  const Combined result = combine(contributions);
  EXPECT_NEAR(result.standardUncertainty, 32, 0.5);
  EXPECT_NEAR(result.effectiveDegreesOfFreedom, 16.7, 0.4);
  const auto factor = coverageFactor(0.99, 16);
  ASSERT_TRUE(factor);
  EXPECT_NEAR(*factor, 2.92, 0.005);
  EXPECT_NEAR(*factor * result.standardUncertainty, 93, 1);
  EXPECT_DOUBLE_EQ(result.expanded(), 2 * result.standardUncertainty);
}

// JCGM 100:2008, H.2: resistance and reactance from voltage, current and phase measured together.
TEST(GumExampleH2, ResistanceAndReactance) {
  Eigen::MatrixXd observed(5, 3);
  observed << 5.007, 19.663e-3, 1.0456, 4.994, 19.639e-3, 1.0438, 5.005, 19.640e-3, 1.0468, 4.990, 19.685e-3, 1.0428,
      4.999, 19.678e-3, 1.0433;
  const auto together = observedTogether(observed);
  ASSERT_TRUE(together);
  const double v = together->means[0];
  const double i = together->means[1];
  const double phi = together->means[2];
  EXPECT_NEAR(v, 4.9990, 5e-5);
  EXPECT_NEAR(i, 19.6610e-3, 5e-8);
  EXPECT_NEAR(phi, 1.04446, 5e-6);
  const Eigen::MatrixXd& c = together->covarianceOfMeans;
  EXPECT_NEAR(std::sqrt(c(0, 0)), 0.0032, 5e-5);
  EXPECT_NEAR(std::sqrt(c(1, 1)), 0.0095e-3, 5e-8);
  EXPECT_NEAR(std::sqrt(c(2, 2)), 0.00075, 5e-6);
  EXPECT_NEAR(c(0, 1) / std::sqrt(c(0, 0) * c(1, 1)), -0.36, 0.005);
  EXPECT_NEAR(c(0, 2) / std::sqrt(c(0, 0) * c(2, 2)), 0.86, 0.005);
  EXPECT_NEAR(c(1, 2) / std::sqrt(c(1, 1) * c(2, 2)), -0.65, 0.005);

  Eigen::MatrixXd jacobian(3, 3);
  jacobian << std::cos(phi) / i, -v * std::cos(phi) / (i * i), -v * std::sin(phi) / i,  // R = V/I cos phi
      std::sin(phi) / i, -v * std::sin(phi) / (i * i), v * std::cos(phi) / i,           // X = V/I sin phi
      1 / i, -v / (i * i), 0;                                                           // Z = V/I
  const Eigen::MatrixXd result = propagate(jacobian, c);
  EXPECT_NEAR(v / i * std::cos(phi), 127.732, 5e-4);
  EXPECT_NEAR(v / i * std::sin(phi), 219.847, 5e-4);
  EXPECT_NEAR(v / i, 254.260, 5e-4);
  EXPECT_NEAR(std::sqrt(result(0, 0)), 0.071, 5e-4);
  EXPECT_NEAR(std::sqrt(result(1, 1)), 0.295, 6e-4);
  EXPECT_NEAR(std::sqrt(result(2, 2)), 0.236, 5e-4);
  EXPECT_NEAR(result(0, 1) / std::sqrt(result(0, 0) * result(1, 1)), -0.588, 1e-3);
  EXPECT_NEAR(result(0, 2) / std::sqrt(result(0, 0) * result(2, 2)), -0.485, 1e-3);
  EXPECT_NEAR(result(1, 2) / std::sqrt(result(1, 1) * result(2, 2)), 0.993, 1e-3);
}

// GUM table G.2.
TEST(CoverageFactor, StudentTable) {
  struct Entry {
    double degrees, p6827, p95, p9545, p99;
  };
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Entry& entry : {Entry{1, 1.84, 12.71, 13.97, 63.66},
                             {2, 1.32, 4.30, 4.53, 9.92},
                             {5, 1.11, 2.57, 2.65, 4.03},
                             {10, 1.05, 2.23, 2.28, 3.17},
                             {20, 1.03, 2.09, 2.13, 2.85},
                             {infinite, 1.0, 1.96, 2.0, 2.576}}) {
    EXPECT_NEAR(*coverageFactor(0.6827, entry.degrees), entry.p6827, 0.006);
    EXPECT_NEAR(*coverageFactor(0.95, entry.degrees), entry.p95, 0.0051);
    EXPECT_NEAR(*coverageFactor(0.9545, entry.degrees), entry.p9545, 0.0051);
    EXPECT_NEAR(*coverageFactor(0.99, entry.degrees), entry.p99, 0.0051);
  }
  EXPECT_FALSE(coverageFactor(1, 5));
  EXPECT_FALSE(coverageFactor(0.95, 0));
}

TEST(TypeAEvaluation, OfFiveObservations) {
  const std::array<double, 5> observations{10.001, 10.003, 9.999, 10.002, 10.0};
  const auto result = typeA(observations);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->mean, 10.001, 1e-14);
  EXPECT_NEAR(result->standardDeviation, std::sqrt(2.5e-6), 1e-14);
  EXPECT_NEAR(result->standardUncertainty, std::sqrt(0.5e-6), 1e-14);
  EXPECT_NEAR(*confidenceInterval(*result), 2.776445 * std::sqrt(0.5e-6), 1e-9);
  EXPECT_FALSE(typeA(std::array<double, 1>{1.0}));
  EXPECT_NEAR(rectangular(3), std::sqrt(3.0), 1e-15);
  EXPECT_TRUE(std::isinf(combine(std::array<Contribution, 1>{{{1, 1, 0}}}).effectiveDegreesOfFreedom));
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
    return Eigen::MatrixXd(observedTogether(samples)->covarianceOfMeans * runs);
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
