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

TEST(CircleThrough, RefusesCollinearAndCoincidentPoints) {
  EXPECT_FALSE(circleThrough(Vector2(0, 0), Vector2(1, 1), Vector2(7, 7)));
  EXPECT_FALSE(circleThrough(Vector2(2, 3), Vector2(2, 3), Vector2(7, 7)));
  EXPECT_FALSE(circleThrough(Vector2(0, 0), Vector2(1, std::nan("")), Vector2(7, 7)));
}

TEST(Intersections, OfLines) {
  const auto cross = intersection(Line2{{0, 1}, {2, 0}}, Line2{{4, 0}, {0, 5}});
  ASSERT_TRUE(cross);
  EXPECT_LT((*cross - Vector2(4, 1)).norm(), 1e-15);
  EXPECT_EQ(intersection(Line2{{0, 1}, {2, 1}}, Line2{{4, 0}, {-4, -2}}).error().message,
            "the two lines are parallel and do not intersect");
}

}  // namespace
}  // namespace probewright::metrology
