#pragma once

#include <vector>

#include "control/channel.hpp"
#include "control/working_plane.hpp"

namespace probewright::execution::sinumerik {

/// A straight line or an arc in program coordinates, mm. An arc turns about `centre` around the unit vector `axis` by
/// `sweep` radians, counterclockwise positive, and at the same time moves along the axis to the height of `end`.
struct PathElement {
  Vector3 start = Vector3::Zero();
  Vector3 end = Vector3::Zero();
  bool isArc = false;
  Vector3 centre = Vector3::Zero();
  Vector3 axis = Vector3::UnitZ();
  double sweep = 0;
  control::Feed feed;

  /// Unit tangents; of a line without length the zero vector.
  Vector3 startDirection() const;
  Vector3 endDirection() const;
  /// The point at `fraction` of the way, 0 to 1.
  Vector3 at(double fraction) const;
  /// The stretch between two fractions of the way.
  PathElement between(double first, double last) const;
};

/// Below this sine of the angle between two directions a corner counts as none.
inline constexpr double tangential = 1e-6;

/// Where the circle or endless line of `first` crosses that of `second` in the plane; two points at most. The third
/// coordinate is that of `first`'s end.
std::vector<Vector3> intersections(const PathElement& first, const PathElement& second,
                                   const control::WorkingPlane& plane);

}  // namespace probewright::execution::sinumerik
