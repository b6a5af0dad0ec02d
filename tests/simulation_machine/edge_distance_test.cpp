#include "simulation/edge_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

/// Planes that bound solids.
namespace probewright::simulation {
namespace {

TEST(PlaneBeside, IsTheSupportOfTheSolidWhereverThatStands) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 100; ++i) {
    const Vector3 corner = 300 * Vector3(gauss(random), gauss(random), gauss(random));
    const Vector3 size(30, 50, 20);
    const Vector3 normal = Vector3(gauss(random), gauss(random), gauss(random)).normalized();
    const Plane plane = planeBeside(Box(corner, corner + size), normal);
    double farthest = -1e9;
    for (int k = 0; k < 8; ++k) {
      const Vector3 p = corner + Vector3(k & 1 ? size.x() : 0, k & 2 ? size.y() : 0, k & 4 ? size.z() : 0);
      farthest = std::max(farthest, normal.dot(p - plane.point));
    }
    EXPECT_LT(farthest, 1e-6) << "never too near";
    EXPECT_GT(farthest, -1e-5);
  }
}

}  // namespace
}  // namespace probewright::simulation
