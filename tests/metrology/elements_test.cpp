#include "metrology/elements.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace probewright::metrology {
namespace {

TEST(CircleThrough, ThreePointsOfTheFiveThreeFourTriangle) {
  const auto circle = circleThrough(Vector2(3, 4), Vector2(-5, 0), Vector2(0, -5));
  ASSERT_TRUE(circle);
  EXPECT_LT(circle->centre.norm(), 1e-15);
  EXPECT_DOUBLE_EQ(circle->radius, 5);
}

TEST(CircleThrough, SpaceCircleHasACounterClockwiseNormal) {
  // The vertices of an equilateral triangle in the plane x + y + z = 1.
  const auto circle = circleThrough(Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1));
  ASSERT_TRUE(circle);
  EXPECT_LT((circle->centre - Vector3::Constant(1.0 / 3)).norm(), 1e-15);
  EXPECT_LT((circle->normal - Vector3::Constant(1 / std::sqrt(3.0))).norm(), 1e-15);
  EXPECT_NEAR(circle->radius, std::sqrt(2.0 / 3), 1e-15);
}

TEST(CircleThrough, UnevenTriangleInSpace) {
  const Vector3 centre(100, -50, 20);
  const Vector3 u = Vector3(1, 2, 2) / 3;
  const Vector3 v = Vector3(2, 1, -2) / 3;
  const auto at = [&](double angle) { return Vector3(centre + 30 * (u * std::cos(angle) + v * std::sin(angle))); };
  const auto circle = circleThrough(at(0.1), at(0.5), at(2.8));
  ASSERT_TRUE(circle);
  EXPECT_LT((circle->centre - centre).norm(), 1e-12);
  EXPECT_NEAR(circle->radius, 30, 1e-12);
  EXPECT_LT((circle->normal - u.cross(v)).norm(), 1e-13);
}

TEST(CircleThrough, RefusesCollinearAndCoincidentPoints) {
  EXPECT_FALSE(circleThrough(Vector2(0, 0), Vector2(1, 1), Vector2(7, 7)));
  EXPECT_FALSE(circleThrough(Vector2(2, 3), Vector2(2, 3), Vector2(7, 7)));
  EXPECT_FALSE(circleThrough(Vector3(2, 3, 4), Vector3(2, 3, 4), Vector3(2, 3, 4)));
  EXPECT_FALSE(planeThrough(Vector3(0, 0, 0), Vector3(0.1, 0.2, 0.3), Vector3(1, 2, 3)));
  EXPECT_FALSE(circleThrough(Vector2(0, 0), Vector2(1, std::nan("")), Vector2(7, 7)));
}

