#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metrology/fits.hpp"

namespace probewright::metrology {
namespace {

using Points2 = std::vector<Vector2>;
using Points3 = std::vector<Vector3>;

template <class T>
std::string reason(const Result<T>& result) {
  if (result) return "(no failure)";
  return result.error().message;
}

TEST(TooFewPoints, AreCountedInTheMessage) {
  EXPECT_EQ(reason(fitCircle(std::span<const Vector2>(Points2{{0, 0}, {1, 0}}))),
            "a circle needs at least 3 points, 2 were given");
  EXPECT_EQ(reason(fitLine(std::span<const Vector2>(Points2{{0, 0}}))), "a line needs at least 2 points, 1 was given");
  EXPECT_EQ(reason(fitPlane(Points3{{0, 0, 0}, {1, 0, 0}})), "a plane needs at least 3 points, 2 were given");
  EXPECT_EQ(reason(fitSphere(Points3{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})),
            "a sphere needs at least 4 points, 3 were given");
  EXPECT_EQ(reason(fitLine(std::span<const Vector3>())), "a line needs at least 2 points, 0 were given");
}

TEST(CoincidentPoints, DetermineNothing) {
  const Points3 same(8, Vector3(1, 2, 3));
  const Points2 flat(8, Vector2(1, 2));
  for (const std::string& text :
       {reason(fitLine(std::span<const Vector2>(flat))), reason(fitLine(std::span<const Vector3>(same))),
        reason(fitPlane(same)), reason(fitCircle(std::span<const Vector2>(flat))),
        reason(fitCircle(std::span<const Vector3>(same))), reason(fitSphere(same))}) {
    EXPECT_EQ(text, "all points coincide");
  }
}

TEST(NotFinite, NamesThePoint) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reason(fitCircle(std::span<const Vector2>(Points2{{0, 0}, {1, nothing}, {0, 1}}))),
            "coordinate of point 2 is not a finite number");
}

TEST(CollinearPoints, GiveNoCircleAndNoPlane) {
  Points2 flat;
  Points3 space;
  for (int i = 0; i < 7; ++i) {
    flat.emplace_back(1 + 0.1 * i, 2 - 0.3 * i);
    space.emplace_back(1 + 0.1 * i, 2 - 0.3 * i, 0.7 * i);
  }
  EXPECT_EQ(reason(fitCircle(std::span<const Vector2>(flat))),
            "the points lie on one straight line, so no circle is determined");
  EXPECT_EQ(reason(fitCircle(std::span<const Vector3>(space))),
            "the points lie on one straight line, so no circle is determined");
  EXPECT_EQ(reason(fitPlane(space)), "the points lie on one straight line, so no plane is determined");
  EXPECT_EQ(reason(fitSphere(space)), "the points lie on one plane, so no sphere is determined");
}

TEST(CollinearPoints, AlsoWithTwoPointsProbedTwice) {
  EXPECT_FALSE(fitCircle(std::span<const Vector2>(Points2{{0, 0}, {10, 3}, {0, 0}, {10, 3}})));
}

TEST(CoplanarPoints, GiveNoSphere) {
  Points3 ring;
  for (int i = 0; i < 8; ++i)
    ring.emplace_back(10 * std::cos(0.785 * i), 10 * std::sin(0.785 * i), 4);
  EXPECT_EQ(reason(fitSphere(ring)), "the points lie on one plane, so no sphere is determined");
}

TEST(PointsWithoutDirection, GiveNoLine) {
  const Points2 square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(reason(fitLine(std::span<const Vector2>(square))),
            "the points have no preferred direction, so no line fits them best");
  const Points3 cube = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  EXPECT_EQ(reason(fitPlane(cube)), "the points have no preferred plane, so no plane fits them best");
}

TEST(Extremes, NeverHang) {
  EXPECT_FALSE(fitCircle(std::span<const Vector2>(Points2{{1e300, 0}, {0, 1e300}, {-1e300, 0}, {0, 1}})));
  EXPECT_FALSE(fitCircle(std::span<const Vector2>(Points2{{1e308, 0}, {0, 1e308}, {-1e308, 0}, {0, 1}})));
}

}  // namespace
}  // namespace probewright::metrology
