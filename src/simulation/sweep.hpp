#pragma once

#include <array>

#include "geometry/primitives.hpp"

/// Where a ball or a capsule on a straight way first meets points, segments and triangles: closed forms, no search.
namespace probewright::simulation {

/// A ball that lies deeper than this in a solid overlaps it; less deep it touches.
inline constexpr double kTouchTolerance = 1e-9;

/// A straight way: start + s * direction, s in [0, length], direction a unit vector.
struct Way {
  Vector3 start = Vector3::Zero();
  Vector3 direction = Vector3::UnitZ();
  double length = 0;

  Vector3 at(double s) const { return start + s * direction; }
};

Way wayBetween(const Vector3& from, const Vector3& to);

/// The earliest meeting found so far on a way.
struct Meeting {
  /// Distance along the way in mm; negative when the ball overlaps at the start: minus the depth of the overlap.
  double when = 1e300;
  Vector3 point = Vector3::Zero();   ///< on the surface
  Vector3 normal = Vector3::Zero();  ///< outward unit normal of the face that was met; zero when an edge or corner was

  bool found() const { return when < 1e299; }
};

using Triangle = std::array<Vector3, 3>;

/// Each of these puts the meeting with its element into `best` if that is earlier than what is there, and returns
/// whether it did. Of two at exactly the same time the one with the smaller X counts, then the smaller Y, then the
/// smaller Z: the result does not depend on the order of the elements. A ball meets an element where it would go on to
/// overlap it by more than kTouchTolerance.
bool sweepPoint(const Way& way, double radius, const Vector3& point, Meeting& best);
bool sweepSegment(const Way& way, double radius, const Vector3& a, const Vector3& b, Meeting& best);
bool sweepTriangle(const Way& way, double radius, const Triangle& triangle, Meeting& best);

/// The same for all points within `radius` of the segment from p to p + `axis`, p moving along the way.
bool sweepCapsule(const Way& way, double radius, const Vector3& axis, const Triangle& triangle, Meeting& best);

/// The same for the cylinder of that radius with flat ends about the segment, which must not be empty. A cylinder that
/// overlaps at the start meets at a negative `when` that says nothing of its depth. Contacts to 1e-6 mm along the way.
bool sweepCylinder(const Way& way, double radius, const Vector3& axis, const Triangle& triangle, Meeting& best);

Vector3 closestOnSegment(const Vector3& p, const Vector3& a, const Vector3& b);
Vector3 closestOnTriangle(const Vector3& p, const Triangle& triangle);

}  // namespace probewright::simulation
