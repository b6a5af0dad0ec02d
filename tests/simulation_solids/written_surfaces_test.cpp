#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "meant.hpp"
#include "oracle.hpp"
#include "written_step.hpp"

/// Surfaces as files write them that OpenCASCADE did not write: trimmed, as splines in every form, extruded.
namespace probewright::simulation {
namespace {

using namespace testing;

TEST(WrittenParts, OfTrimmedSurfacesWithoutFacesAreMetWhereTheyAre) {
  std::mt19937_64 random(208);
  for (int round = 0; round < 6; ++round) {
    const Pose pose = randomPose(random, 40);
    StepFile file({round % 2 == 0 ? 1.0 : 25.4, round % 3 == 0});
    const double u0 = 2 * std::numbers::pi * (round - 2) + uniform(random, -3, 3), u1 = u0 + uniform(random, 0.5, 6);
    const int cylinder = file.add(fmt::format("CYLINDRICAL_SURFACE('',#{},{})", file.axes(pose), file.length(12)));
    const int trimmed = file.add(fmt::format("RECTANGULAR_TRIMMED_SURFACE('',#{},{},{},{},{},.T.,.T.)", cylinder,
                                             file.angle(u0), file.angle(u1), file.length(-5), file.length(20)));
    const int set = file.add(fmt::format("GEOMETRIC_SET('',(#{}))", trimmed));
    file.represent(file.product("skin"), {set}, "GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION");
    expectStepAsMeant(fmt::format("trimmed {}", round), file.text(), distanceOfShell(12, -5, 20, u0, u1, pose), 40,
                      pose * Vector3(0, 0, 7), random, 40);
  }
}

TEST(WrittenParts, OfSplinesInEveryFormAreMetWhereTheyAre) {
  std::mt19937_64 random(209);
  for (const std::string form : {"UNIFORM", "QUASI_UNIFORM", "KNOTS"}) {
    const Pose pose = randomPose(random, 40);
    StepFile file({25.4, false});
    std::string points;
    for (int i = 0; i < 6; ++i) {
      std::string row;
      for (int j = 0; j < 5; ++j)
        row += fmt::format("{}#{}", row.empty() ? "" : ",", file.point(pose * Vector3(8.0 * i, 6.0 * j, 4)));
      points += fmt::format("{}({})", points.empty() ? "" : ",", row);
    }
    const std::string type = form == "KNOTS" ? "B_SPLINE_SURFACE_WITH_KNOTS" : form + "_SURFACE";
    const std::string knots = form == "KNOTS" ? ",(1,1,1,1,1,1,1,1,1,1),(1,1,1,1,1,1,1,1,1),(-3.,-2.,-1.,0.,1.,2.,3.,"
                                                "4.,5.,6.),(-3.,-2.,-1.,0.,1.,2.,3.,4.,5.),.UNIFORM_KNOTS."
                                              : "";
    const int surface = file.add(fmt::format("{}('',3,3,({}),.UNSPECIFIED.,.F.,.F.,.F.{})", type, points, knots));
    // Poles in equal distances make a plane; a cubic spline with knots at its ends covers all of it, a uniform one goes
    // from the second pole to the last but one.
    const bool clamped = form == "QUASI_UNIFORM";
    const Vector3 low = clamped ? Vector3(0, 0, 4) : Vector3(8, 6, 4);
    const Vector3 high = clamped ? Vector3(40, 24, 4) : Vector3(32, 18, 4);
    const int set = file.add(fmt::format("GEOMETRIC_SET('',(#{}))", surface));
    file.represent(file.product("skin"), {set}, "GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION");
    expectStepAsMeant(form, file.text(), distanceOfBlock(high - low, pose * translation((low + high) / 2)), 40,
                      pose * Vector3(15, 10, 5), random, 60);
  }
}

/// A stadium: 30 between the centres, ends of radius 9, 12 high; its sides are extruded curves.
Distance distanceOfStadium(const Pose& pose) {
  const Pose back = pose.inverse();
  return [back](const Vector3& p) {
    const Vector3 q = back * p;
    const double across = std::hypot(std::max(0.0, std::abs(q.x()) - 15), q.y()) - 9;
    const double along = std::abs(q.z() - 6) - 6;
    if (across <= 0 && along <= 0) return std::min(-across, -along);
    return std::hypot(std::max(0.0, across), std::max(0.0, along));
  };
}

TEST(WrittenParts, OfExtrudedCurvesAreMetWhereTheyAre) {
  std::mt19937_64 random(210);
  for (int round = 0; round < 8; ++round) {
    const bool down = round % 2 == 1, trimmedCurves = round / 2 % 2 == 1, polylines = round / 4 == 1;
    const Pose pose = randomPose(random, 40);
    StepFile file({round % 3 == 0 ? 1.0 : 25.4, round % 2 == 0});
    const auto at = [&](double x, double y, double z) { return Vector3(pose * Vector3(x, y, z)); };
    const Vector3 z = pose.linear().col(2), x = pose.linear().col(0);
    const std::array<Vector2, 4> corners{Vector2(15, -9), Vector2(15, 9), Vector2(-15, 9), Vector2(-15, -9)};
    std::array<std::array<int, 4>, 2> vertices{}, rings{};
    std::array<int, 4> posts{};
    const auto curve = [&](std::size_t side, double height) {
      const Vector2 a = corners[side], b = corners[(side + 1) % 4];
      if (side % 2 == 0) {
        const int axes = file.axes(at(side == 0 ? 15 : -15, 0, height), z, x);
        const int circle = file.add(fmt::format("CIRCLE('',#{},{})", axes, file.length(9)));
        if (!trimmedCurves) return circle;
        const double from = (side == 0 ? -0.5 : 0.5) * std::numbers::pi;
        return file.add(fmt::format("TRIMMED_CURVE('',#{},(PARAMETER_VALUE({})),(PARAMETER_VALUE({})),.T.,.PARAMETER.)",
                                    circle, file.angle(from), file.angle(from + std::numbers::pi)));
      }
      if (polylines)
        return file.add(fmt::format("POLYLINE('',(#{},#{}))", file.point(at(a.x(), a.y(), height)),
                                    file.point(at(b.x(), b.y(), height))));
      const Vector3 way = (at(b.x(), b.y(), 0) - at(a.x(), a.y(), 0)).normalized();
      const int vector = file.add(fmt::format("VECTOR('',#{},2.5)", file.direction(way)));
      return file.add(fmt::format("LINE('',#{},#{})", file.point(at(a.x(), a.y(), height)), vector));
    };
    const auto edge = [&](int from, int to, int along) {
      return file.add(fmt::format("EDGE_CURVE('',#{},#{},#{},.T.)", from, to, along));
    };
    for (std::size_t level = 0; level < 2; ++level) {
      for (std::size_t i = 0; i < 4; ++i)
        vertices[level][i] = file.vertex(at(corners[i].x(), corners[i].y(), level == 0 ? 0 : 12));
      for (std::size_t i = 0; i < 4; ++i)
        rings[level][i] = edge(vertices[level][i], vertices[level][(i + 1) % 4], curve(i, level == 0 ? 0 : 12));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const int vector = file.add(fmt::format("VECTOR('',#{},1.)", file.direction(z)));
      const int line =
          file.add(fmt::format("LINE('',#{},#{})", file.point(at(corners[i].x(), corners[i].y(), 5)), vector));
      posts[i] = edge(vertices[0][i], vertices[1][i], line);
    }
    const auto bound = [&](const std::vector<std::pair<int, bool>>& uses) {
      std::vector<int> oriented;
      for (const auto& [used, forwards] : uses)
        oriented.push_back(file.add(fmt::format("ORIENTED_EDGE('',*,*,#{},{})", used, forwards ? ".T." : ".F.")));
      return file.add(
          fmt::format("FACE_OUTER_BOUND('',#{},.T.)", file.add(fmt::format("EDGE_LOOP('',({}))", listOf(oriented)))));
    };
    std::vector<int> faces;
    for (std::size_t i = 0; i < 4; ++i) {
      const int vector =
          file.add(fmt::format("VECTOR('',#{},{})", file.direction(down ? Vector3(-z) : z), file.length(3.7)));
      // The normal is that of the curve's direction times the vector.
      const int surface = file.add(fmt::format("SURFACE_OF_LINEAR_EXTRUSION('',#{},#{})", curve(i, 4), vector));
      const int loop =
          bound({{rings[0][i], true}, {posts[(i + 1) % 4], true}, {rings[1][i], false}, {posts[i], false}});
      faces.push_back(file.add(fmt::format("ADVANCED_FACE('',(#{}),#{},{})", loop, surface, down ? ".F." : ".T.")));
    }
    for (std::size_t level = 0; level < 2; ++level) {
      std::vector<std::pair<int, bool>> uses;
      for (std::size_t i = 0; i < 4; ++i)
        uses.emplace_back(rings[level][level == 0 ? 3 - i : i], level == 1);
      const int plane = file.add(
          fmt::format("PLANE('',#{})", file.axes(at(3, 4, level == 0 ? 0 : 12), level == 0 ? Vector3(-z) : z, x)));
      faces.push_back(file.add(fmt::format("ADVANCED_FACE('',(#{}),#{},.T.)", bound(uses), plane)));
    }
    expectStepAsMeant(fmt::format("extruded {}", round), file.withItems({file.solid(faces)}), distanceOfStadium(pose),
                      50, at(0, 0, 6), random, 30);
  }
}

}  // namespace
}  // namespace probewright::simulation
