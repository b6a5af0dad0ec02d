#pragma once

#include "simulation/search_tree.hpp"
#include "simulation/solid.hpp"

/// What all solids share in turning meetings into contacts.
namespace probewright::simulation {

/// The contact of a ball that met a surface; nothing when it met none.
std::optional<BallContact> ballContact(const Way& way, const Meeting& meeting);

/// The contact of a capsule: the normal points from the touch point to the capsule's axis.
std::optional<BallContact> capsuleContact(const Way& way, const Vector3& axis, const Meeting& meeting);

/// The contact of something that starts within the material.
BallContact contactWithin(const Way& way, double radius);

/// The parts a capsule is searched in: few for one along a coordinate axis, more for a slanted one, so that the boxes
/// about them stay slim.
std::size_t capsuleParts(const Vector3& axis, double radius);

/// True if the first triangle that a ray from `point` meets shows its back. For a closed surface: `point` lies inside.
/// The ray's direction is one that edges of real parts do not have. `isFace(place)` tells triangles from the other
/// elements of the tree.
template <class IsFace>
bool rayMeetsBack(const SearchTree& tree, const Vector3& point, const IsFace& isFace) {
  const Bounds& box = tree.bounds();
  if ((point - box.minimum).minCoeff() <= 0 || (box.maximum - point).minCoeff() <= 0) return false;
  Mover ray;
  ray.way.start = point;
  ray.way.direction = Vector3(0.1234567, 0.3141593, 0.9412357).normalized();
  ray.way.length = (box.maximum - box.minimum).norm();
  Meeting best;
  bool back = false;
  tree.search(ray, best, [&](std::uint32_t place, const Triangle& t) {
    if (!isFace(place)) return;
    const Vector3 e1 = t[1] - t[0];
    const Vector3 e2 = t[2] - t[0];
    const Vector3 p = ray.way.direction.cross(e2);
    const double determinant = e1.dot(p);
    if (determinant == 0) return;
    const Vector3 s = point - t[0];
    const double u = s.dot(p) / determinant;
    const Vector3 q = s.cross(e1);
    const double v = ray.way.direction.dot(q) / determinant;
    const double when = e2.dot(q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || when < 0 || when >= best.when) return;
    best.when = when;
    back = determinant < 0;
  });
  return back;
}

}  // namespace probewright::simulation
