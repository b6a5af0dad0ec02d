#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meant.hpp"
#include "simulation/cad_solid.hpp"
#include "written_step.hpp"

/// Edges that say where they lie on a surface, in whatever turn of its parameters.
namespace probewright::simulation {
namespace {

using namespace testing;

/// A piece of a cylinder whose four edges have curves on the surface, each shifted by turns of its own.
std::string patch(const Pose& pose, double u0, double u1, double z0, double z1, const std::array<int, 4>& turns,
                  const std::string& master) {
  constexpr double kRadius = 12;
  StepFile file;
  const int surface = file.add(fmt::format("CYLINDRICAL_SURFACE('',#{},{})", file.axes(pose), file.length(kRadius)));
  const int flat =
      file.add("(GEOMETRIC_REPRESENTATION_CONTEXT(2)PARAMETRIC_REPRESENTATION_CONTEXT()REPRESENTATION_CONTEXT('',''))");
  const auto at = [&](double u, double z) {
    return Vector3(pose * Vector3(kRadius * std::cos(u), kRadius * std::sin(u), z));
  };
  const std::array<Vector2, 4> corners{Vector2(u0, z0), Vector2(u1, z0), Vector2(u1, z1), Vector2(u0, z1)};
  std::array<int, 4> vertices{};
  for (std::size_t i = 0; i < 4; ++i)
    vertices[i] = file.vertex(at(corners[i].x(), corners[i].y()));
  std::string uses;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2 a = corners[i], b = corners[(i + 1) % 4], way = (b - a).normalized();
    const bool round = i % 2 == 0;
    int curve = 0;
    if (round) {
      const Vector3 z = i == 0 ? Vector3(pose.linear().col(2)) : Vector3(-pose.linear().col(2));
      const int axes = file.axes(pose * Vector3(0, 0, a.y()), z, pose.linear().col(0));
      curve = file.add(fmt::format("CIRCLE('',#{},{})", axes, file.length(kRadius)));
    } else {
      const Vector3 up = way.y() * pose.linear().col(2);
      const int vector = file.add(fmt::format("VECTOR('',#{},1.)", file.direction(up)));
      curve = file.add(fmt::format("LINE('',#{},#{})", file.point(at(a.x(), a.y())), vector));
    }
    // A circle's parameter is an angle, as u is; the line begins where that is zero.
    const double begin = round ? 0 : a.x();
    const int start = file.add(fmt::format("CARTESIAN_POINT('',({},{}))",
                                           file.angle(begin + 2 * std::numbers::pi * turns[i]), file.length(a.y())));
    const int direction = file.add(fmt::format("DIRECTION('',({},{}))", file.angle(way.x()), file.length(way.y())));
    const int vector = file.add(fmt::format("VECTOR('',#{},1.)", direction));
    const int line = file.add(fmt::format("LINE('',#{},#{})", start, vector));
    const int definition = file.add(fmt::format("DEFINITIONAL_REPRESENTATION('',(#{}),#{})", line, flat));
    const int onSurface = file.add(fmt::format("PCURVE('',#{},#{})", surface, definition));
    const int both = file.add(fmt::format("SURFACE_CURVE('',#{},(#{}),.{}.)", curve, onSurface, master));
    const int edge = file.add(fmt::format("EDGE_CURVE('',#{},#{},#{},.T.)", vertices[i], vertices[(i + 1) % 4], both));
    uses += fmt::format("{}#{}", i == 0 ? "" : ",", file.add(fmt::format("ORIENTED_EDGE('',*,*,#{},.T.)", edge)));
  }
  const int bound =
      file.add(fmt::format("FACE_OUTER_BOUND('',#{},.T.)", file.add(fmt::format("EDGE_LOOP('',({}))", uses))));
  const int face = file.add(fmt::format("ADVANCED_FACE('',(#{}),#{},.T.)", bound, surface));
  const int shell = file.add(fmt::format("OPEN_SHELL('',(#{}))", face));
  file.represent(file.product("skin"), {file.add(fmt::format("SHELL_BASED_SURFACE_MODEL('',(#{}))", shell))},
                 "MANIFOLD_SURFACE_SHAPE_REPRESENTATION");
  return file.text();
}

TEST(ShiftedCurves, OnASurfaceLeaveTheFaceWhereItIs) {
  std::mt19937_64 random(211);
  const ScratchFolder folder;
  int k = 0;
  for (const std::string master : {"CURVE_3D", "PCURVE_S1"}) {
    for (const std::array<int, 4>& turns : {std::array{0, 0, 0, 0}, std::array{1, 1, 1, 1}, std::array{-2, -2, -2, -2},
                                            std::array{0, 1, 0, -1}, std::array{2, 0, -1, 0}}) {
      const Pose pose = randomPose(random, 40);
      const double u0 = uniform(random, -3, 3), u1 = u0 + uniform(random, 0.8, 5);
      const auto solid = readStep(folder.write("part.step", patch(pose, u0, u1, -5, 20, turns, master)));
      const std::string name = fmt::format("patch {} {}", k++, master);
      ASSERT_TRUE(solid) << name << ": " << format(solid.error());
      expectAsMeant(name, **solid, distanceOfShell(12, -5, 20, u0, u1, pose), 40, pose * Vector3(0, 0, 7), random, 40);
    }
  }
}

}  // namespace
}  // namespace probewright::simulation
