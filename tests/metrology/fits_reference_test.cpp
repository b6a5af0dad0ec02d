// Fits against published values and against values solved with 50 digits (reference_fits.py in this folder).
#include <gtest/gtest.h>

#include <cmath>

#include "metrology/fits.hpp"

namespace probewright::metrology {
namespace {

double relative(double value, double expected) { return std::abs(value - expected) / std::abs(expected); }

// W. Gander, G. Golub, R. Strebel: Least-squares fitting of circles and ellipses, BIT 34 (1994), section 2 and 3.
const std::vector<Vector2> ganderPoints = {{1, 7}, {2, 6}, {5, 8}, {7, 7}, {9, 5}, {3, 7}};

TEST(CircleReference, GanderGolubStrebelAsPublished) {
  const auto fit = fitCircle(std::span<const Vector2>(ganderPoints));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->shape.centre.x(), 4.7398, 5e-5);
  EXPECT_NEAR(fit->shape.centre.y(), 2.9835, 5e-5);
  EXPECT_NEAR(fit->shape.radius, 4.7142, 5e-5);
}

TEST(CircleReference, GanderGolubStrebelToTwelveDigits) {
  const auto fit = fitCircle(std::span<const Vector2>(ganderPoints));
  ASSERT_TRUE(fit);
  EXPECT_LT(relative(fit->shape.centre.x(), 4.7397824109060740344), 1e-12);
  EXPECT_LT(relative(fit->shape.centre.y(), 2.9835326992924751602), 1e-12);
  EXPECT_LT(relative(fit->shape.radius, 4.714226037792109746), 1e-12);
  EXPECT_LT(relative(fit->rms, 0.4523271452875039698), 1e-12);
  EXPECT_EQ(fit->degreesOfFreedom, 3);
}

TEST(CircleReference, StaysExactFarFromTheOrigin) {
  const Vector2 far(4096, -8192);  // powers of two: the shifted points are the same points to the last bit
  std::vector<Vector2> points = ganderPoints;
  for (Vector2& point : points)
    point += far;
  const auto fit = fitCircle(std::span<const Vector2>(points));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->shape.centre.x() - far.x(), 4.7397824109060740344, 2e-12);
  EXPECT_NEAR(fit->shape.centre.y() - far.y(), 2.9835326992924751602, 2e-12);
  EXPECT_LT(relative(fit->shape.radius, 4.714226037792109746), 1e-12);
}

TEST(CircleReference, TenDegreesOfArc) {
  const std::vector<Vector2> points = {{350.002, -120.001}, {349.936, -116.512}, {349.760, -113.026},
                                       {349.449, -109.547}, {349.029, -106.083}, {348.478, -102.635}};
  const auto fit = fitCircle(std::span<const Vector2>(points));
  ASSERT_TRUE(fit);
  EXPECT_LT(relative(fit->shape.centre.x(), 250.11062534631390365), 1e-11);
  EXPECT_LT(relative(fit->shape.centre.y(), -120.00206679763502645), 1e-11);
  EXPECT_LT(relative(fit->shape.radius, 99.88993761925831982), 1e-11);
  EXPECT_LT(relative(fit->rms, 0.0027183650177613548984), 1e-9);
}

TEST(SphereReference, SevenPoints) {
  const std::vector<Vector3> points = {{10.012, 20.003, 35.001}, {24.998, 20.011, 20.004}, {9.991, 35.006, 19.997},
                                       {-4.996, 19.994, 20.009}, {10.004, 5.003, 19.992},  {20.601, 30.612, 20.003},
                                       {18.667, 28.661, 28.655}};
  const auto fit = fitSphere(points);
  ASSERT_TRUE(fit);
  EXPECT_LT(relative(fit->shape.centre.x(), 10.000194726256003123), 1e-12);
  EXPECT_LT(relative(fit->shape.centre.y(), 20.00369721642972256), 1e-12);
  EXPECT_LT(relative(fit->shape.centre.z(), 20.0018046900128277), 1e-12);
  EXPECT_LT(relative(fit->shape.radius, 14.998760786027499184), 1e-12);
  EXPECT_LT(relative(fit->rms, 0.0019751159968949546607), 1e-9);
}

TEST(PlaneReference, FivePoints) {
  const std::vector<Vector3> points = {
      {0, 0, 5.001}, {100, 0, 6.996}, {0, 80, 4.003}, {100, 80, 5.998}, {52, 37, 5.61}};
  const auto fit = fitPlane(points);
  ASSERT_TRUE(fit);
  const Vector3& normal = fit->shape.normal;
  EXPECT_NEAR(-normal.x() / normal.z(), 0.019955302093111788214, 1e-14);
  EXPECT_NEAR(-normal.y() / normal.z(), -0.01248742438549473972, 1e-14);
  EXPECT_NEAR(normal.dot(fit->shape.point) / normal.z(), 5.007857295295658619, 1e-12);
  EXPECT_LT(relative(fit->rms, 0.0132567501990711353), 1e-9);
}

// Total least squares line through (0,0), (1,1), (2,1), (3,2): the scatter matrix is ((5,3),(3,2)), so that
// tan(2 angle) = 2*3/(5-2) = 2 and the smaller eigenvalue is (7-sqrt(45))/2.
TEST(LineReference, FourPointsInClosedForm) {
  const std::vector<Vector2> points = {{0, 0}, {1, 1}, {2, 1}, {3, 2}};
  const auto fit = fitLine(std::span<const Vector2>(points));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(std::atan2(fit->shape.direction.y(), fit->shape.direction.x()), 0.5 * std::atan(2.0), 1e-15);
  EXPECT_NEAR(fit->shape.point.x(), 1.5, 1e-15);
  EXPECT_NEAR(fit->shape.point.y(), 1.0, 1e-15);
  EXPECT_NEAR(fit->rms * fit->rms * 4, (7 - std::sqrt(45.0)) / 2, 1e-14);
  EXPECT_EQ(fit->degreesOfFreedom, 2);
  EXPECT_GT(fit->residuals[1], 0) << "(1,1) lies on the left";
  EXPECT_LT(fit->residuals[2], 0) << "(2,1) lies on the right";
}

}  // namespace
}  // namespace probewright::metrology
