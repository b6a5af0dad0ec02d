#include "metrology/elements.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace probewright::metrology {

namespace {

constexpr double parallelSine = 1e-9;
constexpr double flatness = 1e-9;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

tl::unexpected<Diagnostic> collinear() {
  return fail("the three points lie on one straight line or coincide", "measure points that are farther apart");
}

double foldedToAcute(double degrees) { return degrees > 90 ? 180 - degrees : degrees; }

}  // namespace

Result<Circle2> circleThrough(const Vector2& a, const Vector2& b, const Vector2& c) {
  const Vector2 ab = b - a;
  const Vector2 ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  const double area = cross(ab, ac);
  if (!(std::abs(area) > flatness * longest)) return collinear();
  const double abSquared = ab.squaredNorm();
  const double acSquared = ac.squaredNorm();
  const Vector2 fromA(ac.y() * abSquared - ab.y() * acSquared, ab.x() * acSquared - ac.x() * abSquared);
  const Vector2 offset = fromA / (2 * area);
  return Circle2{a + offset, offset.norm()};
}

Result<Circle> circleThrough(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  const Vector3 area = ab.cross(ac);
  const double areaNorm = area.norm();
  if (!(areaNorm > flatness * longest)) return collinear();
  const Vector3 normal = area / areaNorm;
  const Vector3 offset = (ab.squaredNorm() * ac - ac.squaredNorm() * ab).cross(normal) / (2 * areaNorm);
  return Circle{a + offset, normal, offset.norm()};
}

Result<Sphere> sphereThrough(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  Matrix3 edges;
  edges.row(0) = b - a;
  edges.row(1) = c - a;
  edges.row(2) = d - a;
  const double longest = edges.rowwise().norm().maxCoeff();
  if (!(std::abs(edges.determinant()) > flatness * longest * longest * longest)) {
    return fail("the four points lie in one plane or coincide", "measure one point at another height");
  }
  const Vector3 offset = edges.fullPivLu().solve(0.5 * edges.rowwise().squaredNorm());
  return Sphere{a + offset, offset.norm()};
}

Result<Plane> planeThrough(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 area = (b - a).cross(c - a);
  const double longest = std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
  if (!(area.norm() > flatness * longest)) return collinear();
  return Plane{(a + b + c) / 3, area.normalized()};
}

Plane oriented(Plane plane, const Vector3& towards) {
  if (plane.normal.dot(towards) < 0) plane.normal = -plane.normal;
  return plane;
}

Line oriented(Line line, const Vector3& towards) {
  if (line.direction.dot(towards) < 0) line.direction = -line.direction;
  return line;
}

double signedAngle(const Vector2& from, const Vector2& to) {
  return normalizedDegrees(degreesFromRadians(std::atan2(cross(from, to), from.dot(to))));
}

double angleBetween(const Vector3& a, const Vector3& b) {
  return degreesFromRadians(std::atan2(a.cross(b).norm(), a.dot(b)));
}

double acuteAngle(const Line2& a, const Line2& b) {
  return foldedToAcute(std::abs(signedAngle(a.direction, b.direction)));
}
double acuteAngle(const Line& a, const Line& b) { return foldedToAcute(angleBetween(a.direction, b.direction)); }
double acuteAngle(const Plane& a, const Plane& b) { return foldedToAcute(angleBetween(a.normal, b.normal)); }
double acuteAngle(const Line& line, const Plane& plane) {
  return degreesFromRadians(
      std::atan2(std::abs(line.direction.dot(plane.normal)), line.direction.cross(plane.normal).norm()));
}

Result<Vector2> intersection(const Line2& a, const Line2& b) {
  const Vector2 alongA = a.direction.normalized();
  const Vector2 alongB = b.direction.normalized();
  const double sine = cross(alongA, alongB);
  if (!(std::abs(sine) > parallelSine)) {
    return fail("the two lines are parallel and do not intersect", "probe edges that are not parallel");
  }
  return Vector2(a.point + alongA * (cross(b.point - a.point, alongB) / sine));
}

Result<Vector3> intersection(const Line& line, const Plane& plane) {
  const Vector3 along = line.direction.normalized();
  const Vector3 normal = plane.normal.normalized();
  const double sine = along.dot(normal);
  if (!(std::abs(sine) > parallelSine)) return fail("the line is parallel to the plane and does not intersect it");
  return Vector3(line.point + along * ((plane.point - line.point).dot(normal) / sine));
}

Result<Line> intersection(const Plane& a, const Plane& b) {
  const Vector3 normalA = a.normal.normalized();
  const Vector3 normalB = b.normal.normalized();
  const Vector3 along = normalA.cross(normalB);
  const double sine = along.norm();
  if (!(sine > parallelSine)) return fail("the two planes are parallel and have no line in common");
  const Vector3 near = (a.point + b.point) / 2;
  const double aboveA = (a.point - near).dot(normalA);
  const double aboveB = (b.point - near).dot(normalB);
  const Vector3 unit = along / sine;
  const Vector3 offset = (aboveA * normalB - aboveB * normalA).cross(unit) / sine;
  return Line{near + offset, unit};
}

Result<Vector3> intersection(const Plane& a, const Plane& b, const Plane& c) {
  Matrix3 normals;
  normals.row(0) = a.normal.normalized();
  normals.row(1) = b.normal.normalized();
  normals.row(2) = c.normal.normalized();
  if (!(std::abs(normals.determinant()) > parallelSine)) {
    return fail("the three planes have no single point in common", "no two of them may be parallel");
  }
  const Vector3 near = (a.point + b.point + c.point) / 3;
  const Vector3 heights((a.point - near).dot(normals.row(0)), (b.point - near).dot(normals.row(1)),
                        (c.point - near).dot(normals.row(2)));
  return Vector3(near + normals.fullPivLu().solve(heights));
}

double distance(const Vector2& point, const Line2& line) {
  return cross(line.direction.normalized(), point - line.point);
}
double distance(const Vector2& point, const Circle2& circle) { return (point - circle.centre).norm() - circle.radius; }
double distance(const Vector3& point, const Line& line) {
  return line.direction.normalized().cross(point - line.point).norm();
}
double distance(const Vector3& point, const Plane& plane) { return plane.normal.normalized().dot(point - plane.point); }
double distance(const Vector3& point, const Sphere& sphere) { return (point - sphere.centre).norm() - sphere.radius; }
double distance(const Vector3& point, const Cylinder& cylinder) {
  return distance(point, Line{cylinder.point, cylinder.direction}) - cylinder.radius;
}

double distance(const Line& a, const Line& b) {
  const Vector3 common = a.direction.normalized().cross(b.direction.normalized());
  const double sine = common.norm();
  if (!(sine > parallelSine)) return distance(b.point, a);
  return std::abs((b.point - a.point).dot(common)) / sine;
}

Vector2 projection(const Vector2& point, const Line2& line) {
  const Vector2 along = line.direction.normalized();
  return line.point + along * along.dot(point - line.point);
}
Vector3 projection(const Vector3& point, const Line& line) {
  const Vector3 along = line.direction.normalized();
  return line.point + along * along.dot(point - line.point);
}
Vector3 projection(const Vector3& point, const Plane& plane) {
  return point - plane.normal.normalized() * distance(point, plane);
}

}  // namespace probewright::metrology
