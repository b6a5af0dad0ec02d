#include "setup/tool_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/cutting_edges.hpp"

namespace probewright::setup {

namespace {

using reports::Vector3f;
using simulation::TrueCutter;
using simulation::TrueInsert;
using simulation::TrueTooth;

constexpr int segments = 48;  ///< about the axis
constexpr double pi = std::numbers::pi;

/// Radius and height of an outline, from the axis at the end of the tool upwards.
using Outline = std::vector<Vector2>;

/// End, corner and circumference of what cuts, up to `height`.
Outline cuttingOutline(const simulation::TrueTool& tool, double height) {
  const TrueCutter& cutter = tool.cutter;
  const double radius = tool.radius, corner = std::min(cutter.cornerRadius, radius);
  Outline outline = {{0, 0}};
  if (cutter.pointAngle < 180) {
    outline.emplace_back(radius, radius / std::tan(radiansFromDegrees(cutter.pointAngle / 2)));
  } else {
    constexpr int steps = 8;
    for (int i = 0; i <= steps; ++i) {
      const double angle = pi / 2 * i / steps;
      outline.emplace_back(radius - corner + corner * std::sin(angle), corner - corner * std::cos(angle));
      if (corner == 0) break;
    }
  }
  if (height > outline.back().y()) outline.emplace_back(radius, height);
  return outline;
}

/// A body that is round about the axis.
void addRound(reports::Mesh& mesh, const Outline& outline, const Vector2& aside) {
  for (std::size_t i = 1; i < outline.size(); ++i) {
    const Vector2 &from = outline[i - 1], &to = outline[i];
    const Vector2 way = to - from;
    if (way.norm() < 1e-9) continue;
    const Vector2 normal = Vector2(way.y(), -way.x()).normalized();
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < segments; ++k) {
      const double angle = 2 * pi * k / segments, c = std::cos(angle), s = std::sin(angle);
      for (const Vector2& point : {from, to}) {
        mesh.positions.emplace_back(
            Vector3(aside.x() + point.x() * c, aside.y() + point.x() * s, point.y()).cast<float>());
        mesh.normals.emplace_back(Vector3(normal.x() * c, normal.x() * s, normal.y()).cast<float>());
      }
    }
    for (std::uint32_t k = 0; k < segments; ++k) {
      const std::uint32_t a = first + 2 * k, b = first + 2 * ((k + 1) % segments);
      for (const std::uint32_t corner : {a, b, b + 1, a, b + 1, a + 1})
        mesh.triangles.push_back(corner);
    }
  }
}

void addLine(reports::Mesh& mesh, const std::vector<Vector3>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    mesh.featureEdges.emplace_back(points[i - 1].cast<float>());
    mesh.featureEdges.emplace_back(points[i].cast<float>());
  }
}

/// The edge of a tooth: the outline wound by the helix, without what has broken off.
void addTooth(reports::Mesh& mesh, const simulation::TrueTool& tool, const TrueTooth& tooth, const Outline& outline,
              const Vector2& aside) {
  const double winding = tool.radius > 0 ? std::tan(radiansFromDegrees(tool.cutter.helix)) / tool.radius : 0;
  std::vector<Vector3> points;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    constexpr int steps = 12;
    for (int k = i == 1 ? 0 : 1; k <= steps; ++k) {
      const Vector2 place = outline[i - 1] + (outline[i] - outline[i - 1]) * (static_cast<double>(k) / steps);
      if (place.y() < tooth.broken) continue;
      // A hair outside the body, which would hide it.
      const double radius = 1.002 * place.x() + tooth.radial - tooth.radialWear;
      const double angle = radiansFromDegrees(tooth.angle) + winding * place.y();
      points.emplace_back(aside.x() + radius * std::cos(angle), aside.y() + radius * std::sin(angle),
                          place.y() - tooth.axial + tooth.axialWear);
    }
  }
  addLine(mesh, points);
}

