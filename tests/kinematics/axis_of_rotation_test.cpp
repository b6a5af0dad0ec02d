#include "kinematics/axis_of_rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kinematics/dice.hpp"

/// One axis of rotation from a body that turns with it.
namespace probewright::kinematics {
namespace {

struct PlantedAxis {
  Line axis;
  Vector3 start;
};

PlantedAxis planted(Dice& dice) {
  PlantedAxis axis;
  axis.axis.point = dice.within(500);
  axis.axis.direction = dice.within(1).normalized();
  axis.start = axis.axis.point + dice.between(20, 300) * axis.axis.direction.unitOrthogonal() + dice.within(10);
  return axis;
}

Vector3 at(const PlantedAxis& planted, double degrees) {
  return planted.axis.point + rotation(planted.axis.direction, degrees) * Vector3(planted.start - planted.axis.point);
}

double apart(const Line& a, const Vector3& point) { return a.direction.cross(point - a.point).norm(); }

TEST(AxisOfRotation, IsFoundFromThreePositionsAndMore) {
  Dice dice(1);
  for (int world = 0; world < 100; ++world) {
    SCOPED_TRACE(world);
    const PlantedAxis truth = planted(dice);
    std::vector<TurnedPoint> points;
    const int count = dice.whole(3, 8);
    const double step = dice.between(10, 40), begin = dice.between(-180, 180);
    for (int i = 0; i < count; ++i)
      points.push_back({begin + i * step, at(truth, begin + i * step)});
    const auto found = fitAxisOfRotation(points, truth.axis.direction + Vector3(dice.within(0.1)));
    ASSERT_TRUE(found) << format(found.error());
    EXPECT_LT(found->axis.direction.cross(truth.axis.direction).norm(), 1e-9);
    EXPECT_GT(found->axis.direction.dot(truth.axis.direction), 0);
    EXPECT_LT(apart(truth.axis, found->axis.point), 1e-7);
    EXPECT_NEAR(found->radius, apart(truth.axis, truth.start), 1e-7);
    EXPECT_LT((found->start - truth.start).norm(), 1e-7);
    EXPECT_LT(found->rms, 1e-9);
    // With its direction told, two positions are enough.
    const auto told = fitAxisOfRotation(std::span(points).first(2), {}, truth.axis.direction);
    ASSERT_TRUE(told);
    EXPECT_LT(apart(truth.axis, told->axis.point), 1e-7);
  }
}

/// The cofactors against 2,000 worlds with scattered points.
TEST(AxisOfRotation, IsAsUncertainAsItsCofactorsSay) {
  Dice dice(2);
  std::mt19937_64 engine(3);
  constexpr double sigma = 1e-3;
  std::normal_distribution<double> scatter(0, sigma);
  const PlantedAxis truth = planted(dice);
  Matrix3 points = Matrix3::Zero(), directions = Matrix3::Zero(), pointsSaid, directionsSaid;
  constexpr int worlds = 2000;
  for (int world = 0; world < worlds; ++world) {
    std::vector<TurnedPoint> found;
    for (const double degrees : {-70.0, -20.0, 35.0, 80.0})
      found.push_back({degrees, at(truth, degrees) + Vector3(scatter(engine), scatter(engine), scatter(engine))});
    const auto fit = fitAxisOfRotation(found, truth.axis.direction);
    ASSERT_TRUE(fit);
    // Where the found axis passes through the plane of the true circle's middle.
    const double height = truth.axis.direction.dot(truth.start - truth.axis.point);
    const Vector3 middle = truth.axis.point + height * truth.axis.direction;
    const Vector3 off = fit->axis.point - middle;
    points += off * off.transpose() / worlds;
    const Vector3 turned = fit->axis.direction - truth.axis.direction;
    directions += turned * turned.transpose() / worlds;
    pointsSaid = sigma * sigma * fit->pointCofactors;
    directionsSaid = sigma * sigma * fit->directionCofactors;
  }
  const Matrix3 flat = Matrix3::Identity() - truth.axis.direction * truth.axis.direction.transpose();
  EXPECT_LT((flat * points * flat - pointsSaid).norm(), 0.1 * pointsSaid.norm());
  EXPECT_LT((directions - directionsSaid).norm(), 0.1 * directionsSaid.norm());
}

TEST(AxisOfRotation, SaysWithNumbersWhatLeavesItOpen) {
  const PlantedAxis truth{{Vector3(10, 20, 30), Vector3::UnitZ()}, Vector3(110, 20, 50)};
  std::vector<TurnedPoint> points = {{0, at(truth, 0)}, {90, at(truth, 90)}};
  EXPECT_EQ(fitAxisOfRotation(points, Vector3::UnitZ()).error().message,
            "2 positions do not determine an axis of rotation");
  points = {{0, at(truth, 0)}, {0.001, at(truth, 0.001)}, {0.002, at(truth, 0.002)}};
  EXPECT_EQ(fitAxisOfRotation(points, Vector3::UnitZ()).error().message,
            "3 positions over 0.002 degrees leave the place and direction of the axis of rotation open; the body "
            "stands 100 mm from it");
  const PlantedAxis near{{Vector3(10, 20, 30), Vector3::UnitZ()}, Vector3(10.0001, 20, 50)};
  points = {{0, at(near, 0)}, {90, at(near, 90)}, {180, at(near, 180)}};
  EXPECT_EQ(fitAxisOfRotation(points, Vector3::UnitZ()).error().message,
            "3 positions over 180 degrees leave the direction of the axis of rotation open; the body stands 0.0001 mm "
            "from it");
}

}  // namespace
}  // namespace probewright::kinematics
