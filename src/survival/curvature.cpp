#include "survival/curvature.hpp"

#include <algorithm>

namespace probewright::survival {

namespace {

// Why these: see the header.
constexpr double ofDistance = 0.45, ofHeight = 0.4, ofSagitta = 1.0 / 3;
constexpr double large = 1e9;
constexpr double samePlace = 0.05;  // mm: a quick touch and the slow one after it
constexpr double parallel = 1e-3;   // rad

double leastDistance(const std::vector<Vector3>& places) {
  double least = large;
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      least = std::min(least, (places[a] - places[b]).norm());
  return least;
}

/// How far places are off the line through the two that are farthest apart: of an arc of less than half a circle the
/// sagitta, of a triangle the least height.
double offLine(const std::vector<Vector3>& places) {
  double longest = 0;
  Vector3 begin = places.front(), along = Vector3::UnitX();
  for (const Vector3& a : places) {
    for (const Vector3& b : places) {
      if ((b - a).norm() <= longest) continue;
      longest = (b - a).norm();
      begin = a;
      along = (b - a) / longest;
    }
  }
  double across = 0;
  for (const Vector3& place : places)
    across = std::max(across, (place - begin).cross(along).norm());
  return across;
}

double crossing(const Vector3& a, const Vector3& b) {
  return a.norm() > 0 && b.norm() > 0 ? a.cross(b).norm() / (a.norm() * b.norm()) : 0;
}

}  // namespace

double sizeOf(const std::vector<Vector3>& touches, const std::vector<Vector3>& ways) {
  std::vector<Vector3> places, directions;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    if (std::ranges::none_of(places, [&](const Vector3& known) { return (known - touches[i]).norm() < samePlace; }))
      places.push_back(touches[i]);
    if (std::ranges::none_of(directions, [&](const Vector3& known) { return known.cross(ways[i]).norm() < parallel; }))
      directions.push_back(ways[i]);
  }
  const double distance = ofDistance * leastDistance(places);
  if (places.size() < 3) return distance;
  // All on one face: a plane. Two directions: edges that cross, or pairs that face each other. More: something round.
  if (directions.size() == 1) return std::min(distance, ofHeight * offLine(places));
  if (directions.size() > 2) return std::min(distance, ofSagitta * offLine(places));
  bool facing = false;
  for (const Vector3& a : ways)
    for (const Vector3& b : ways)
      facing = facing || a.dot(b) < -0.5;
  if (facing || places.size() != 4) return distance;
  return distance * crossing(places[1] - places[0], places[3] - places[2]);
}

double sizeOfArc(const std::vector<Vector3>& middles) {
  return std::min(ofDistance * leastDistance(middles), ofSagitta * offLine(middles));
}

double sizeOfCrossing(const std::vector<Vector3>& middles) {
  return ofDistance * leastDistance(middles) * crossing(middles[2] - middles[0], middles[3] - middles[1]);
}

}  // namespace probewright::survival
