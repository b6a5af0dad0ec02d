#include "geometry/decompositions.hpp"

#include <gtest/gtest.h>

namespace probewright {
namespace {

TEST(ShortestTurn, LeadsFromOneDirectionToTheOther) {
  const Vector3 from(3, 0, 0);
  const Vector3 to = rotation(Vector3::UnitZ(), 30) * Vector3(2, 0, 0);
  const Eigen::AngleAxisd turn(shortestTurn(from, to));
  EXPECT_NEAR(degreesFromRadians(turn.angle()), 30, 1e-12);
  EXPECT_LT((turn.axis() - Vector3::UnitZ()).norm(), 1e-12);
}

TEST(ShortestTurn, BetweenOppositeDirectionsIsHalfATurn) {
  const Vector3 direction = Vector3(1, -2, 3).normalized();
  const Eigen::Quaterniond turn = shortestTurn(direction, -direction);
  EXPECT_LT((turn * direction + direction).norm(), 1e-7);
  EXPECT_NEAR(Eigen::AngleAxisd(turn).axis().dot(direction), 0, 1e-7);
}

TEST(SolveLinear, SolvesAndComesClosestWhereNothingSolves) {
  Matrix3 matrix;
  matrix << 2, 0, 1, 0, 3, 0, 1, 0, -1;
  EXPECT_LT((solveLinear(matrix, Vector3(5, 6, 1)) - Vector3(2, 2, 1)).norm(), 1e-14);
  // Without its third axis: nothing can be done about the third component.
  const Matrix3 flat = Vector3(2, 4, 0).asDiagonal();
  EXPECT_LT((solveLinear(flat, Vector3(6, 8, 5)) - Vector3(3, 2, 0)).norm(), 1e-14);
}

}  // namespace
}  // namespace probewright
