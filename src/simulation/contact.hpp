#pragma once

#include <algorithm>
#include <array>

#include "simulation/search_tree.hpp"
#include "simulation/solid.hpp"

/// What all solids share in turning meetings into contacts.
namespace probewright::simulation {

/// The contact of a ball that met a surface; nothing when it met none.
std::optional<BallContact> ballContact(const Way& way, const Meeting& meeting);

/// The contact of a capsule: the normal points from the touch point to the capsule's axis.
std::optional<BallContact> capsuleContact(const Way& way, const Vector3& axis, const Meeting& meeting);

/// The same of a cylinder, whose flat ends have the normal of its axis.
std::optional<BallContact> cylinderContact(const Way& way, const Vector3& axis, double radius, const Meeting& meeting);

/// The contact of something that starts within the material.
BallContact contactWithin(const Way& way, double radius);

/// The parts a capsule is searched in: few for one along a coordinate axis, more for a slanted one, so that the boxes
/// about them stay slim.
std::size_t capsuleParts(const Vector3& axis, double radius);

/// True if the ball met the outer side of a face: then its way did not start within the material.
inline bool meetsFront(const Way& way, const Meeting& meeting) {
  return meeting.found() && meeting.normal.dot(way.at(meeting.when) - meeting.point) > 0;
}

/// How rays decide whether a point lies within.
enum class Rays : std::uint8_t {
  One,       ///< the surfaces have no gap: one ray tells
  Majority,  ///< of three: tessellations may leave a part of a surface open
};

/// Directions out of a box from a point in it, the shortest way first. None is that of edges of real parts.
std::array<Vector3, 6> waysOut(const Bounds& box, const Vector3& point);

/// True if `point` lies within the closed surfaces that the triangles make: the rays from there leave them more or less
/// often than they enter them. That holds whichever way the surfaces are turned, and where bodies overlap. A ray that
/// passes an edge too closely to tell is replaced by another. `surface(place, triangle, cross)` calls `cross` with the
/// triangles of such surfaces that an element of the tree stands for.
template <class Surface>
bool isWithin(const SearchTree& tree, const Vector3& point, Rays rays, const Surface& surface) {
  const Bounds& box = tree.bounds();
  if ((point - box.minimum).minCoeff() <= 0 || (box.maximum - point).minCoeff() <= 0) return false;
  Mover ray;
  ray.way.start = point;
  ray.way.length = (box.maximum - box.minimum).norm();
  // Boxes that the ray only grazes are looked into as well: the tree rounds to single precision.
  ray.radius = 1e-5 * ray.way.length;
  const int enough = rays == Rays::One ? 1 : 2;
  int inside = 0, outside = 0;
  for (const Vector3& direction : waysOut(box, point)) {
    ray.way.direction = direction;
    int crossings = 0;
    bool clear = true;
    const auto cross = [&](const Triangle& t) {
      if (!clear) return;
      const Vector3 e1 = t[1] - t[0];
      const Vector3 e2 = t[2] - t[0];
      const Vector3 p = ray.way.direction.cross(e2);
      const double determinant = e1.dot(p);
      const Vector3 s = point - t[0];
      const Vector3 q = s.cross(e1);
      // The ray's place in the triangle, and the way to it, times the determinant.
      const double size = std::abs(determinant);
      const double sign = determinant < 0 ? -1 : 1;
      const double u = sign * s.dot(p);
      const double v = sign * ray.way.direction.dot(q);
      const double when = sign * e2.dot(q);
      const double least = std::min({u, v, size - u - v});
      const double unsure = 1e-12 * s.norm() * (e1.norm() + e2.norm());
      if (least < -unsure || when < 0) return;
      if (least <= unsure) {
        clear = false;
        return;
      }
      crossings += determinant < 0 ? 1 : -1;
    };
    tree.visitAll(ray, [&](std::uint32_t place, const Triangle& t) { surface(place, t, cross); });
    if (clear) ++(crossings != 0 ? inside : outside);
    if (std::max(inside, outside) == enough) break;
  }
  return inside > outside;
}

}  // namespace probewright::simulation
