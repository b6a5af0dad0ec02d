#include "kinematics/axis_of_rotation.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "kinematics/minimum.hpp"

namespace probewright::kinematics {

namespace {

constexpr double perRadian = 100;  ///< mm: parameters that are angles count as ways at this distance

double largest(const Matrix3& cofactors) {
  return std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Matrix3>(cofactors).eigenvalues().maxCoeff()));
}

/// Two directions across `axis` and across each other.
Eigen::Matrix<double, 3, 2> across(const Vector3& axis) {
  const Vector3 first = axis.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> both;
  both << first, axis.cross(first);
  return both;
}

Vector3 tilted(const Vector3& axis, const Eigen::Matrix<double, 3, 2>& sideways, const Vector2& way) {
  const Vector3 turn = sideways * way / perRadian;
  const double angle = turn.norm();
  return angle > 0 ? rotation(turn / angle, degreesFromRadians(angle)) * axis : axis;
}

/// The centre across the axis and the start, which are linear for a given direction; in this order, the centre in the
/// plane of `sideways` through `middle`.
Eigen::VectorXd centreAndStart(std::span<const TurnedPoint> points, const Vector3& middle, const Vector3& axis,
                               const Eigen::Matrix<double, 3, 2>& sideways) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd matrix(3 * count, 5);
  Eigen::VectorXd right(3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const TurnedPoint& point = points[static_cast<std::size_t>(i)];
    const Matrix3 turn = rotation(axis, point.degrees).linear();
    matrix.block<3, 2>(3 * i, 0) = (Matrix3::Identity() - turn) * sideways;
    matrix.block<3, 3>(3 * i, 2) = turn;
    right.segment<3>(3 * i) = point.point - middle;
  }
  return matrix.colPivHouseholderQr().solve(right);
}

}  // namespace

double AxisOfRotation::pointPerMicrometre() const { return largest(pointCofactors) / 1000; }

double AxisOfRotation::degreesPerMicrometre() const { return degreesFromRadians(largest(directionCofactors)) / 1000; }

Result<AxisOfRotation> fitAxisOfRotation(std::span<const TurnedPoint> points, const Vector3& roughly,
                                         const std::optional<Vector3>& direction) {
  const bool free = !direction;
  const std::size_t least = free ? 3 : 2;
  if (points.size() < least) {
    return fail(fmt::format("{} positions do not determine an axis of rotation", points.size()),
                fmt::format("measure at {} or more", least));
  }
  AxisOfRotation found;
  const auto [low, high] = std::ranges::minmax(points, {}, &TurnedPoint::degrees);
  found.span = high.degrees - low.degrees;
  Vector3 middle = Vector3::Zero();
  for (const TurnedPoint& point : points)
    middle += point.point / static_cast<double>(points.size());

  Vector3 axis = direction.value_or(roughly).normalized();
  if (free) {
    // The points lie in a plane across the axis.
    Matrix3 spread = Matrix3::Zero();
    for (const TurnedPoint& point : points)
      spread += (point.point - middle) * (point.point - middle).transpose();
    const Eigen::SelfAdjointEigenSolver<Matrix3> plane(spread);
    if (plane.eigenvalues()[1] > 1e-12 * std::max(plane.eigenvalues()[2], 1e-300)) {
      const Vector3 normal = plane.eigenvectors().col(0);
      axis = normal.dot(roughly) < 0 ? Vector3(-normal) : normal;
    }
  }
  const auto sideways = across(axis);
  const Eigen::Index tilts = free ? 2 : 0;
  const auto model = [&](const Eigen::VectorXd& p) {
    const Vector3 k = free ? tilted(axis, sideways, p.tail<2>()) : axis;
    const Vector3 centre = middle + sideways * p.head<2>();
    const Vector3 start = middle + p.segment<3>(2);
    Eigen::VectorXd residuals(3 * static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
      residuals.segment<3>(3 * static_cast<Eigen::Index>(i)) =
          points[i].point - (centre + rotation(k, points[i].degrees).linear() * (start - centre));
    }
    return residuals;
  };
  Eigen::VectorXd begin = Eigen::VectorXd::Zero(5 + tilts);
  begin.head<5>() = centreAndStart(points, middle, axis, sideways);
  found.radius = axis.cross(begin.segment<3>(2) - sideways * begin.head<2>()).norm();
  const auto minimum = minimise(model, begin);
  const auto undetermined = [&](const std::string& what) {
    return fail(fmt::format("{} positions over {:.4g} degrees leave the {} of the axis of rotation open; the body "
                            "stands {:.4g} mm from it",
                            points.size(), found.span, what, found.radius),
                "spread the positions further, and place the body further from the axis");
  };
  if (!minimum) return undetermined(free ? "place and direction" : "place");

  const Eigen::VectorXd& p = minimum->parameters;
  found.axis.direction = free ? tilted(axis, sideways, p.tail<2>()) : axis;
  found.start = middle + p.segment<3>(2);
  const Vector3 centre = middle + sideways * p.head<2>();
  found.axis.point = centre + found.axis.direction * found.axis.direction.dot(found.start - centre);
  found.radius = (found.start - found.axis.point).norm();
  found.pointCofactors = sideways * minimum->cofactors.topLeftCorner<2, 2>() * sideways.transpose();
  if (free) {
    const Eigen::Matrix2d tilt = minimum->cofactors.bottomRightCorner<2, 2>() / (perRadian * perRadian);
    // Turning about one of the two directions moves the tip of the axis along the other.
    const Eigen::Matrix<double, 3, 2> moves =
        (Eigen::Matrix<double, 3, 2>() << sideways.col(0).cross(axis), sideways.col(1).cross(axis)).finished();
    found.directionCofactors = moves * tilt * moves.transpose();
  }
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    found.residuals.emplace_back(minimum->residuals.segment<3>(3 * static_cast<Eigen::Index>(i)));
    sum += found.residuals.back().squaredNorm();
  }
  found.rms = std::sqrt(sum / static_cast<double>(points.size()));
  // A micrometre that becomes more than a millimetre or ten degrees says nothing.
  if (found.pointPerMicrometre() > 1) return undetermined("place");
  if (found.degreesPerMicrometre() > 10) return undetermined("direction");
  return found;
}

}  // namespace probewright::kinematics
