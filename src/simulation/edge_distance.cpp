#include "simulation/edge_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace probewright::simulation {

namespace {

constexpr double pi = std::numbers::pi, fullTurn = 2 * pi;

/// How many intervals of a piece have one bottom each.
int intervalsOf(const EdgePiece& piece) {
  const double winds = std::abs(piece.winding * (piece.meridian(1).y() - piece.meridian(0).y()));
  const double bends = piece.kind == EdgePiece::Kind::Arc ? std::abs(piece.toAngle - piece.fromAngle) : 0;
  return 4 + static_cast<int>(std::ceil((winds + bends) / radiansFromDegrees(20)));
}

/// A point of a piece and how it moves with its share, mm.
struct OnPiece {
  Vector3 place, along;
};

OnPiece onPiece(const EdgePiece& piece, double share, double about = 0) {
  Vector2 place = piece.from + (piece.to - piece.from) * share, rate = piece.to - piece.from;
  if (piece.kind == EdgePiece::Kind::Arc) {
    const double turned = piece.toAngle - piece.fromAngle, at = piece.fromAngle + turned * share;
    const double c = std::cos(at), s = std::sin(at);
    place = piece.centre + piece.radius * Vector2(c, s);
    rate = piece.radius * turned * Vector2(-s, c);
  }
  const double at = piece.angle + piece.winding * (place.y() - piece.datum) + about;
  const double turn = piece.winding * rate.y(), c = std::cos(at), s = std::sin(at);
  const Vector2 aside(place.x() * c - piece.across * s, place.x() * s + piece.across * c);
  return {{aside.x(), aside.y(), place.y()},
          {rate.x() * c - turn * aside.y(), rate.x() * s + turn * aside.x(), rate.y()}};
}

/// The nearest place of the circle that a turned piece makes at `share`.
struct OnCircle {
  double about = 0;
  ClosestPoint near;
};

OnCircle onCircle(const EdgePiece& piece, double share, const Pose& pose, const DistanceSolid& solid) {
  const Vector2 meridian = piece.meridian(share);
  const Vector3 middle = pose * Vector3(0, 0, meridian.y());
  const Vector3 first = pose.linear().col(0) * meridian.x(), second = pose.linear().col(1) * meridian.x();
  if (meridian.x() == 0) return {0, solid.closest(middle)};
  const auto along = [&](double part) {
    const double c = std::cos(fullTurn * part), s = std::sin(fullTurn * part);
    const ClosestPoint near = solid.closest(middle + c * first + s * second);
    return Slope{part, near.distance, fullTurn * near.normal.dot(c * second - s * first)};
  };
  constexpr int places = 12;
  const double about = fullTurn * leastAlong(along, places).at;
  return {about, solid.closest(middle + std::cos(about) * first + std::sin(about) * second)};
}

/// The cheap bound of a turned piece: by the distance of its axis.
double boundOfTurned(const EdgePiece& piece, const Pose& pose, const DistanceSolid& solid) {
  constexpr int samples = 4;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= samples; ++i) {
    const Vector2 place = piece.meridian(static_cast<double>(i) / samples);
    const double axis = solid.closest(pose * Vector3(0, 0, place.y())).distance;
    least = std::min(least, axis - std::abs(place.x()));
  }
  return least - std::numbers::sqrt2 * 0.5 * piece.length() / samples;
}

/// The least of direction * place over what the pieces turn out, and where: on the side that `direction` points from.
Vector3 supportOf(const std::vector<EdgePiece>& turned, const Vector3& direction) {
  const double aside = std::hypot(direction.x(), direction.y());
  const Vector2 away = aside > 0 ? Vector2(-direction.x() / aside, -direction.y() / aside) : Vector2::UnitX();
  double least = std::numeric_limits<double>::infinity();
  Vector2 found = Vector2::Zero();
  const auto take = [&](const Vector2& meridian) {
    const double value = direction.z() * meridian.y() - aside * std::abs(meridian.x());
    if (value >= least) return;
    least = value;
    found = {std::abs(meridian.x()), meridian.y()};
  };
  for (const EdgePiece& piece : turned) {
    take(piece.meridian(0));
    take(piece.meridian(1));
    if (piece.kind == EdgePiece::Kind::Line) continue;
    const double low = std::min(piece.fromAngle, piece.toAngle), high = std::max(piece.fromAngle, piece.toAngle);
    for (const double side : {1.0, -1.0}) {
      const double best = std::atan2(-direction.z(), side * aside);
      const double angle = best + fullTurn * std::ceil((low - best) / fullTurn);
      if (angle <= high) take(piece.centre + piece.radius * Vector2(std::cos(angle), std::sin(angle)));
    }
  }
  return {away.x() * found.x(), away.y() * found.x(), found.y()};
}

/// The nearest point of a turned piece, all of whose angles are zero.
EdgeDistance nearestOfTurned(const EdgePiece& piece, const Pose& pose, const DistanceSolid& solid) {
  constexpr double far = 0.2;  // mm
  if (const double gap = boundOfTurned(piece, pose, solid); gap > far) return {.gap = gap};
  const auto along = [&](double share) {
    const OnCircle at = onCircle(piece, share, pose, solid);
    return Slope{share, at.near.distance, at.near.normal.dot(pose.linear() * onPiece(piece, share, at.about).along)};
  };
  const double share = leastAlong(along, 4).at;
  const OnCircle at = onCircle(piece, share, pose, solid);
  return {at.near.distance, pose * onPiece(piece, share, at.about).place, at.near.normal};
}

