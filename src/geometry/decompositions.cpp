#include "geometry/decompositions.hpp"

#include <Eigen/QR>

namespace probewright {

Eigen::Quaterniond shortestTurn(const Vector3& from, const Vector3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

Vector3 solveLinear(const Matrix3& matrix, const Vector3& right) { return matrix.colPivHouseholderQr().solve(right); }

}  // namespace probewright
