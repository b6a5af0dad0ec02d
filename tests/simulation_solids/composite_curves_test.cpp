#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "meant.hpp"
#include "simulation/cad_solid.hpp"
#include "written_step.hpp"

/// STEP files with composite and trimmed curves: as borders of surfaces, as curves of edges, as curves that are swept.
namespace probewright::simulation {
namespace {

using namespace testing;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

int line(StepFile& file, const Vector3& from, const Vector3& to) {
  const int vector =
      file.add(fmt::format("VECTOR('',#{},{})", file.direction((to - from).normalized()), file.length(1)));
  return file.add(fmt::format("LINE('',#{},#{})", file.point(from), vector));
}

/// Trimmed by parameters, by points, or by both.
int trimmed(StepFile& file, int curve, const std::string& from, const std::string& to, const Vector3& start,
            const Vector3& end, bool forwards, std::size_t how) {
  const auto trim = [&](const std::string& parameter, const Vector3& place) {
    const std::string value = fmt::format("PARAMETER_VALUE({})", parameter);
    const std::string point = how % 3 > 0 ? fmt::format("#{}", file.point(place)) : "";
    return how % 3 == 0 ? value : how % 3 == 1 ? point : point + "," + value;
  };
  const std::string a = trim(from, start), b = trim(to, end);
  return file.add(fmt::format("TRIMMED_CURVE('',#{},({}),({}),{},{})", curve, a, b, forwards ? ".T." : ".F.",
                              how % 3 == 1 ? ".CARTESIAN." : ".PARAMETER."));
}

int trimmedLine(StepFile& file, const Vector3& from, const Vector3& to, std::size_t how) {
  // The parameter of a line is the way over the length of its vector, here 1 mm.
  return trimmed(file, line(file, from, to), "0.", fmt::format("{:.15f}", (to - from).norm()), from, to, true, how);
}

/// An arc about z of the pose from one angle to another, either way.
int trimmedArc(StepFile& file, const Pose& pose, double radius, double from, double to, std::size_t how) {
  const int circle = file.add(fmt::format("CIRCLE('',#{},{})", file.axes(pose), file.length(radius)));
  const auto at = [&](double angle) {
    return Vector3(pose * Vector3(radius * std::cos(angle), radius * std::sin(angle), 0));
  };
  return trimmed(file, circle, file.angle(from), file.angle(to), at(from), at(to), to > from, how);
}

int compositeCurve(StepFile& file, const std::string& type, const std::vector<int>& curves,
                   const std::vector<bool>& forwards = {}) {
  std::vector<int> segments;
  for (std::size_t i = 0; i < curves.size(); ++i)
    segments.push_back(file.add(fmt::format("COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,{},#{})",
                                            forwards.empty() || forwards[i] ? ".T." : ".F.", curves[i])));
  return file.add(fmt::format("{}('',({}),.F.)", type, listOf(segments)));
}

/// A window in a cylinder of radius 12 about Z, cut by curves in space.
TEST(CompositeCurves, BoundWindowsInCylinders) {
  std::mt19937_64 random(501);
  for (std::size_t round = 0; round < 12; ++round) {
    StepFile file({round % 2 == 0 ? 1.0 : 25.4, round % 3 == 0});
    const Pose pose = randomPose(random, 40);
    const double b0 = uniform(random, -2, 4), b1 = b0 + uniform(random, 0.5, 3), c0 = -5, c1 = 20;
    const int cylinder = file.add(fmt::format("CYLINDRICAL_SURFACE('',#{},{})", file.axes(pose), file.length(12)));
    const auto at = [&](double angle, double z) {
      return Vector3(pose * Vector3(12 * std::cos(angle), 12 * std::sin(angle), z));
    };
    const double half = (b0 + b1) / 2;
    const Pose low = pose * translation(Vector3(0, 0, c0)), high = pose * translation(Vector3(0, 0, c1));
    std::vector<int> curves{trimmedArc(file, low, 12, b0, half, round), trimmedArc(file, low, 12, half, b1, round),
                            trimmedLine(file, at(b1, c0), at(b1, c1), round)};
    std::vector<bool> forwards(5, true);
    // The upper arc the other way round, or its segment.
    if (round % 4 < 2) {
      curves.push_back(trimmedArc(file, high, 12, b1, b0, round));
    } else {
      curves.push_back(trimmedArc(file, high, 12, b0, b1, round));
      forwards[3] = false;
    }
    curves.push_back(trimmedLine(file, at(b0, c1), at(b0, c0), round));
    const int border =
        compositeCurve(file, round % 2 == 0 ? "BOUNDARY_CURVE" : "OUTER_BOUNDARY_CURVE", curves, forwards);
    const int face = file.add(fmt::format("CURVE_BOUNDED_SURFACE('',#{},(#{}),.F.)", cylinder, border));
    const int set = file.add(fmt::format("GEOMETRIC_SET('',(#{}))", face));
    file.represent(file.product("skin"), {set}, "GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION");
    expectStepAsMeant(fmt::format("window {}", round), file.text(), distanceOfShell(12, c0, c1, b0, b1, pose), 40,
                      at(half, 7), random, 60);
  }
}

/// A stadium of two lines and two ends in the plane z = 0 of a pose: 30 between the centres, radius 9.
std::vector<int> stadium(StepFile& file, const Pose& pose, std::size_t how) {
  const auto at = [&](double x, double y) { return Vector3(pose * Vector3(x, y, 0)); };
  const Pose right = pose * translation(Vector3(15, 0, 0)), left = pose * translation(Vector3(-15, 0, 0));
  return {trimmedArc(file, right, 9, -kPi / 2, kPi / 2, how), trimmedLine(file, at(15, 9), at(-15, 9), how),
          trimmedArc(file, left, 9, kPi / 2, 3 * kPi / 2, how), trimmedLine(file, at(-15, -9), at(15, -9), how)};
}

Distance distanceOfPlate(const Pose& pose) {
  const Pose back = pose.inverse();
  return [back](const Vector3& p) {
    const Vector3 q = back * p;
    const double aside = std::max(0.0, std::hypot(std::max(0.0, std::abs(q.x()) - 15), q.y()) - 9);
    const double hole = std::max(0.0, 4 - (q.head<2>() - Vector2(-12, 1)).norm());
    return std::hypot(std::max(aside, hole), q.z());
  };
}

TEST(CompositeCurves, BoundPlatesWithHoles) {
  std::mt19937_64 random(502);
  for (std::size_t round = 0; round < 6; ++round) {
    StepFile file({round % 2 == 0 ? 25.4 : 1.0, round % 3 == 0});
    const Pose pose = randomPose(random, 40);
    const int plane = file.add(fmt::format("PLANE('',#{})", file.axes(pose)));
    const int outer = compositeCurve(file, "OUTER_BOUNDARY_CURVE", stadium(file, pose, round));
    const Pose hole = pose * translation(Vector3(-12, 1, 0));
    const int inner = compositeCurve(
        file, "BOUNDARY_CURVE",
        {trimmedArc(file, hole, 4, 0.3, 0.3 + kPi, round), trimmedArc(file, hole, 4, 0.3 + kPi, 0.3 + 2 * kPi, round)});
    const int face = file.add(fmt::format("CURVE_BOUNDED_SURFACE('',#{},(#{},#{}),.F.)", plane, outer, inner));
    const int set = file.add(fmt::format("GEOMETRIC_SET('',(#{}))", face));
    file.represent(file.product("skin"), {set}, "GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION");
    expectStepAsMeant(fmt::format("plate {}", round), file.text(), distanceOfPlate(pose), 50, pose.translation(),
                      random, 40);
  }
}

}  // namespace
}  // namespace probewright::simulation
