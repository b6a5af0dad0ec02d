#include "setup/probe_drawing.hpp"

#include <cmath>
#include <numbers>

#include "geometry/decompositions.hpp"
#include "simulation/tool_shape.hpp"

namespace probewright::setup {

namespace {

constexpr std::uint32_t segments = 24;  ///< about an axis

std::uint32_t add(reports::Mesh& mesh, const Vector3& point, const Vector3& normal) {
  mesh.positions.push_back(point.cast<float>());
  mesh.normals.push_back(normal.cast<float>());
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// Rings of points about an axis, each joined with the one before.
void addRings(reports::Mesh& mesh, const Matrix3& frame, const Vector3& origin,
              const std::vector<std::pair<Vector2, Vector2>>& outline) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& [place, normal] : outline) {
    for (std::uint32_t i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments, c = std::cos(angle), s = std::sin(angle);
      add(mesh, origin + frame * Vector3(place.x() * c, place.x() * s, place.y()),
          frame * Vector3(normal.x() * c, normal.x() * s, normal.y()));
    }
  }
  for (std::uint32_t ring = 1; ring < outline.size(); ++ring) {
    for (std::uint32_t i = 0; i < segments; ++i) {
      const std::uint32_t a = first + (ring - 1) * segments + i, b = first + (ring - 1) * segments + (i + 1) % segments;
      for (const std::uint32_t corner : {a, b, b + segments, a, b + segments, a + segments})
        mesh.triangles.push_back(corner);
    }
  }
}

void addShaft(reports::Mesh& mesh, const simulation::Shaft& shaft) {
  const double length = shaft.axis.norm();
  const Matrix3 frame = shortestTurn(Vector3::UnitZ(), shaft.axis).toRotationMatrix();
  const double r = shaft.radius;
  const Vector2 down(0, -1), out(1, 0), up(0, 1);
  addRings(mesh, frame, shaft.start,
           {{{0, 0}, down}, {{r, 0}, down}, {{r, 0}, out}, {{r, length}, out}, {{r, length}, up}, {{0, length}, up}});
}

void addBall(reports::Mesh& mesh, const simulation::Ball& ball) {
  std::vector<std::pair<Vector2, Vector2>> outline;
  constexpr int rings = 12;
  for (int i = 0; i <= rings; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / rings - 0.5);
    const Vector2 normal(std::cos(angle), std::sin(angle));
    outline.emplace_back(ball.radius * normal, normal);
  }
  addRings(mesh, Matrix3::Identity(), ball.centre, outline);
}

}  // namespace

reports::Mesh drawnProbe(const simulation::TrueTool& tool) {
  const simulation::ToolShape shape = simulation::shapeOf(&tool, 0);
  reports::Mesh mesh;
  mesh.name = tool.name;
  for (const simulation::Shaft& shaft : shape.shafts)
    addShaft(mesh, shaft);
  for (const simulation::Ball& ball : shape.balls)
    addBall(mesh, ball);
  return mesh;
}

}  // namespace probewright::setup
