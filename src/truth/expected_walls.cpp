#include "truth/expected_walls.hpp"

#include <cmath>

#include "control/working_plane.hpp"
#include "truth/feeling.hpp"

namespace probewright::truth {

namespace {

/// The direction at `degrees` from the main axis of the plane, to the minor one.
Vector3 directionAt(const control::WorkingPlane& plane, double degrees) {
  const double angle = radiansFromDegrees(degrees);
  return plane.xyzFromPlane(Vector3(std::cos(angle), std::sin(angle), 0));
}

}  // namespace

std::vector<WallPair> wallPairs(const control::WorkingPlane& plane, std::optional<double> main,
                                std::optional<double> minor, double degrees) {
  if (!main || !minor || !(*main > 0) || !(*minor > 0)) return {};
  return {{directionAt(plane, degrees), *main}, {directionAt(plane, degrees + 90), *minor}};
}

std::vector<WallPair> wallPair(const control::WorkingPlane& plane, std::optional<double> axis,
                               std::optional<double> width, double degrees) {
  if (!axis || !width || !(*width > 0) || (*axis != 1 && *axis != 2)) return {};
  return {{directionAt(plane, degrees + (*axis == 2 ? 90 : 0)), *width}};
}

std::optional<TrueWalls> trueWalls(const ExpectedWalls& expected, const Eigen::Affine3d& tableFromProgram,
                                   const std::vector<simulation::PlacedSolid>& solids) {
  TrueWalls walls;
  walls.centre = tableFromProgram * expected.centre;
  for (const WallPair& pair : expected.pairs) {
    const Vector3 across = (tableFromProgram.linear() * pair.across).normalized();
    const Vector3 far = across * (pair.width / 2 + room);
    const Vector3 middle = walls.centre;
    const auto plus = expected.inside ? felt(solids, middle, middle + far) : felt(solids, middle + far, middle - far);
    const auto minus = expected.inside ? felt(solids, middle, middle - far) : felt(solids, middle - far, middle + far);
    if (!plus || !minus) return std::nullopt;
    const double width = (plus->point - minus->point).dot(across);
    if (!(width >= pair.width / 2 && width <= 2 * pair.width)) return std::nullopt;
    walls.widths.push_back(width);
    walls.centre += across * ((plus->point + minus->point) / 2 - middle).dot(across);
  }
  return walls;
}

}  // namespace probewright::truth
