#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"
#include "metrology/elements.hpp"

/// Least-squares features (ISO 14405-1 "GG" Gaussian association): the shape whose sum of squared orthogonal distances
/// from the measured points is least. mm throughout.
///
/// Accuracy: parameters agree with the exact minimum to 1e-9 of the points' extent for features seen under 10 degrees
/// of arc or more; points may lie anywhere in a machine, the fit works around their centroid. Below 10 degrees of arc
/// the minimum itself grows flat: centre and radius lose about two digits each time the arc shrinks to a tenth.
///
/// Fails, with the reason and what to measure instead, on: coordinates that are not finite, too few points, points that
/// coincide (extent below 1e-9 mm) or leave the shape undetermined (collinear, coplanar: within 1e-9 of their extent;
/// no preferred direction), and points that no shape of the kind fits better than its flat limit does.
namespace probewright::metrology {

/// A fitted shape and how good it is.
///
/// `covariance` is that of the shape's members in their order of declaration, world axes: Circle2 (x, y, radius),
/// Line2 (point, direction), Line (point, direction), Plane (point, normal), Circle (centre, normal, radius), Sphere
/// (centre, radius). It comes from the Jacobian J of the distances at the minimum:
/// s^2 (J^T J)^-1, carried over to the members; where a shape has fewer freedoms than members (a plane cannot move
/// within itself) it is singular, as it must be.
template <class Shape, int Members>
struct Fit {
  Shape shape;
  /// Orthogonal distance of each point, in the order given: positive outside a round shape, on the normal's side of a
  /// plane, left of a Line2. Distances from a Line in space have no sign.
  std::vector<double> residuals;
  /// Greatest minus least residual (straightness, flatness, roundness about the least-squares feature);
  /// for a Line in space twice the greatest distance: the diameter of the narrowest bore about it that holds all
  /// points.
  double formDeviation = 0;
  double rms = 0;            ///< root of the mean squared distance
  int degreesOfFreedom = 0;  ///< equations minus freedoms of the shape
  /// Standard deviation of one point, s: as told by the caller, else root(sum of squares / degreesOfFreedom); 0 where
  /// nothing is left over to estimate it from.
  double pointDeviation = 0;
  Eigen::Matrix<double, Members, Members> covariance = Eigen::Matrix<double, Members, Members>::Zero();
};

using Line2Fit = Fit<Line2, 4>;
using Circle2Fit = Fit<Circle2, 3>;
using LineFit = Fit<Line, 6>;
using PlaneFit = Fit<Plane, 6>;
using SphereFit = Fit<Sphere, 4>;

/// A circle in space has residuals in its plane (`residuals`, radial) and out of it.
struct CircleFit : Fit<Circle, 7> {
  std::vector<double>
      axialResiduals;  ///< distance of each point from the circle's plane, positive on the normal's side
};

/// What the caller knows about the points beforehand.
struct FitOptions {
  /// Standard uncertainty of one coordinate of a point along the surface normal. Without it the scatter of the
  /// residuals says how good the points are, which takes more points than freedoms.
  std::optional<double> pointDeviation;
};

/// Line through at least 2 points of a plane; runs from the first point towards the last.
Result<Line2Fit> fitLine(std::span<const Vector2> points, const FitOptions& options = {});

/// Line through at least 2 points in space; runs from the first point towards the last. Two equations a point.
Result<LineFit> fitLine(std::span<const Vector3> points, const FitOptions& options = {});

/// Plane through at least 3 points, reported at their centroid. The greatest component of its normal is positive.
Result<PlaneFit> fitPlane(std::span<const Vector3> points, const FitOptions& options = {});

/// Circle through at least 3 points of a plane. Method: Taubin's algebraic fit as the start, then Levenberg-Marquardt
/// on the orthogonal distances (W. Gander, G. Golub, R. Strebel, BIT 34 (1994) 558, doi:10.1007/BF01934268; N. Chernov,
/// Circular and Linear Regression, 2010).
Result<Circle2Fit> fitCircle(std::span<const Vector2> points, const FitOptions& options = {});

/// Circle in planes of a known direction: the points are projected along `normal` first, as a cycle does that measures
/// a bore at one height. The centre's height is the mean height of the points; one equation a point, and the normal
/// counts as exact. `axialResiduals` are taken from the mean height.
Result<CircleFit> fitCircleInPlane(std::span<const Vector3> points, const Vector3& normal,
                                   const FitOptions& options = {});

/// Circle in space through at least 3 points: the sum of squared distances from the curve itself (radial and axial) is
/// least; two equations a point. The greatest component of its normal is positive.
Result<CircleFit> fitCircle(std::span<const Vector3> points, const FitOptions& options = {});

/// Sphere through at least 4 points.
Result<SphereFit> fitSphere(std::span<const Vector3> points, const FitOptions& options = {});

}  // namespace probewright::metrology
