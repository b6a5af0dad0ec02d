#pragma once

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"

/// Shapes through exactly as many points as they need, and the relations between measured shapes: angles,
/// intersections, distances. Lengths in mm, angles in degrees. Directions and normals given to a function need not be
/// unit vectors but must not be zero; those that come back are.
///
/// A relation that does not exist (parallel lines, collinear points) is a Diagnostic. "Parallel" means within 1e-9 rad,
/// "collinear" and "coplanar" within 1e-9 of the extent of the points: tighter than anything a probe can tell apart,
/// wide enough that rounding never passes for an intersection.
namespace probewright::metrology {

/// A straight line in a plane. Its left side is the positive one.
struct Line2 {
  Vector2 point = Vector2::Zero();
  Vector2 direction = Vector2::UnitX();
};

/// A circle in a plane.
struct Circle2 {
  Vector2 centre = Vector2::Zero();
  double radius = 0;
};

/// The circle through three points. Fails if they are collinear or two of them coincide.
Result<Circle2> circleThrough(const Vector2& a, const Vector2& b, const Vector2& c);

/// The circle through three points in space; its normal sees a, b, c counter-clockwise.
Result<Circle> circleThrough(const Vector3& a, const Vector3& b, const Vector3& c);

/// The sphere through four points. Fails if they are coplanar.
Result<Sphere> sphereThrough(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// The plane through three points, reported at their centroid; its normal sees a, b, c counter-clockwise.
Result<Plane> planeThrough(const Vector3& a, const Vector3& b, const Vector3& c);

/// The same plane with the normal on the side that `towards` points to.
Plane oriented(Plane plane, const Vector3& towards);
Line oriented(Line line, const Vector3& towards);

/// The angle that turns `from` into `to`, counter-clockwise, in (-180, 180].
double signedAngle(const Vector2& from, const Vector2& to);

/// The angle between two directions, 0 to 180; accurate to 1e-13 degrees at all angles, 0 and 180 included.
double angleBetween(const Vector3& a, const Vector3& b);

/// The acute angle between two lines (skew ones too), two planes, or a line and a plane: 0 to 90.
double acuteAngle(const Line2& a, const Line2& b);
double acuteAngle(const Line& a, const Line& b);
double acuteAngle(const Plane& a, const Plane& b);
double acuteAngle(const Line& line, const Plane& plane);

/// Where two lines of a plane cross. Fails if they are parallel.
Result<Vector2> intersection(const Line2& a, const Line2& b);

/// Where a line pierces a plane. Fails if the line is parallel to the plane.
Result<Vector3> intersection(const Line& line, const Plane& plane);

/// The line that two planes have in common, along normal(a) x normal(b), reported at the point that is nearest to the
/// middle between the planes' points. Fails if they are parallel.
Result<Line> intersection(const Plane& a, const Plane& b);

/// The corner of three planes. Fails if two are parallel or all three have a direction in common.
Result<Vector3> intersection(const Plane& a, const Plane& b, const Plane& c);

/// Signed distance of a point: positive on the left of a Line2, on the normal's side of a Plane, outside a circle,
/// sphere or cylinder. The distance from a Line in space is never negative.
double distance(const Vector2& point, const Line2& line);
double distance(const Vector2& point, const Circle2& circle);
double distance(const Vector3& point, const Line& line);
double distance(const Vector3& point, const Plane& plane);
double distance(const Vector3& point, const Sphere& sphere);
double distance(const Vector3& point, const Cylinder& cylinder);

/// The shortest distance between two lines in space, parallel or not.
double distance(const Line& a, const Line& b);

/// The foot of the perpendicular from `point`.
Vector2 projection(const Vector2& point, const Line2& line);
Vector3 projection(const Vector3& point, const Line& line);
Vector3 projection(const Vector3& point, const Plane& plane);

}  // namespace probewright::metrology
