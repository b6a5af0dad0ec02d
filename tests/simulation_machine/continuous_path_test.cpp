#include "simulation/continuous_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace probewright::simulation {
namespace {

machine::AxisPositions along(double x, double y) {
  machine::AxisPositions way;
  way[0] = x;
  way[1] = y;
  return way;
}

TEST(ContinuousPath, AStraightLineInPiecesTakesTheTimeOfOneMove) {
  // 1000 mm at 50 mm/s and 2000 mm/s2: 20 s and 25 ms of changing speed. Each piece of 2 mm is long enough to stop in.
  ContinuousPath path;
  double seconds = 0;
  for (int i = 0; i < 500; ++i)
    seconds += path.join(along(1.2, 1.6), MotionProfile(2, 50, 2000));
  EXPECT_NEAR(seconds, 20 + 0.025, 1e-9);
}

TEST(ContinuousPath, ShortPiecesArePassedNoFasterThanTheNextOneAllowsToStop) {
  // Pieces of 0.1 mm: 20 mm/s at their ends, sqrt(20 * 20 + 2000 * 0.1) in their middle.
  const auto secondsOf = [](int pieces) {
    ContinuousPath path;
    double seconds = 0;
    for (int i = 0; i < pieces; ++i)
      seconds += path.join(along(0.1, 0), MotionProfile(0.1, 50, 2000));
    return seconds;
  };
  EXPECT_NEAR((secondsOf(1500) - secondsOf(500)) / 1000, 2 * (std::sqrt(600) - 20) / 2000, 1e-9);
}

TEST(ContinuousPath, ARightAngleIsPassedAtTheSpeedOfItsArc) {
  // An arc that leaves a right angle by 0.01 mm has the radius 0.01 / (sqrt(2) - 1) mm.
  const double corner = std::sqrt(2000 * 0.01 / (std::numbers::sqrt2 - 1));
  const double alone = MotionProfile(20, 50, 2000).duration();
  ContinuousPath path;
  const double seconds =
      path.join(along(20, 0), MotionProfile(20, 50, 2000)) + path.join(along(0, 20), MotionProfile(20, 50, 2000));
  // Instead of braking to standstill and accelerating again over a way that 50 mm/s would take less time for.
  const double saved = 2 * (corner / 2000 - corner * corner / (2 * 2000) / 50);
  EXPECT_NEAR(seconds, 2 * alone - saved, 1e-9);
  EXPECT_LT(corner, 10);
}

TEST(ContinuousPath, AWayBackAndAStopSaveNothing) {
  const MotionProfile move(5, 50, 2000);
  ContinuousPath back;
  EXPECT_NEAR(back.join(along(5, 0), move) + back.join(along(-5, 0), move), 2 * move.duration(), 1e-9);
  ContinuousPath stopped;
  const double first = stopped.join(along(5, 0), move);
  stopped.stop();
  EXPECT_NEAR(first + stopped.join(along(5, 0), move), 2 * move.duration(), 1e-9);
}

TEST(ContinuousPath, NeverRunsBackwardsNorFasterThanItsFeed) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(-3.2, 3.2), length(0.01, 30), speed(1, 200), acceleration(100, 9000);
  ContinuousPath path;
  double seconds = 0, least = 0, alone = 0;
  for (int i = 0; i < 20000; ++i) {
    const double l = length(random), v = speed(random), a = angle(random);
    const MotionProfile move(l, v, acceleration(random));
    const double added = path.join(along(l * std::cos(a), l * std::sin(a)), move);
    EXPECT_GE(added, 0);
    seconds += added;
    least += l / v;
    alone += move.duration();
  }
  EXPECT_GT(seconds, least);
  EXPECT_LT(seconds, alone);
}

}  // namespace
}  // namespace probewright::simulation
