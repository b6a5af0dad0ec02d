#include "simulation/path_record.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace probewright::simulation {
namespace {

constexpr double firstTolerance = 1e-3;  // mm
constexpr double lastTolerance = 1e4;    // mm
constexpr double degreesOfTurn = 2;
constexpr std::size_t longestChord = 64;  // points; keeps the time linear

double distanceFromSegment(const Vector3& point, const Vector3& from, const Vector3& to) {
  const Vector3 way = to - from;
  const double square = way.squaredNorm();
  const double share = square > 0 ? std::clamp((point - from).dot(way) / square, 0.0, 1.0) : 0;
  return (point - from - share * way).norm();
}

bool mayGo(PathKind kind) { return kind == PathKind::Rapid || kind == PathKind::Feed; }

}  // namespace

PathRecorder::PathRecorder(PathPoint start, std::size_t most) : most_(most), limit_(2 * most) {
  record_.points.push_back(std::move(start));
}

void PathRecorder::add(const PathPoint& point) {
  if (record_.points.size() >= limit_) thinOut();
  // A tool change puts the tip elsewhere without travelling.
  if (point.kind != PathKind::ToolChange) record_.length += (point.tip - record_.points.back().tip).norm();
  record_.points.push_back(point);
}

void PathRecorder::add(PathTouch touch) {
  touch.pathPoint = record_.points.size() - 1;
  record_.touches.push_back(std::move(touch));
}

void PathRecorder::thinOut() {
  if (record_.tolerance == 0) record_.tolerance = firstTolerance;
  thinOutFrom(thinned_, record_.tolerance);
  while (record_.points.size() > most_ && record_.tolerance < lastTolerance) {
    // What was left out before lies within half of the new tolerance already.
    thinOutFrom(0, record_.tolerance);
    record_.tolerance *= 2;
  }
  thinned_ = record_.points.size() - 1;
  limit_ = std::max(2 * most_, 2 * record_.points.size());
}

/// True if the points between `from` and `to` may go when these two are joined.
bool PathRecorder::chordHolds(std::size_t from, std::size_t to, double tolerance) const {
  static const double mostTurn = std::cos(degreesOfTurn / 180 * std::numbers::pi);
  const PathPoint& begin = record_.points[from];
  const PathPoint& end = record_.points[to];
  if (begin.shank.dot(end.shank) < mostTurn) return false;
  for (std::size_t i = from + 1; i < to; ++i) {
    if (distanceFromSegment(record_.points[i].tip, begin.tip, end.tip) > tolerance) return false;
  }
  return true;
}

/// Leaves out points after `first` that lie within `tolerance` of the chords that replace them; never the last point.
void PathRecorder::thinOutFrom(std::size_t first, double tolerance) {
  std::vector<PathPoint>& points = record_.points;
  auto touch = std::ranges::upper_bound(record_.touches, first, {}, &PathTouch::pathPoint);
  std::size_t kept = first;   // where the last point that stays lies now
  std::size_t chord = first;  // and where it lay
  std::vector<PathPoint> thin;
  for (std::size_t i = first + 1; i < points.size(); ++i) {
    const bool touched = touch != record_.touches.end() && touch->pathPoint == i;
    const bool goesOn = i + 1 < points.size() && points[i + 1].kind == points[i].kind;
    if (mayGo(points[i].kind) && !touched && goesOn && i + 1 - chord <= longestChord &&
        chordHolds(chord, i + 1, tolerance)) {
      continue;
    }
    thin.push_back(points[i]);
    chord = i;
    ++kept;
    for (; touch != record_.touches.end() && touch->pathPoint == i; ++touch)
      touch->pathPoint = kept;
  }
  points.resize(first + 1);
  points.insert(points.end(), thin.begin(), thin.end());
}

}  // namespace probewright::simulation
