#include "truth/expected_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "control/working_plane.hpp"
#include "truth/feeling.hpp"

namespace probewright::truth {

namespace {

/// A HEIDENHAIN cycle that looks for walls.
struct Cycle {
  std::string_view name;
  bool inside;
  std::array<std::string_view, 2> centre, lengths;  ///< one length: across the axis in Q272
};
constexpr std::array cycles = {
    Cycle{"408", true, {"Q321", "Q322"}, {"Q311", ""}},     Cycle{"409", false, {"Q321", "Q322"}, {"Q311", ""}},
    Cycle{"410", true, {"Q321", "Q322"}, {"Q323", "Q324"}}, Cycle{"411", false, {"Q321", "Q322"}, {"Q323", "Q324"}},
    Cycle{"423", true, {"Q273", "Q274"}, {"Q282", "Q283"}}, Cycle{"424", false, {"Q273", "Q274"}, {"Q282", "Q283"}},
};

/// The direction at `degrees` from the main axis of the plane, to the minor one.
Vector3 directionAt(const control::WorkingPlane& plane, double degrees) {
  const double angle = radiansFromDegrees(degrees);
  return plane.xyzFromPlane(Vector3(std::cos(angle), std::sin(angle), 0));
}

/// Pairs of these widths along main and minor axis, turned by `degrees`; nothing where one of them is no width.
std::vector<WallPair> pairsOf(const control::WorkingPlane& plane, std::optional<double> main,
                              std::optional<double> minor, double degrees = 0) {
  if (!main || !minor || !(*main > 0) || !(*minor > 0)) return {};
  return {{directionAt(plane, degrees), *main}, {directionAt(plane, degrees + 90), *minor}};
}

std::vector<WallPair> pairAcross(const control::WorkingPlane& plane, std::optional<double> axis,
                                 std::optional<double> width, double degrees = 0) {
  if (!axis || !width || !(*width > 0) || (*axis != 1 && *axis != 2)) return {};
  return {{directionAt(plane, degrees + (*axis == 2 ? 90 : 0)), *width}};
}

std::optional<ExpectedWalls> ofSinumerik(const control::CycleRecord& cycle, const control::WorkingPlane& plane,
                                         const Vector3& start) {
  const auto variant = valueOf(cycle, "S_MVAR");
  const int feature = variant ? static_cast<int>(*variant) % 10 : 0;
  if (cycle.name != "CYCLE977" || feature < 3 || feature > 6) return std::nullopt;
  const double angle = valueOf(cycle, "S_STA1").value_or(0);
  ExpectedWalls expected;
  expected.inside = feature == 3 || feature == 5;
  expected.pairs = feature <= 4 ? pairAcross(plane, valueOf(cycle, "S_MA"), valueOf(cycle, "S_SETV"), angle)
                                : pairsOf(plane, valueOf(cycle, "S_SETV0"), valueOf(cycle, "S_SETV1"), angle);
  if (expected.pairs.empty()) return std::nullopt;
  Vector3 inPlane = plane.planeFromXyz(start);
  if (!expected.inside) inPlane.z() += valueOf(cycle, "S_ID").value_or(0);
  expected.centre = plane.xyzFromPlane(inPlane);
  expected.from = "the start position";
  return expected;
}

}  // namespace

std::optional<ExpectedWalls> expectedWalls(const control::CycleRecord& cycle, int tool, const Vector3& start) {
  const control::WorkingPlane plane = control::WorkingPlane::ofToolAxis("XYZ"[tool]);
  if (cycle.name.starts_with("CYCLE")) return ofSinumerik(cycle, plane, start);
  const auto kind = std::ranges::find(cycles, cycle.name, &Cycle::name);
  if (kind == cycles.end()) return std::nullopt;
  const auto main = valueOf(cycle, kind->centre[0]), minor = valueOf(cycle, kind->centre[1]);
  if (!main || !minor) return std::nullopt;
  ExpectedWalls expected;
  expected.inside = kind->inside;
  expected.pairs = kind->lengths[1].empty()
                       ? pairAcross(plane, valueOf(cycle, "Q272"), valueOf(cycle, kind->lengths[0]))
                       : pairsOf(plane, valueOf(cycle, kind->lengths[0]), valueOf(cycle, kind->lengths[1]));
  if (expected.pairs.empty()) return std::nullopt;
  const double height = valueOf(cycle, "Q261").value_or(plane.planeFromXyz(start).z());
  expected.centre = plane.xyzFromPlane(Vector3(*main, *minor, height));
  expected.from = std::string(kind->centre[0]) + "/" + std::string(kind->centre[1]);
  return expected;
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