/// The outline of an insert `depth` across its plane, where its flank has receded. Its theoretical tip is beside the
/// axis.
std::vector<Vector3> insertOutline(const simulation::TrueTool& tool, double depth) {
  const TrueInsert& insert = *tool.cutter.insert;
  const double first = radiansFromDegrees(insert.firstNormal);
  const double second = first + std::remainder(radiansFromDegrees(insert.secondNormal) - first, 2 * pi);
  const double middle = (first + second) / 2, turn = second > first ? 1 : -1;
  const auto sign = [](double value) { return std::abs(value) < 1e-9 ? 0.0 : value < 0 ? -1.0 : 1.0; };
  const auto along = [](double angle) { return Vector2(std::cos(angle), std::sin(angle)); };
  const auto across = [](double angle) { return Vector2(-std::sin(angle), std::cos(angle)); };
  const Vector2 centre = -insert.noseRadius * Vector2(sign(std::cos(middle)), sign(std::sin(middle)));
  const double radius = insert.noseRadius - insert.wear - depth * std::tan(radiansFromDegrees(insert.clearance));
  std::vector<Vector2> face = {centre + radius * along(first) - turn * insert.edgeLength * across(first)};
  constexpr int steps = 10;
  for (int i = 0; i <= steps; ++i)
    face.push_back(centre + radius * along(first + (second - first) * i / steps));
  face.push_back(centre + radius * along(second) + turn * insert.edgeLength * across(second));
  const Vector2 aside = offsetOf(tool.cutter);
  const double plane = radiansFromDegrees(insert.orientation), beside = insert.thickness < 0 ? -depth : depth;
  std::vector<Vector3> outline;
  for (const Vector2& point : face) {
    outline.emplace_back(aside.x() + point.x() * std::cos(plane) - beside * std::sin(plane),
                         aside.y() + point.x() * std::sin(plane) + beside * std::cos(plane), point.y());
  }
  return outline;
}

/// A flat strip or fan with its own corners; `normal` is not turned.
void addFace(reports::Mesh& mesh, const std::vector<Vector3>& corners, const Vector3& normal) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector3& corner : corners) {
    mesh.positions.emplace_back(corner.cast<float>());
    mesh.normals.emplace_back(normal.cast<float>());
  }
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i)
    for (const std::uint32_t corner : {base, base + i, base + i + 1})
      mesh.triangles.push_back(corner);
}

/// The face of an insert, and its flank.
void addInsert(reports::Mesh& mesh, const simulation::TrueTool& tool) {
  const double plane = radiansFromDegrees(tool.cutter.insert->orientation);
  const Vector3 across(-std::sin(plane), std::cos(plane), 0);
  const std::vector<Vector3> face = insertOutline(tool, 0);
  addFace(mesh, face, across);
  addLine(mesh, face);
  const double flank = simulation::flankDepth(*tool.cutter.insert);
  if (flank <= 0) return;
  const std::vector<Vector3> back = insertOutline(tool, flank);
  addFace(mesh, back, across);
  for (std::size_t i = 1; i < face.size(); ++i) {
    const Vector3 normal = (face[i] - face[i - 1]).cross(back[i] - face[i]);
    addFace(mesh, {face[i - 1], face[i], back[i], back[i - 1]}, normal.normalized());
  }
}

}  // namespace

reports::Mesh drawnTool(const simulation::TrueTool& tool) {
  const TrueCutter& cutter = tool.cutter;
  reports::Mesh mesh;
  mesh.name = tool.name;
  const double body = tool.length - cutter.holderLength;
  const double edges = cutter.cutLength > 0 ? std::min(cutter.cutLength, body) : std::min(body, 4 * tool.radius);
  const double shank = cutter.shankRadius > 0 ? cutter.shankRadius : tool.radius;
  Outline outline;
  Vector2 aside = Vector2::Zero();
  if (cutter.insert) {
    outline = {{0, cutter.insert->edgeLength}, {shank, cutter.insert->edgeLength}};
    addInsert(mesh, tool);
  } else {
    outline = cuttingOutline(tool, edges);
    aside = cutter.eccentricity;
    for (const TrueTooth& tooth : cutter.teeth)
      addTooth(mesh, tool, tooth, outline, aside);
    outline.emplace_back(shank, outline.back().y());
  }
  if (body > outline.back().y()) outline.emplace_back(shank, body);
  if (cutter.holderRadius > 0) {
    outline.emplace_back(cutter.holderRadius, body);
    outline.emplace_back(cutter.holderRadius, tool.length);
  }
  outline.emplace_back(0, outline.back().y());
  addRound(mesh, outline, aside);
  return mesh;
}

}  // namespace probewright::setup
