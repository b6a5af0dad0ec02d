#include "simulation/path_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace probewright::simulation {
namespace {

/// From `point` to the piece of the path on the way at the same time.
double distanceFromPath(const PathPoint& point, const std::vector<PathPoint>& path) {
  const auto end = std::ranges::lower_bound(path, point.seconds, {}, &PathPoint::seconds);
  if (end == path.begin() || end == path.end()) return (point.tip - path[0].tip).norm();
  const Vector3 from = (end - 1)->tip, way = end->tip - from;
  const double square = way.squaredNorm();
  const double share = square > 0 ? std::clamp((point.tip - from).dot(way) / square, 0.0, 1.0) : 0;
  return (point.tip - from - share * way).norm();
}

TEST(PathRecord, StaysSmallAndCloseToALongPathOfMachining) {
  constexpr std::size_t most = 2000;
  std::vector<PathPoint> all;
  PathRecorder recorder({}, most);
  double length = 0;
  all.push_back({});
  for (int i = 1; i <= 60000; ++i) {
    const double turn = i * 0.01;
    all.push_back(
        {{80 * std::cos(turn), 50 * std::sin(turn), -0.002 * i}, Vector3::UnitZ(), PathKind::Feed, 0.1 * i, -1, {}});
    length += (all.back().tip - all[all.size() - 2].tip).norm();
    recorder.add(all.back());
  }
  const PathRecord& record = recorder.record();
  EXPECT_LE(record.points.size(), 2 * most + 1);
  EXPECT_NEAR(record.length, length, 1e-6);
  EXPECT_GT(record.tolerance, 0);
  EXPECT_LT(record.tolerance, 5);
  EXPECT_EQ(record.points.front().tip, all.front().tip);
  EXPECT_EQ(record.points.back().tip, all.back().tip);
  double farthest = 0;
  for (const PathPoint& point : all)
    farthest = std::max(farthest, distanceFromPath(point, record.points));
  EXPECT_LE(farthest, record.tolerance);
}

TEST(PathRecord, KeepsEveryMeasuringMoveTouchAndToolChange) {
  std::mt19937_64 random(7);
  PathRecorder recorder({}, 500);
  std::vector<Vector3> measured, touched, changed;
  Vector3 tip = Vector3::Zero();
  for (int i = 1; i <= 20000; ++i) {
    const int choice = std::uniform_int_distribution(0, 60)(random);
    const PathKind kind = choice == 0 ? PathKind::Measure : choice == 1 ? PathKind::ToolChange : PathKind::Feed;
    tip.x() += 0.5;
    tip.y() = std::sin(tip.x() / 40) * 20;
    recorder.add({tip, Vector3::UnitZ(), kind, 0.1 * i, -1, {}});
    if (kind == PathKind::ToolChange) changed.push_back(tip);
    if (kind == PathKind::Measure) measured.push_back(tip);
    if (kind == PathKind::Measure || choice == 2) {
      PathTouch touch;
      touch.kind = kind;
      touch.ballCentre = tip;
      recorder.add(touch);
      touched.push_back(tip);
    }
  }
  const PathRecord& record = recorder.record();
  EXPECT_LT(record.points.size(), 4000U);
  std::vector<Vector3> keptMeasured, keptChanged;
  for (const PathPoint& point : record.points) {
    if (point.kind == PathKind::Measure) keptMeasured.push_back(point.tip);
    if (point.kind == PathKind::ToolChange) keptChanged.push_back(point.tip);
  }
  EXPECT_EQ(keptMeasured, measured);
  EXPECT_EQ(keptChanged, changed);
  ASSERT_EQ(record.touches.size(), touched.size());
  for (std::size_t i = 0; i < touched.size(); ++i) {
    EXPECT_EQ(record.points[record.touches[i].pathPoint].tip, touched[i]) << i;
    EXPECT_EQ(record.points[record.touches[i].pathPoint].tip, record.touches[i].ballCentre) << i;
  }
}

TEST(PathRecord, LeavesAShortPathAsItIs) {
  PathRecorder recorder({}, 500);
  for (int i = 1; i <= 900; ++i)
    recorder.add({Vector3(i, 0, 0), Vector3::UnitZ(), PathKind::Rapid, 1.0 * i, -1, {}});
  EXPECT_EQ(recorder.record().points.size(), 901U);
  EXPECT_EQ(recorder.record().tolerance, 0);
}

}  // namespace
}  // namespace probewright::simulation
