#include "truth/expected_corner.hpp"

#include <cmath>

#include "control/working_plane.hpp"
#include "truth/feeling.hpp"

namespace probewright::truth {

namespace {

/// A corner in the working plane.
struct PlaneCorner {
  Vector2 corner = Vector2::Zero();
  std::array<Vector2, 2> point, into;
  double height = 0;
  std::string from;
};

Vector2 along(double degrees) { return {std::cos(radiansFromDegrees(degrees)), std::sin(radiansFromDegrees(degrees))}; }

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where the lines p + t*d and q + t*e meet.
std::optional<Vector2> crossing(const Vector2& p, const Vector2& d, const Vector2& q, const Vector2& e) {
  if (std::abs(cross(d, e)) < 0.01 * d.norm() * e.norm()) return std::nullopt;
  return p + d * (cross(q - p, e) / cross(d, e));
}

std::optional<PlaneCorner> ofHeidenhain(const control::CycleRecord& cycle, double height) {
  const auto value = [&](const char* name) { return valueOf(cycle, name).value_or(0); };
  PlaneCorner known;
  known.height = valueOf(cycle, "Q261").value_or(height);
  const Vector2 first(value("Q263"), value("Q264"));
  if (cycle.name == "414") {
    const Vector2 third(value("Q296"), value("Q297"));
    if (first.x() == third.x() || first.y() == third.y()) return std::nullopt;
    known.corner = {third.x(), first.y()};
    const auto further = [&](const Vector2& a, const Vector2& b) {
      return (a - known.corner).norm() > (b - known.corner).norm() ? a : b;
    };
    known.point = {further(first, first + Vector2(value("Q326"), 0)),
                   further(third, third + Vector2(0, value("Q327")))};
    known.into = {Vector2(0, third.y() > first.y() ? 1 : -1), Vector2(third.x() < first.x() ? 1 : -1, 0)};
    known.from = "Q296/Q264";
    return known;
  }
  if (cycle.name != "415") return std::nullopt;
  const int corner = static_cast<int>(value("Q308"));
  const Vector2 inwards(corner == 1 || corner == 4 ? 1 : -1, corner == 1 || corner == 2 ? 1 : -1);
  known.corner = first;
  known.point = {first + Vector2(inwards.x() * value("Q326"), 0), first + Vector2(0, inwards.y() * value("Q327"))};
  known.into = {Vector2(0, -inwards.y()), Vector2(-inwards.x(), 0)};
  known.from = "Q263/Q264";
  return known;
}

/// The call names places from which is probed and a pole from which both sides can be reached, not the corner.
std::optional<PlaneCorner> ofSinumerik(const control::CycleRecord& cycle, double height) {
  if (cycle.name != "CYCLE961") return std::nullopt;
  const auto value = [&](const char* name) { return valueOf(cycle, name).value_or(0); };
  const int code = static_cast<int>(value("S_MVAR")), units = code % 10, corner = code / 10000 % 10;
  const bool rightAngled = units <= 6, inside = units == 5 || units == 7;
  PlaneCorner known;
  Vector2 first, second;
  if (code / 10 % 10 == 1) {
    const Vector2 p0(value("S_SETV0"), value("S_SETV1")), p1(value("S_SETV2"), value("S_SETV3")),
        p2(value("S_SETV4"), value("S_SETV5")), p3(value("S_SETV6"), value("S_SETV7"));
    first = p1 - p0;
    second = rightAngled ? Vector2(-first.y(), first.x()) : Vector2(p3 - p2);
    const auto pole = crossing(p0, first, p2, second);
    if (!pole) return std::nullopt;
    known.corner = *pole;
    known.point = {p1, rightAngled ? p2 : p3};
  } else {
    const auto signedAs = [](double length, bool negative) { return negative ? -std::abs(length) : length; };
    const bool back1 = corner == 2 || corner == 3, back2 = corner == 3 || corner == 4;
    first = along(value("S_STA1"));
    second = along(value("S_STA1") + (rightAngled ? 90 : value("S_INCA")));
    const double far1 = signedAs(value("S_SETV1"), back1), far2 = signedAs(value("S_SETV3"), back2);
    double near2 = signedAs(value("S_SETV2"), back2);
    if (near2 == 0) near2 = far2 / 2;
    known.corner = {value("S_SETV4"), value("S_SETV5")};
    known.point = {known.corner + first * far1, known.corner + second * (rightAngled ? near2 : far2)};
  }
  const Vector2 edge1 = (known.point[0] - known.corner).normalized(),
                edge2 = (known.point[1] - known.corner).normalized();
  if (!(std::abs(cross(edge1, edge2)) > 0.01)) return std::nullopt;
  const double side = inside ? -1 : 1;
  known.into = {side * (edge2 - edge1 * edge1.dot(edge2)).normalized(),
                side * (edge1 - edge2 * edge2.dot(edge1)).normalized()};
  known.height = height - (code / 1000 % 10 == 1 ? std::abs(value("S_ID")) : 0);
  known.from = "the pole";
  return known;
}

/// On a side from a place near it, forward along `into`. The way begins free: a little before the place, or further.
std::optional<FeltFace> feltFrom(const std::vector<simulation::PlacedSolid>& solids, const Vector3& place,
                                 const Vector3& into) {
  for (const double back : {0.5, 5.0, 15.0, 30.0, room})
    if (auto face = felt(solids, place - back * into, place + room * into)) return face;
  return std::nullopt;
}

}  // namespace

std::optional<ExpectedCorner> expectedCorner(const control::CycleRecord& cycle, int tool, const Vector3& start) {
  const control::WorkingPlane plane = control::WorkingPlane::ofToolAxis("XYZ"[tool]);
  const double height = plane.planeFromXyz(start).z();
  const auto known = cycle.name.starts_with("CYCLE") ? ofSinumerik(cycle, height) : ofHeidenhain(cycle, height);
  if (!known) return std::nullopt;
  const auto place = [&](const Vector2& p) { return plane.xyzFromPlane(Vector3(p.x(), p.y(), known->height)); };
  const auto way = [&](const Vector2& v) { return plane.xyzFromPlane(Vector3(v.x(), v.y(), 0)); };
  ExpectedCorner expected;
  expected.corner = place(known->corner);
  for (std::size_t i = 0; i < 2; ++i)
    expected.sides[i] = {place(known->point[i]), way(known->into[i])};
  expected.tool = tool;
  expected.from = known->from;
  return expected;
}

std::optional<TrueCorner> trueCorner(const ExpectedCorner& expected, const Eigen::Affine3d& tableFromProgram,
                                     const std::vector<simulation::PlacedSolid>& solids) {
  const control::WorkingPlane plane = control::WorkingPlane::ofToolAxis("XYZ"[expected.tool]);
  const Eigen::Affine3d programFromTable = tableFromProgram.inverse();
  std::array<Vector2, 2> at, along;
  std::array<double, 2> turned{};
  for (std::size_t i = 0; i < 2; ++i) {
    const ExpectedSide& side = expected.sides[i];
    const auto face =
        feltFrom(solids, tableFromProgram * side.point, (tableFromProgram.linear() * side.into).normalized());
    if (!face) return std::nullopt;
    at[i] = plane.planeFromXyz(programFromTable * face->point).head<2>();
    const Vector2 normal = plane.planeFromXyz(programFromTable.linear() * face->normal).head<2>();
    const Vector2 into = plane.planeFromXyz(side.into).head<2>();
    Vector2 planned = plane.planeFromXyz(side.point - expected.corner).head<2>();
    planned -= into * planned.dot(into);
    if (normal.norm() < 0.1 || planned.norm() < 1e-3) return std::nullopt;
    along[i] = Vector2(-normal.y(), normal.x()).normalized();
    if (along[i].dot(planned) < 0) along[i] = -along[i];
    turned[i] = degreesFromRadians(std::atan2(cross(planned, along[i]), planned.dot(along[i])));
  }
  const auto corner = crossing(at[0], along[0], at[1], along[1]);
  if (!corner) return std::nullopt;
  TrueCorner known;
  known.corner =
      tableFromProgram * plane.xyzFromPlane(Vector3(corner->x(), corner->y(), plane.planeFromXyz(expected.corner).z()));
  known.turned = turned;
  for (std::size_t i = 0; i < 2; ++i)
    known.along[i] =
        (tableFromProgram.linear() * plane.xyzFromPlane(Vector3(along[i].x(), along[i].y(), 0))).normalized();
  return known;
}

}  // namespace probewright::truth
