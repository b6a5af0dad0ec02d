#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "klartext/host_world.hpp"

/// What tests of the host look at: points, and runs that reach their end.
namespace probewright::language::klartext::testing {

inline ::testing::AssertionResult near(const Vector3& actual, const Vector3& expected, double tolerance = 1e-9) {
  if ((actual - expected).norm() <= tolerance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << actual.transpose() << " instead of " << expected.transpose();
}

inline void expectFinished(const RunResult& result) {
  EXPECT_EQ(result.end, RunEnd::Finished);
  for (const Diagnostic& diagnostic : result.diagnostics)
    ADD_FAILURE() << format(diagnostic);
}

inline void expectPath(const World& world, const std::vector<Vector3>& expected, double tolerance = 1e-9) {
  const std::vector<Vector3> path = world.path();
  ASSERT_EQ(path.size(), expected.size());
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_TRUE(near(path[i], expected[i], tolerance)) << "point " << i;
}

}  // namespace probewright::language::klartext::testing
