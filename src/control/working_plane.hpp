#pragma once

#include "geometry/places.hpp"

namespace probewright::control {

/// Which axes span the working plane: indices into X, Y, Z. HEIDENHAIN calls them main, minor and tool (touch probe)
/// axis; SINUMERIK 1st, 2nd and 3rd axis of the plane: G17 X, Y, Z; G18 Z, X, Y; G19 Y, Z, X.
struct WorkingPlane {
  int main = 0, minor = 1, tool = 2;
  /// Places and ways along (main, minor, tool) axis from those along (X, Y, Z), and back.
  template <places::Of of>
  places::Place<places::Axes::Plane, of> planeFromXyz(const places::Place<places::Axes::Program, of>& place) const {
    return places::Place<places::Axes::Plane, of>(planeFromXyz(place.vector()));
  }
  PlaneWay planeFromXyz(const ProgramWay& way) const { return PlaneWay(planeFromXyz(way.vector())); }
  template <places::Of of>
  places::Place<places::Axes::Program, of> xyzFromPlane(const places::Place<places::Axes::Plane, of>& place) const {
    return places::Place<places::Axes::Program, of>(xyzFromPlane(place.vector()));
  }
  ProgramWay xyzFromPlane(const PlaneWay& way) const { return ProgramWay(xyzFromPlane(way.vector())); }
  /// The same for three numbers of any other system.
  Vector3 planeFromXyz(const Vector3& p) const { return {p[main], p[minor], p[tool]}; }
  Vector3 xyzFromPlane(const Vector3& p) const {
    Vector3 xyz;
    xyz[main] = p[0];
    xyz[minor] = p[1];
    xyz[tool] = p[2];
    return xyz;
  }
  /// The plane of G17, G18 or G19 (any other number: G17).
  static constexpr WorkingPlane ofG(int number) {
    return number == 18 ? WorkingPlane{2, 0, 1} : number == 19 ? WorkingPlane{1, 2, 0} : WorkingPlane{0, 1, 2};
  }
  /// The 1st, 2nd or 3rd axis, counted from 0.
  constexpr int axis(int place) const { return place == 0 ? main : place == 1 ? minor : tool; }
  /// The plane square to a tool along `axis`: 'X', 'Y', 'Z', or 'U', 'V', 'W' for the parallel axes.
  static constexpr WorkingPlane ofToolAxis(char axis) {
    switch (axis) {
      case 'X':
      case 'U':
        return {1, 2, 0};
      case 'Y':
      case 'V':
        return {2, 0, 1};
      default:
        return {0, 1, 2};
    }
  }
};

}  // namespace probewright::control
