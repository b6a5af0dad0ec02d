#include <gtest/gtest.h>

#include "simulation/analytic_solids.hpp"
#include "simulation/mesh_solid.hpp"
#include "simulation/solid_recipe.hpp"
#include "simulation/sweep.hpp"
#include "worlds.hpp"

/// Probe bodies and mills: cylinders with flat ends and sharp edges.
namespace probewright::simulation {
namespace {

using testing::randomDirection;
using testing::randomPoint;
using testing::uniform;

double distanceFromCylinder(const Vector3& p, const Vector3& base, const Vector3& axis, double radius) {
  const double height = axis.norm();
  const Vector3 arm = p - base;
  const double along = arm.dot(axis) / height;
  const double aside = (arm - along / height * axis).norm();
  return std::hypot(std::max({along - height, -along, 0.0}), std::max(aside - radius, 0.0));
}

/// The least value of a convex function over [0, 1].
template <class Function>
double leastOf(const Function& f) {
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double a = low + (high - low) * 0.382, b = low + (high - low) * 0.618;
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return std::min({f((low + high) / 2), f(0.0), f(1.0)});
}

/// The distance of a cylinder from a triangle: a convex function of the place on the triangle.
double distanceOfCylinder(const Vector3& base, const Vector3& axis, double radius, const Triangle& t) {
  return leastOf([&](double s) {
    const Vector3 from = t[0] + s * (t[1] - t[0]);
    const Vector3 to = t[0] + s * (t[2] - t[0]);
    return leastOf([&](double r) { return distanceFromCylinder(from + r * (to - from), base, axis, radius); });
  });
}

TEST(CylinderSweep, MeetsATriangleWhereTheNearestPointsMeet) {
  std::mt19937_64 random(31);
  int contacts = 0;
  for (int i = 0; i < 150; ++i) {
    const Triangle t{randomPoint(random, 20), randomPoint(random, 20), randomPoint(random, 20)};
    const double radius = uniform(random, 0.5, 15);
    Vector3 axis = uniform(random, 1, 40) * randomDirection(random);
    const Vector3 from = 70 * randomDirection(random);
    Vector3 to = from + uniform(random, 0.3, 2) * (randomPoint(random, 20) - from);
    if (i % 4 == 0) axis = (i % 8 == 0 ? 20 : -20) * (to - from).normalized();
    if (i % 7 == 0) axis = 10 * (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    if (i % 9 == 0) axis = 15 * (t[1] - t[0]).normalized();
    const Way way = wayBetween(from, to);
    Meeting meeting;
    sweepCylinder(way, radius, axis, t, meeting);
    if (!meeting.found()) {
      for (int k = 0; k <= 6; ++k)
        ASSERT_GT(distanceOfCylinder(way.at(way.length * k / 6), axis, radius, t), 0) << i;
      continue;
    }
    ++contacts;
    ASSERT_GE(meeting.when, -1e-6);
    const double when = std::max(0.0, meeting.when);
    ASSERT_LT(distanceOfCylinder(way.at(when), axis, radius, t), 1e-6) << i;
    ASSERT_LT((closestOnTriangle(meeting.point, t) - meeting.point).norm(), 1e-9) << i;
    if (when <= 1e-3) continue;
    ASSERT_GT(distanceOfCylinder(way.at(when - 1e-3), axis, radius, t), 0) << i;
  }
  EXPECT_GT(contacts, 40);
}

/// A cylinder that stands in a triangle at the start meets it at once, where its axis pierces it.
TEST(CylinderSweep, MeetsATriangleThatItStandsInWhereItsAxisPiercesIt) {
  std::mt19937_64 random(32);
  for (int i = 0; i < 50; ++i) {
    const Triangle t{randomPoint(random, 20), randomPoint(random, 20), randomPoint(random, 20)};
    const double a = uniform(random, 0.1, 0.8), b = uniform(random, 0.1, 0.9 - a);
    const Vector3 pierced = t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
    const Vector3 up = randomDirection(random), base = pierced - uniform(random, 5, 15) * up;
    const Way way = wayBetween(base, base + 10 * randomDirection(random));
    Meeting meeting;
    ASSERT_TRUE(sweepCylinder(way, 2, 20 * up, t, meeting)) << i;
    EXPECT_LE(meeting.when, 0) << i;
    EXPECT_LT((meeting.point - pierced).norm(), 1e-7) << i;
  }
}

/// A thin pin under a wide body stops it where the body's flat end meets the pin's top, at any place under it.
TEST(CylinderContact, AFlatEndHasNoGapsAndNoDome) {
  SolidFeature pin;
  pin.shape = FeatureShape::Cylinder;
  pin.diameter = 1;
  pin.height = 60;
  pin.centre.z() = -60;
  const auto part = buildSolid({{pin}});
  ASSERT_TRUE(part);
  for (const double place : {0.0, 12.0, 20.0, 26.0, 29.0, 30.2}) {
    for (const double degrees : {0.0, 15.0, 30.0, 45.0, 200.0}) {
      const Vector3 base = rotation(Vector3::UnitZ(), degrees) * Vector3(place, 0, 0);
      const auto contact =
          (*part)->firstCylinderContact(base + Vector3(0, 0, 80), base - Vector3(0, 0, 40), {0, 0, 100}, 30);
      ASSERT_TRUE(contact) << place;
      EXPECT_NEAR(contact->ballCentre.z(), 0, 1e-6) << place << " at " << degrees;
      EXPECT_NEAR(contact->touchPoint.z(), 0, 1e-6);
      EXPECT_NEAR(contact->normal.z(), 1, 1e-9);
    }
  }
  EXPECT_FALSE((*part)->firstCylinderContact({30.52, 0, 80}, {30.52, 0, -40}, {0, 0, 100}, 30));
  const auto side = (*part)->firstCylinderContact({60, 0, -5}, {0, 0, -5}, {0, 0, 100}, 30);
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->ballCentre.x(), 30.5, 0.01);
  EXPECT_FALSE((*part)->firstCylinderContact({60, 0, 1e-6}, {0, 0, 1e-6}, {0, 0, 100}, 30)) << "just above";
  EXPECT_EQ((*part)->firstCylinderContact({0, 0, -5}, {60, 0, -5}, {0, 0, 100}, 30)->fraction, 0) << "overlapping";
}

TEST(CylinderContact, ASlantedCylinderMeetsAPlaneWithItsEdge) {
  const Box box({-100, -100, -50}, {100, 100, 0});
  TriangleMesh plate;
  plate.corners = {{-100, -100, 0}, {100, -100, 0}, {100, 100, 0}, {-100, 100, 0}};
  plate.triangles = {{0, 1, 2}, {0, 2, 3}};
  const MeshSolid mesh(plate);
  for (const double tilt : {0.0, 5.0, 30.0, 80.0}) {
    const Vector3 axis = rotation(Vector3::UnitY(), tilt) * Vector3(0, 0, 40);
    // The lowest point of the rim is the radius times the sine of the tilt below the middle of the lower end.
    const double expected = 12 * std::sin(radiansFromDegrees(tilt));
    for (const Solid* solid : {static_cast<const Solid*>(&box), static_cast<const Solid*>(&mesh)}) {
      const auto contact = solid->firstCylinderContact({3, 4, 60}, {3, 4, -30}, axis, 12);
      ASSERT_TRUE(contact);
      EXPECT_NEAR(contact->ballCentre.z(), expected, solid == &box ? 2e-3 : 1e-6) << tilt;
    }
  }
}

TEST(CylinderContact, SearchesFindWhatALookAtEveryTriangleFinds) {
  std::mt19937_64 random(32);
  TriangleMesh heap;
  for (int i = 0; i < 400; ++i) {
    const Vector3 place = randomPoint(random, 40);
    for (std::uint32_t k = 0; k < 3; ++k)
      heap.corners.push_back(place + randomPoint(random, 6));
    const auto first = static_cast<std::uint32_t>(3 * i);
    heap.triangles.push_back({first, first + 1, first + 2});
  }
  for (const Instructions instructions : {Instructions::Plain, bestInstructions()}) {
    const MeshSolid solid(heap, instructions);
    int contacts = 0;
    for (int i = 0; i < 500; ++i) {
      const Vector3 from = 150 * randomDirection(random);
      const Vector3 to = randomPoint(random, 40);
      const Vector3 axis = uniform(random, 1, 60) * (i % 3 == 0 ? Vector3(Vector3::UnitZ()) : randomDirection(random));
      const double radius = uniform(random, 0.2, 25);
      Meeting expected;
      for (const auto& t : heap.triangles)
        sweepCylinder(wayBetween(from, to), radius, axis, {heap.corners[t[0]], heap.corners[t[1]], heap.corners[t[2]]},
                      expected);
      const auto found = solid.firstCylinderContact(from, to, axis, radius);
      ASSERT_EQ(found.has_value(), expected.found()) << i;
      if (!found) continue;
      ++contacts;
      ASSERT_NEAR((found->ballCentre - from).norm(), std::max(0.0, expected.when), 1e-5) << i;
    }
    EXPECT_GT(contacts, 200);
  }
}

}  // namespace
}  // namespace probewright::simulation
