#pragma once

#include "geometry/primitives.hpp"

/// What Eigen answers by decompositions. Each takes seconds of compiling, so here they are compiled once.
namespace probewright {

/// The shortest turn that takes direction `from` to direction `to`, of any length except 0; about some axis at right
/// angles to them where they are opposite.
Eigen::Quaterniond shortestTurn(const Vector3& from, const Vector3& to);

/// The x with `matrix` * x = `right`; where there is none or more than one, one of least squares. By QR with pivoting.
Vector3 solveLinear(const Matrix3& matrix, const Vector3& right);

}  // namespace probewright
