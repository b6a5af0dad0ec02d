#include "truth/expected_corner.hpp"

#include <cmath>

#include "control/working_plane.hpp"
#include "truth/feeling.hpp"

namespace probewright::truth {

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

std::optional<Vector2> crossing(const Vector2& p, const Vector2& d, const Vector2& q, const Vector2& e) {
  if (std::abs(cross(d, e)) < 0.01 * d.norm() * e.norm()) return std::nullopt;
  return p + d * (cross(q - p, e) / cross(d, e));
}

namespace {

/// On a side from a place near it, forward along `into`. The way begins free: a little before the place, or further.
std::optional<FeltFace> feltFrom(const std::vector<simulation::PlacedSolid>& solids, const Vector3& place,
                                 const Vector3& into) {
  for (const double back : {0.5, 5.0, 15.0, 30.0, room})
    if (auto face = felt(solids, place - back * into, place + room * into)) return face;
  return std::nullopt;
}

}  // namespace

ExpectedCorner inWorkpiece(const PlaneCorner& known, int tool) {
  const control::WorkingPlane plane = control::WorkingPlane::ofToolAxis("XYZ"[tool]);
  const auto place = [&](const Vector2& p) { return plane.xyzFromPlane(Vector3(p.x(), p.y(), known.height)); };
  const auto way = [&](const Vector2& v) { return plane.xyzFromPlane(Vector3(v.x(), v.y(), 0)); };
  ExpectedCorner expected;
  expected.corner = place(known.corner);
  for (std::size_t i = 0; i < 2; ++i)
    expected.sides[i] = {place(known.point[i]), way(known.into[i])};
  expected.tool = tool;
  expected.from = known.from;
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
