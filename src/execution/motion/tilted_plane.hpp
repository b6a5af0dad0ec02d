#pragma once

#include "geometry/primitives.hpp"

/// Planes as programs define them: columns are the main axis, the minor axis and the normal.
namespace probewright::execution::motion {

/// The plane with the normal `normal` whose main axis lies as near to `along` as possible. Neither may be 0, nor may
/// they be parallel.
Matrix3 planeAlong(const Vector3& along, const Vector3& normal);

/// The plane whose traces in the planes ZX and YZ have these slopes, degrees: against X turned about Y, and against Y
/// turned about X. Its main axis lies along the first trace.
Matrix3 planeOfProjections(double inZx, double inYz);

}  // namespace probewright::execution::motion
