// Points that lie on planted shapes to the last bit give the shapes back, wherever they lie and however few or long
// they are.
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

double distance(const Vector3& point, const Plane& plane) {
  return (point - plane.point).dot(plane.normal.normalized());
}

class World {
public:
  explicit World(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int count(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Vector3 place() { return {between(-2000, 2000), between(-2000, 2000), between(-2000, 2000)}; }
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

constexpr int worlds = 500;
constexpr double exact = 1e-9;  // mm; coordinates up to 2000 mm are rounded to 2e-13

TEST(ExactPoints, Circle) {
  for (std::uint64_t seed = 0; seed < worlds; ++seed) {
    World world(seed);
    const Vector2 centre(world.between(-2000, 2000), world.between(-2000, 2000));
    const double radius = std::pow(10, world.between(-1, 2.7));
    const double arc = radiansFromDegrees(world.between(30, 360));
    const double start = world.between(0, 6);
    const int count = world.count(3, 12);
    std::vector<Vector2> points;
    for (int i = 0; i < count; ++i) {
      const double angle = start + arc * i / count;
      points.push_back(centre + radius * Vector2(std::cos(angle), std::sin(angle)));
    }
    const auto fit = fitCircle(std::span<const Vector2>(points));
    ASSERT_TRUE(fit) << "seed " << seed << ": " << fit.error().message;
    EXPECT_LT((fit->shape.centre - centre).norm(), exact) << "seed " << seed;
    EXPECT_NEAR(fit->shape.radius, radius, exact) << "seed " << seed;
    EXPECT_LT(fit->formDeviation, exact);
    EXPECT_EQ(fit->degreesOfFreedom, count - 3);
  }
}

/// A circle passes through any three points of a short arc, and it is that of the perpendicular bisectors.
TEST(ExactPoints, CircleThroughThreePointsOfAShortArc) {
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    World world(seed);
    const double start = world.between(0, 6), step = radiansFromDegrees(world.between(8, 20));
    std::vector<Vector2> points;
    for (int i = 0; i < 3; ++i)
      points.push_back((12 + world.between(-0.01, 0.01)) *
                       Vector2(std::cos(start + i * step), std::sin(start + i * step)));
    const auto fit = fitCircle(std::span<const Vector2>(points));
    ASSERT_TRUE(fit) << "seed " << seed << ": " << fit.error().message;
    const Vector2 a = points[1] - points[0], b = points[2] - points[0];
    const double twice = 2 * (a.x() * b.y() - a.y() * b.x());
    const Vector2 centre = points[0] + Vector2(b.y() * a.squaredNorm() - a.y() * b.squaredNorm(),
                                               a.x() * b.squaredNorm() - b.x() * a.squaredNorm()) /
                                           twice;
    EXPECT_LT((fit->shape.centre - centre).norm(), exact) << "seed " << seed;
    EXPECT_NEAR(fit->shape.radius, (points[0] - centre).norm(), exact) << "seed " << seed;
  }
}

TEST(ExactPoints, CircleInSpaceAndInAGivenPlane) {
  for (std::uint64_t seed = 0; seed < worlds; ++seed) {
    World world(seed);
    const Circle planted{world.place(), world.direction(), world.between(1, 200)};
    const Vector3 u = planted.normal.unitOrthogonal();
    const Vector3 v = planted.normal.cross(u);
    std::vector<Vector3> points;
    const int count = world.count(3, 12);
    for (int i = 0; i < count; ++i) {
      const double angle = 4.0 * i / count;
      points.push_back(planted.centre + planted.radius * (u * std::cos(angle) + v * std::sin(angle)));
    }
    for (const auto& fit :
         {fitCircle(std::span<const Vector3>(points)), fitCircleInPlane(points, 3 * planted.normal)}) {
      ASSERT_TRUE(fit) << "seed " << seed << ": " << fit.error().message;
      EXPECT_LT((fit->shape.centre - planted.centre).norm(), exact) << "seed " << seed;
      EXPECT_NEAR(fit->shape.radius, planted.radius, exact) << "seed " << seed;
      EXPECT_LT(fit->shape.normal.cross(planted.normal).norm(), exact) << "seed " << seed;
      for (const double residual : fit->axialResiduals)
        EXPECT_NEAR(residual, 0, exact);
    }
  }
}

TEST(ExactPoints, Sphere) {
  for (std::uint64_t seed = 0; seed < worlds; ++seed) {
    World world(seed);
    const Sphere planted{world.place(), world.between(1, 60)};
    const Vector3 pole = world.direction();
    const Vector3 u = pole.unitOrthogonal();
    const Vector3 v = pole.cross(u);
    // As a cycle probes a calibration sphere: the pole and a ring below it.
    const double height = world.between(0.0, 0.8);
    std::vector<Vector3> points = {planted.centre + planted.radius * pole};
    const int count = world.count(3, 10);
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      const Vector3 across = u * std::cos(angle) + v * std::sin(angle);
      points.push_back(planted.centre + planted.radius * (height * pole + std::sqrt(1 - height * height) * across));
    }
    const auto fit = fitSphere(points);
    ASSERT_TRUE(fit) << "seed " << seed << ": " << fit.error().message;
    EXPECT_LT((fit->shape.centre - planted.centre).norm(), exact) << "seed " << seed;
    EXPECT_NEAR(fit->shape.radius, planted.radius, exact) << "seed " << seed;
  }
}

TEST(ExactPoints, LinesAndPlanes) {
  for (std::uint64_t seed = 0; seed < worlds; ++seed) {
    World world(seed);
    const Vector3 place = world.place();
    const Vector3 axis = world.direction();
    const Vector3 u = axis.unitOrthogonal();
    const Vector3 v = axis.cross(u);
    std::vector<Vector3> along, flat;
    std::vector<Vector2> edge;
    const Vector2 edgeDirection = Vector2(axis.x(), axis.y()).normalized();
    const int count = world.count(3, 10);
    for (int i = 0; i < count; ++i) {
      along.push_back(place + axis * 12.5 * i);
      flat.push_back(place + u * 30 * (i % 2) + v * 11 * i);
      edge.push_back(Vector2(place.x(), place.y()) + edgeDirection * 7.0 * i);
    }
    const auto line = fitLine(std::span<const Vector3>(along));
    ASSERT_TRUE(line);
    EXPECT_LT((line->shape.direction - axis).norm(), exact) << "runs from the first to the last point, seed " << seed;
    EXPECT_LT(line->formDeviation, exact);
    EXPECT_LT(distance(line->shape.point, Line{place, axis}), exact);
    const auto plane = fitPlane(flat);
    ASSERT_TRUE(plane);
    EXPECT_LT(plane->shape.normal.cross(axis).norm(), exact) << "seed " << seed;
    EXPECT_GT(plane->shape.normal.maxCoeff(), -plane->shape.normal.minCoeff()) << "greatest component positive";
    EXPECT_LT(std::abs(distance(plane->shape.point, Plane{place, axis})), exact) << "seed " << seed;
    const auto straight = fitLine(std::span<const Vector2>(edge));
    ASSERT_TRUE(straight);
    EXPECT_LT((straight->shape.direction - edgeDirection).norm(), exact);
  }
}

// Four points 90 degrees apart, one pushed out by e: the circle's centre follows by e/2, its radius grows by e/4 (first
// order in e/r), and the residuals alternate with e/4.
TEST(FormDeviation, OfOneRaisedPoint) {
  constexpr double e = 0.004;
  const std::vector<Vector2> points = {{50 + e, 0}, {0, 50}, {-50, 0}, {0, -50}};
  const auto fit = fitCircle(std::span<const Vector2>(points));
  ASSERT_TRUE(fit);
  constexpr double secondOrder = e * e / 50;
  EXPECT_NEAR(fit->shape.centre.x(), e / 2, secondOrder);
  EXPECT_NEAR(fit->shape.radius, 50 + e / 4, secondOrder);
  EXPECT_NEAR(fit->formDeviation, e / 2, secondOrder);
  EXPECT_NEAR(fit->residuals[0], e / 4, secondOrder);
  EXPECT_NEAR(fit->residuals[1], -e / 4, secondOrder);
  EXPECT_NEAR(fit->rms, e / 4, secondOrder);
  EXPECT_NEAR(fit->pointDeviation, e / 2, secondOrder);
}

}  // namespace
}  // namespace probewright::metrology
