#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"

/// One axis of rotation from a body that it carries, found at several positions of the axis.
namespace probewright::kinematics {

/// Where the body was found while the axis stood at `degrees`.
struct TurnedPoint {
  double degrees = 0;
  Vector3 point = Vector3::Zero();  ///< mm
};

struct AxisOfRotation {
  /// The point is the middle of the circle that the body describes.
  Line axis;
  Vector3 start = Vector3::Zero();  ///< where the body is with the axis at 0
  double radius = 0;                ///< mm, of that circle
  double span = 0;                  ///< degrees, between the outermost positions
  std::vector<Vector3> residuals;   ///< mm, of each point: found less computed
  double rms = 0;                   ///< mm, root of the mean squared distance of the points
  /// Covariances where each coordinate of a found point has the standard deviation 1 mm: of the point across the axis,
  /// mm^2; of the direction, rad^2 (0 if it was told).
  Matrix3 pointCofactors = Matrix3::Zero();
  Matrix3 directionCofactors = Matrix3::Zero();

  /// How far the axis may be off, in mm and in degrees, for 0.001 mm in each coordinate: root of the largest variance.
  double pointPerMicrometre() const;
  double degreesPerMicrometre() const;
};

/// The axis about which the points turn right-handed by their angles, with the least sum of squared distances. Needs
/// points at two angles if `direction` is told and kept, else at three; without it `roughly` decides nothing but where
/// the search begins. Fails, with numbers, where the points leave it undetermined: too few, too narrow a span of
/// angles, a body that stands on the axis. What they determine badly shows in the cofactors.
Result<AxisOfRotation> fitAxisOfRotation(std::span<const TurnedPoint> points, const Vector3& roughly,
                                         const std::optional<Vector3>& direction = {});

}  // namespace probewright::kinematics
