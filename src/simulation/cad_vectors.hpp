#pragma once

#include "geometry/primitives.hpp"

/// OpenCASCADE's points, directions and coordinate systems as ours.
namespace probewright::simulation {

template <class Triple>
Vector3 vector(const Triple& p) {
  return {p.X(), p.Y(), p.Z()};
}

/// Columns: the directions of a coordinate system.
template <class Position>
Matrix3 axesOf(const Position& position) {
  Matrix3 axes;
  axes << vector(position.XDirection()), vector(position.YDirection()), vector(position.Direction());
  return axes;
}

}  // namespace probewright::simulation
