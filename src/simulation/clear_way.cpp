#include "simulation/clear_way.hpp"

#include <algorithm>
#include <vector>

namespace probewright::simulation {

namespace {

/// Shorter stretches are searched piece by piece.
constexpr std::size_t fewestPieces = 3;
constexpr double largestMargin = 20;  // mm
constexpr double rounding = 1e-6;     // mm

double distanceFromSegment(const Vector3& point, const Vector3& from, const Vector3& to) {
  const Vector3 way = to - from;
  const double square = way.squaredNorm();
  const double along = square > 0 ? std::clamp((point - from).dot(way) / square, 0.0, 1.0) : 0;
  return (point - from - along * way).norm();
}

}  // namespace

std::size_t clearPieces(const TrueKinematics& kinematics, const machine::AxisPositions& from,
                        std::span<const machine::PathPiece> path, const ToolShape& shape,
                        const Surroundings& surroundings) {
  std::vector<Vector3> places = {kinematics.tableFromSpindle(from, 0).translation()};
  for (const machine::PathPiece& piece : path) {
    if (!kinematics.isStraightWithoutPlay(from, piece.target)) break;
    places.push_back(kinematics.tableFromSpindle(piece.target, 0).translation());
  }
  for (std::size_t count = places.size() - 1; count >= fewestPieces; count /= 2) {
    double aside = 0;
    for (std::size_t i = 1; i < count; ++i)
      aside = std::max(aside, distanceFromSegment(places[i], places[0], places[count]));
    if (!(aside < largestMargin)) continue;
    const Motion chord{kinematics, from, path[count - 1].target, from, 0, MotionProfile(0, 1, 1)};
    if (isClear(chord, aside + rounding, shape, surroundings)) return count;
  }
  return 0;
}

}  // namespace probewright::simulation
