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

/// The least distance from a plane that turns about an axis, by trying angles, and its direction there.
TEST(TurnsBehindPlane, IsAsFarAsThePlaneThatComesNearest) {
  std::mt19937_64 random(12);
  std::normal_distribution<double> gauss;
  const auto vector = [&] { return Vector3(gauss(random), gauss(random), gauss(random)); };
  for (const double angle : {0.3, 1.5, 3.5, 6.0}) {
    for (int i = 0; i < 30; ++i) {
      const Plane plane{20 * vector(), vector().normalized()};
      const Line axis{20 * vector(), vector().normalized()};
      const Vector3 point = 50 * vector();
      double least = 1e9;
      constexpr int tries = 2000;
      for (int k = 0; k <= tries; ++k) {
        const Vector3 turned = axis.point + Eigen::AngleAxisd(angle * k / tries, axis.direction) * (point - axis.point);
        least = std::min(least, plane.normal.dot(turned - plane.point));
      }
      const ClosestPoint found = TurnsBehindPlane(plane, axis, angle).closest(point);
      EXPECT_NEAR(found.distance, least, 1e-3) << angle;
      EXPECT_NEAR(found.normal.norm(), 1, 1e-12);
      EXPECT_NEAR((point - found.point).dot(found.normal), found.distance, 1e-9);
    }
  }
}

/// A straight edge beside the plane of its meridian, in front of a sphere: as near as the segment is to the centre.
TEST(NearestOf, KnowsHowFarAnEdgeStandsAside) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 100; ++i) {
    EdgePiece piece;
    piece.from = Vector2(10 + any(random), 5 * any(random));
    piece.to = Vector2(14 + any(random), 20 + any(random));
    piece.angle = 3 * any(random);
    piece.across = 4 * any(random);
    const auto placeOf = [&](const Vector2& end) -> Vector3 {
      return Eigen::AngleAxisd(piece.angle, Vector3::UnitZ()) * Vector3(end.x(), piece.across, end.y());
    };
    const Vector3 from = placeOf(piece.from), along = placeOf(piece.to) - from;
    const Vector3 centre(30 * any(random), 30 * any(random), 10 + 10 * any(random));
    const double share = std::clamp((centre - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    EXPECT_NEAR(nearestOf({piece}, Pose::Identity(), SolidSphere(centre, 2)).gap,
                (from + share * along - centre).norm() - 2, 1e-9);
  }
}

}  // namespace
}  // namespace probewright::simulation
