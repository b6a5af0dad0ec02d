#include "simulation/analytic_solids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace probewright::simulation {
namespace {

/// A way that runs straight at `target` (the ball's centre at contact) and ends beyond it.
struct Approach {
  Vector3 from, to;
};

class AnalyticSolids : public testing::Test {
protected:
  std::mt19937_64 random{7};
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vector3 unit() {
    std::normal_distribution<double> gauss;
    return Vector3(gauss(random), gauss(random), gauss(random)).normalized();
  }
  /// Comes out of free space towards the surface whose outward normal is `normal`, at up to 70 degrees to it.
  Approach towards(const Vector3& target, const Vector3& normal) {
    Vector3 direction;
    do {
      direction = unit();
    } while (direction.dot(normal) > -0.35);
    return {target - direction * uniform(0.01, 2), target + direction * uniform(0.01, 1)};
  }
  void expectContact(const Solid& solid, const Approach& way, double radius, const Vector3& centre,
                     const Vector3& normal) {
    const auto contact = solid.firstContact(way.from, way.to, radius);
    ASSERT_TRUE(contact);
    EXPECT_LT((contact->ballCentre - centre).norm(), 1e-9);
    EXPECT_LT((contact->normal - normal).norm(), 1e-8);
    EXPECT_LT((contact->touchPoint - (centre - radius * normal)).norm(), 1e-9);
    EXPECT_NEAR(contact->fraction, (centre - way.from).norm() / (way.to - way.from).norm(), 1e-9);
  }
};

TEST_F(AnalyticSolids, HalfSpaceIsMetOneRadiusBeforeThePlane) {
  for (int i = 0; i < 500; ++i) {
    const Plane plane{Vector3(uniform(-50, 50), uniform(-50, 50), uniform(-50, 50)), unit()};
    const double radius = uniform(0.1, 5);
    const Vector3 along = plane.normal.unitOrthogonal() * uniform(-100, 100);
    const Vector3 centre = plane.point + along + plane.normal * radius;
    expectContact(HalfSpace(plane), towards(centre, plane.normal), radius, centre, plane.normal);
  }
}

TEST_F(AnalyticSolids, BoxIsMetOnFacesEdgesAndCorners) {
  const Box box({-10, -20, -30}, {15, 25, 35});
  for (int i = 0; i < 2000; ++i) {
    // A point of the box's surface and a direction in its cone of normals.
    Vector3 point, normal = Vector3::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
      const int place = std::uniform_int_distribution<int>(-1, 1)(random);
      const double low = box.bounds().minimum[k], high = box.bounds().maximum[k];
      point[k] = place < 0 ? low : place > 0 ? high : uniform(low, high);
      normal[k] = place * uniform(0.2, 1);
    }
    if (normal.norm() == 0) continue;
    normal.normalize();
    const double radius = uniform(0.5, 4);
    const Vector3 centre = point + radius * normal;
    const Approach way = towards(centre, normal);
    // Only ways that do not meet another face first.
    bool free = true;
    for (int k = 0; k < 200; ++k) {
      const Vector3 p = way.from + (centre - way.from) * (k / 200.0);
      free = free && box.closest(p).distance > radius + 1e-9;
    }
    if (free) expectContact(box, way, radius, centre, normal);
  }
}

TEST_F(AnalyticSolids, SphereBarAndBoreAreMetOnTheirOffset) {
  for (int i = 0; i < 1000; ++i) {
    const double big = uniform(10, 40), radius = uniform(0.2, 5);
    const Vector3 centre(uniform(-9, 9), uniform(-9, 9), uniform(-9, 9));
    const Vector3 n = unit();
    const Vector3 ball = centre + (big + radius) * n;
    expectContact(SolidSphere(centre, big), towards(ball, n), radius, ball, n);

    const Vector3 flat = Vector3(n.x(), n.y(), 0).normalized();
    const Vector3 axisPoint(centre.x(), centre.y(), uniform(-50, 50));
    const Vector3 outside = axisPoint + (big + radius) * flat;
    expectContact(EndlessBar(centre.head<2>(), big), towards(outside, flat), radius, outside, flat);
    const Vector3 inside = axisPoint + (big - radius) * flat;
    expectContact(EndlessBore(centre.head<2>(), big), towards(inside, -flat), radius, inside, -flat);
  }
}

TEST_F(AnalyticSolids, RimsOfRingAndRoundBarAreMetOnTheirTorus) {
  for (int i = 0; i < 1000; ++i) {
    const double radius = uniform(0.5, 4), around = uniform(0, 2 * std::numbers::pi), tilt = uniform(0.1, 1.4);
    const Vector3 outwards(std::cos(around), std::sin(around), 0);
    const Vector3 barNormal = std::cos(tilt) * outwards + std::sin(tilt) * Vector3::UnitZ();
    const Vector3 barCentre = 20 * outwards + 10 * Vector3::UnitZ() + radius * barNormal;
    expectContact(RoundBar(20, 0, 10), {barCentre + barNormal, barCentre - barNormal}, radius, barCentre, barNormal);
    const Vector3 ringNormal = -std::cos(tilt) * outwards + std::sin(tilt) * Vector3::UnitZ();
    const Vector3 ringCentre = 20 * outwards + radius * ringNormal;
    expectContact(Ring(20, 60, -15), {ringCentre + ringNormal, ringCentre - ringNormal}, radius, ringCentre,
                  ringNormal);
  }
}

TEST_F(AnalyticSolids, PassingIsNoContact) {
  const Box box({-10, -10, -10}, {10, 10, 10});
  EXPECT_FALSE(box.firstContact({-30, 0, 12.001}, {30, 0, 12.001}, 2));
  EXPECT_FALSE(box.firstContact({-30, 0, 12}, {30, 0, 12}, 2)) << "gliding along a face is no contact";
  EXPECT_TRUE(box.firstContact({-30, 0, 11.999}, {30, 0, 11.999}, 2));
  EXPECT_FALSE(box.firstContact({0, 0, 12}, {0, 0, 20}, 2)) << "leaving a face is no contact";
  EXPECT_EQ(box.firstContact({0, 0, 11.9}, {0, 0, 20}, 2)->fraction, 0) << "an overlap at the start is contact at once";
  EXPECT_TRUE(box.firstContact({0, 0, 11.9}, {0, 0, 11.9}, 2)) << "a ball at rest that overlaps is in contact";
  EXPECT_FALSE(box.firstContact({0, 0, 12}, {0, 0, 12}, 2));
}

TEST_F(AnalyticSolids, CapsuleMeetsABoxWithItsShaft) {
  const Box box({-10, -10, -10}, {10, 10, 10});
  // A vertical capsule of radius 3 comes from +X and meets the face x = 10 with its side.
  const auto side = box.firstCapsuleContact({30, 0, -30}, {0, 0, -30}, {0, 0, 100}, 3);
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->ballCentre.x(), 13, 1e-3);
  // From above it meets the top with its lower end.
  const auto end = box.firstCapsuleContact({0, 0, 30}, {0, 0, 0}, {0, 0, 100}, 3);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->ballCentre.z(), 13, 1e-3);
  EXPECT_FALSE(box.firstCapsuleContact({14, -30, -30}, {14, 30, -30}, {0, 0, 100}, 3));
}

}  // namespace
}  // namespace probewright::simulation
