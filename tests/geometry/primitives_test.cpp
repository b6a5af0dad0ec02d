#include "geometry/primitives.hpp"

#include <gtest/gtest.h>

namespace probewright {
namespace {

TEST(Rotation, IsRightHanded) {
  const Vector3 turned = rotation(Vector3::UnitZ(), 90) * Vector3::UnitX();
  EXPECT_LT((turned - Vector3::UnitY()).norm(), 1e-15);
}

TEST(NormalizedDegrees, FoldsIntoTheHalfOpenTurn) {
  EXPECT_DOUBLE_EQ(normalizedDegrees(190), -170);
  EXPECT_DOUBLE_EQ(normalizedDegrees(-180), 180);
  EXPECT_DOUBLE_EQ(normalizedDegrees(180), 180);
  EXPECT_DOUBLE_EQ(normalizedDegrees(720.5), 0.5);
}

}  // namespace
}  // namespace probewright