TEST(SphereThrough, FourPoints) {
  const Vector3 centre(1, -2, 3);
  const auto sphere = sphereThrough(centre + Vector3(3, 4, 0), centre + Vector3(0, -5, 0), centre + Vector3(-4, 0, 3),
                                    centre + Vector3(0, 3, -4));
  ASSERT_TRUE(sphere);
  EXPECT_LT((sphere->centre - centre).norm(), 1e-14);
  EXPECT_NEAR(sphere->radius, 5, 1e-14);
  EXPECT_FALSE(sphereThrough({0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {5, 7, 1}));
}

TEST(PlaneThrough, NormalSeesThePointsCounterClockwise) {
  const auto plane = planeThrough({0, 0, 2}, {3, 0, 2}, {0, 3, 2});
  ASSERT_TRUE(plane);
  EXPECT_LT((plane->normal - Vector3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((plane->point - Vector3(1, 1, 2)).norm(), 1e-15);
  EXPECT_LT((oriented(*plane, -Vector3::UnitZ()).normal + Vector3::UnitZ()).norm(), 1e-15);
}

TEST(Angles, AreExactNearZeroAndStraight) {
  const double small = 1e-9;  // degrees
  const double radians = radiansFromDegrees(small);
  EXPECT_NEAR(angleBetween({1, 0, 0}, {std::cos(radians), std::sin(radians), 0}), small, 1e-16);
  EXPECT_NEAR(angleBetween({1, 0, 0}, {-1, 0, 0}), 180, 1e-13);
  EXPECT_NEAR(signedAngle({1, 0}, {0, -2}), -90, 1e-13);
  EXPECT_NEAR(signedAngle({1, 0}, {-3, 0}), 180, 1e-13);
  EXPECT_NEAR(acuteAngle(Line2{{5, 5}, {1, 0}}, Line2{{0, 0}, {-1, 1}}), 45, 1e-13);
  EXPECT_NEAR(acuteAngle(Line{{0, 0, 0}, {1, 0, 0}}, Line{{0, 9, 5}, {-1, 0, 1}}), 45, 1e-13);
  EXPECT_NEAR(acuteAngle(Plane{{0, 0, 0}, {0, 0, 1}}, Plane{{0, 0, 0}, {0, 1, -1}}), 45, 1e-13);
  EXPECT_NEAR(acuteAngle(Line{{0, 0, 0}, {0, 1, std::sqrt(3.0)}}, Plane{{0, 0, 0}, {0, 0, -1}}), 60, 1e-13);
}

TEST(Intersections, OfLinesAndPlanes) {
  const auto cross = intersection(Line2{{0, 1}, {2, 0}}, Line2{{4, 0}, {0, 5}});
  ASSERT_TRUE(cross);
  EXPECT_LT((*cross - Vector2(4, 1)).norm(), 1e-15);
  EXPECT_EQ(intersection(Line2{{0, 1}, {2, 1}}, Line2{{4, 0}, {-4, -2}}).error().message,
            "the two lines are parallel and do not intersect");

  const auto pierced = intersection(Line{{1, 2, 9}, {0, 0, 3}}, Plane{{0, 0, 0}, {1, 1, 1}});
  ASSERT_TRUE(pierced);
  EXPECT_LT((*pierced - Vector3(1, 2, -3)).norm(), 1e-15);
  EXPECT_FALSE(intersection(Line{{1, 2, 9}, {1, -1, 0}}, Plane{{0, 0, 0}, {1, 1, 1}}));

  // x = 3 and y + z = 2
  const auto edge = intersection(Plane{{3, 7, 9}, {2, 0, 0}}, Plane{{8, 2, 0}, {0, 1, 1}});
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->point.x(), 3, 1e-14);
  EXPECT_NEAR(edge->point.y() + edge->point.z(), 2, 1e-14);
  EXPECT_LT((edge->direction - Vector3(0, -1, 1) / std::sqrt(2.0)).norm(), 1e-15);
  EXPECT_FALSE(intersection(Plane{{0, 0, 0}, {0, 0, 1}}, Plane{{0, 0, 5}, {0, 0, -1}}));

  const auto corner =
      intersection(Plane{{3, 7, 9}, {2, 0, 0}}, Plane{{8, 2, 0}, {0, 1, 1}}, Plane{{1, 5, 1}, {0, 1, 0}});
  ASSERT_TRUE(corner);
  EXPECT_LT((*corner - Vector3(3, 5, -3)).norm(), 1e-14);
  EXPECT_FALSE(intersection(Plane{{0, 0, 0}, {1, 0, 0}}, Plane{{0, 0, 0}, {0, 1, 0}}, Plane{{0, 0, 0}, {1, 1, 0}}));
}

TEST(Distances, AreSignedWhereTheShapeHasSides) {
  EXPECT_DOUBLE_EQ(distance(Vector2(0, 2), Line2{{5, 0}, {4, 0}}), 2);
  EXPECT_DOUBLE_EQ(distance(Vector2(0, -2), Line2{{5, 0}, {4, 0}}), -2);
  EXPECT_DOUBLE_EQ(distance(Vector2(3, 4), Circle2{{0, 0}, 6}), -1);
  EXPECT_DOUBLE_EQ(distance(Vector3(3, 4, 8), Line{{0, 0, 0}, {0, 0, 2}}), 5);
  EXPECT_DOUBLE_EQ(distance(Vector3(3, 4, 8), Plane{{0, 0, 9}, {0, 0, 2}}), -1);
  EXPECT_DOUBLE_EQ(distance(Vector3(3, 4, 8), Cylinder{{0, 0, 0}, {0, 0, 1}, 4}), 1);
  EXPECT_DOUBLE_EQ(distance(Vector3(3, 4, 0), Sphere{{0, 0, 0}, 7}), -2);
  EXPECT_DOUBLE_EQ(distance(Line{{0, 0, 0}, {1, 0, 0}}, Line{{9, 9, 3}, {0, 1, 0}}), 3);
  EXPECT_DOUBLE_EQ(distance(Line{{0, 0, 0}, {1, 0, 0}}, Line{{9, 3, 4}, {-2, 0, 0}}), 5);
}

TEST(Projections, ArePerpendicularFeet) {
  EXPECT_LT((projection(Vector2(3, 4), Line2{{0, 1}, {5, 0}}) - Vector2(3, 1)).norm(), 1e-15);
  EXPECT_LT((projection(Vector3(3, 4, 5), Line{{0, 0, 0}, {0, 0, 2}}) - Vector3(0, 0, 5)).norm(), 1e-15);
  EXPECT_LT((projection(Vector3(3, 4, 5), Plane{{0, 0, 1}, {0, 0, -3}}) - Vector3(3, 4, 1)).norm(), 1e-15);
}

}  // namespace
}  // namespace probewright::metrology
