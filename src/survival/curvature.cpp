#include "survival/curvature.hpp"

#include <algorithm>
#include <cmath>

#include "survival/circle_curvature.hpp"

namespace probewright::survival {

namespace {

// Why these: see the header.
constexpr double ofDistance = 0.45, ofHeight = 0.4, ofSagitta = 0.5;
constexpr double large = 1e9;
constexpr double samePlace = 0.05;   // mm: a quick touch and the slow one after it
constexpr double parallel = 1e-3;    // rad
constexpr double acrossPlane = 0.7;  // sine of 45 degrees: ways in the touch probe axis

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

/// Touches at different places, and the directions that they came in. A touch square to the plane of the others, such
/// as one in the touch probe axis after a circle, is a coordinate by itself and left out.
struct Places {
  std::vector<Vector3> places, ways, directions;

  Places(const std::vector<Vector3>& touches, const std::vector<Vector3>& all) {
    Vector3 normal = Vector3::Zero();
    for (std::size_t i = 1; i < all.size() && normal.norm() < parallel; ++i)
      normal = all.front().cross(all[i]);
    if (normal.norm() > 0) normal.normalize();
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (std::abs(normal.dot(all[i])) > acrossPlane) continue;
      if (std::ranges::none_of(places, [&](const Vector3& known) { return (known - touches[i]).norm() < samePlace; })) {
        places.push_back(touches[i]);
        ways.push_back(all[i]);
      }
      if (std::ranges::none_of(directions, [&](const Vector3& known) { return known.cross(all[i]).norm() < parallel; }))
        directions.push_back(all[i]);
    }
  }
  bool facing() const {
    for (const Vector3& a : ways)
      for (const Vector3& b : ways)
        if (a.dot(b) < -0.5) return true;
    return false;
  }
};

/// Coordinates in the plane of the ways.
struct WayPlane {
  Vector3 first = Vector3::UnitX(), second = Vector3::UnitY();

  explicit WayPlane(const std::vector<Vector3>& ways) {
    Vector3 normal = Vector3::Zero();
    for (const Vector3& a : ways)
      for (const Vector3& b : ways)
        if (a.cross(b).norm() > normal.norm()) normal = a.cross(b);
    *this = WayPlane(normal.norm() > parallel ? Vector3(normal.normalized()) : Vector3(Vector3::UnitZ()));
  }
  explicit WayPlane(const Vector3& normal) : first(normal.unitOrthogonal()), second(normal.cross(first)) {}

  std::vector<Vector2> of(const std::vector<Vector3>& vectors) const {
    std::vector<Vector2> flat;
    for (const Vector3& vector : vectors)
      flat.emplace_back(first.dot(vector), second.dot(vector));
    return flat;
  }
};

}  // namespace

double sizeOf(const std::vector<Vector3>& touches, const std::vector<Vector3>& allWays) {
  const Places found(touches, allWays);
  const auto &places = found.places, &directions = found.directions;
  const double distance = ofDistance * leastDistance(places);
  if (places.size() < 3) return distance;
  // All on one face: a plane. Two directions: edges that cross, or pairs that face each other. More: something round.
  if (directions.size() == 1) return std::min(distance, ofHeight * offLine(places));
  if (directions.size() > 2) return sizeOfRound(touches, allWays);
  if (found.facing() || places.size() != 4) return distance;
  return distance * crossing(places[1] - places[0], places[3] - places[2]);
}

double sizeOfRound(const std::vector<Vector3>& touches, const std::vector<Vector3>& ways) {
  const Places found(touches, ways);
  const WayPlane plane(found.ways);
  return sizeOfCircle(plane.of(found.places), plane.of(found.ways),
                      std::min(ofDistance * leastDistance(found.places), ofSagitta * offLine(found.places)));
}

std::optional<CornerSize> cornerOf(const std::vector<Vector3>& touches, const std::vector<Vector3>& allWays) {
  const Places found(touches, allWays);
  const auto &places = found.places, &ways = found.ways;
  if (found.directions.size() != 2 || found.facing() || places.size() < 3 || places.size() > 4) return std::nullopt;
  const WayPlane plane(ways);
  const std::vector<Vector2> at = plane.of(places), along = plane.of(ways);
  CornerSize corner;
  corner.touches = places.size();
  const Vector2 first = at[1] - at[0];
  const Vector2 second = places.size() == 4 ? Vector2(at[3] - at[2]) : Vector2(-first.y(), first.x());
  corner.edge = places.size() == 4 ? std::min(first.norm(), second.norm()) : first.norm();
  const double cross = first.x() * second.y() - first.y() * second.x();
  corner.sine = std::abs(cross) / (first.norm() * second.norm());
  if (!(corner.edge > 0 && corner.sine > 0)) return corner;
  const Vector2 between = at[2] - at[0];
  const Vector2 crossing = at[0] + (between.x() * second.y() - between.y() * second.x()) / cross * first;
  for (std::size_t i = 0; i < places.size(); ++i) {
    corner.away = std::max(corner.away, (at[i] - crossing).norm());
    const Vector2& edge = i < 2 ? first : second;
    corner.oblique = std::max(corner.oblique, std::abs(along[i].dot(edge)) / edge.norm());
  }
  return corner;
}

double CornerSize::at(double lever) const {
  // The worst in the box: see the header.
  const double l = 0.91 * edge, a = 1.35 * away + 0.25 * edge, s = 0.8 * sine, v = lever;
  const double o = std::min(1.0, oblique + 0.1);
  const double second = (2 * o * (1.5 * a / s + v) + 3.5 * a / (s * s) + v) / (l * l) + 4 / (l * s);
  return 1 / ((static_cast<double>(touches) + 0.5) * second);
}

double sizeOfArc(const std::vector<Vector3>& middles) {
  const double most = std::min(ofDistance * leastDistance(middles), ofSagitta * offLine(middles));
  Vector3 normal = Vector3::Zero();
  for (std::size_t i = 2; i < middles.size(); ++i)
    normal += (middles[i - 1] - middles[0]).cross(middles[i] - middles[0]);
  if (!(normal.norm() > 0)) return 0.01 * most;
  return sizeOfBoreCircle(WayPlane(Vector3(normal.normalized())).of(middles), most);
}

double sizeOfCrossing(const std::vector<Vector3>& middles) {
  return ofDistance * leastDistance(middles) * crossing(middles[2] - middles[0], middles[3] - middles[1]);
}

}  // namespace probewright::survival