EdgeDistance nearestOfOne(const EdgePiece& piece, const Pose& pose, const DistanceSolid& solid) {
  if (piece.turned) return nearestOfTurned(piece, pose, solid);
  const auto along = [&](double share) {
    const OnPiece at = onPiece(piece, share);
    const ClosestPoint near = solid.closest(pose * at.place);
    return Slope{share, near.distance, near.normal.dot(pose.linear() * at.along)};
  };
  EdgeDistance distance;
  distance.place = pose * piece.at(leastAlong(along, intervalsOf(piece)).at);
  const ClosestPoint near = solid.closest(distance.place);
  distance.gap = near.distance;
  distance.normal = near.normal;
  return distance;
}

}  // namespace

EdgeDistance nearestOf(const std::vector<EdgePiece>& pieces, const Pose& pose, const DistanceSolid& solid) {
  EdgeDistance nearest;
  for (const EdgePiece& piece : pieces) {
    const EdgeDistance here = nearestOfOne(piece, pose, solid);
    if (here.gap < nearest.gap) nearest = here;
  }
  return nearest;
}

EdgeDistance nearestOfFlank(const EdgePiece& front, const EdgePiece& behind, double depth, const Pose& pose,
                            const DistanceSolid& solid) {
  const auto across = [&](double share) { return Vector3(depth * (behind.at(share) - front.at(share))); };
  const auto lineAt = [&](double part) {
    return leastAlong(
        [&](double share) {
          const Vector3 along =
              (1 - part * depth) * onPiece(front, share).along + part * depth * onPiece(behind, share).along;
          const ClosestPoint near = solid.closest(pose * (front.at(share) + part * across(share)));
          return Slope{share, near.distance, near.normal.dot(pose.linear() * along)};
        },
        intervalsOf(front));
  };
  const auto nearAt = [&](double part, double share) { return pose * (front.at(share) + part * across(share)); };
  const auto along = [&](double part) {
    const double share = lineAt(part).at;
    const ClosestPoint near = solid.closest(nearAt(part, share));
    return Slope{part, near.distance, near.normal.dot(pose.linear() * across(share))};
  };
  const double part = leastAlong(along, 4).at;
  EdgeDistance distance;
  distance.place = nearAt(part, lineAt(part).at);
  const ClosestPoint near = solid.closest(distance.place);
  distance.gap = near.distance;
  distance.normal = near.normal;
  return distance;
}

Plane planeBeside(const DistanceSolid& solid, const Vector3& normal) {
  // Seen from far away, the nearest point of a solid is the one that reaches out farthest, but for the curvature of the
  // sphere around the place it is seen from.
  constexpr double farAway = 1e9;  // mm
  const Bounds bounds = solid.bounds();
  const Vector3 place = 0.5 * (bounds.minimum + bounds.maximum) + farAway * normal;
  const double curved = (bounds.maximum - bounds.minimum).squaredNorm() / (8 * farAway);
  return {place - (solid.closest(place).distance - curved) * normal, normal};
}

ClosestPoint TurnsBehindPlane::closest(const Vector3& point) const {
  const Vector3& normal = plane_.normal;
  const Vector3 arm = point - axis_.point;
  const Vector3 aside = arm - axis_.direction * arm.dot(axis_.direction), ahead = axis_.direction.cross(aside);
  // Turned by t the point is (p cos t + q sin t) farther in front than where it is nearest to the axis.
  const double p = normal.dot(aside), q = normal.dot(ahead), middle = (point - aside - plane_.point).dot(normal);
  double turned = std::atan2(q, p) + pi;
  if (turned > fullTurn) turned -= fullTurn;
  if (turned > angle_) turned = p * std::cos(angle_) + q * std::sin(angle_) < p ? angle_ : 0;
  const double distance = middle + p * std::cos(turned) + q * std::sin(turned);
  const Vector3 back = Eigen::AngleAxisd(-turned, axis_.direction) * normal;
  return {distance, point - distance * back, back};
}

double leastGapOf(const std::vector<EdgePiece>& turned, const Pose& pose, const DistanceSolid& solid) {
  constexpr double enough = 1e-4, enoughOfFar = 0.01;  // mm; and of the gap
  constexpr int steps = 12;
  // Any half space around the solid gives a bound. From a point of the turned body to the one that is nearest to such a
  // half space, and again from the best between them.
  Vector3 place = supportOf(turned, Vector3::UnitZ());
  place.x() = place.y() = 0;
  double least = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < steps; ++i) {
    const ClosestPoint near = solid.closest(pose * place);
    const Vector3 towards = supportOf(turned, pose.linear().transpose() * near.normal);
    least = std::max(least, HalfSpace(planeBeside(solid, near.normal)).closest(pose * towards).distance);
    if (near.distance - least < enough + enoughOfFar * std::max(near.distance, 0.0)) break;
    const Vector3 step = towards - place;
    const auto along = [&](double share) {
      const ClosestPoint at = solid.closest(pose * (place + share * step));
      return Slope{share, at.distance, at.normal.dot(pose.linear() * step)};
    };
    place += leastAlong(along, 4).at * step;
  }
  return least;
}

}  // namespace probewright::simulation
