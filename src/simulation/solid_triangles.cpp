#include "simulation/solid_triangles.hpp"

#include <cmath>
#include <numbers>

#include "simulation/analytic_solids.hpp"

namespace probewright::simulation {

namespace {

void add(std::vector<float>& values, const Vector3& v) {
  for (Eigen::Index i = 0; i < 3; ++i)
    values.push_back(static_cast<float>(v[i]));
}

/// A flat face, convex, its corners counter-clockwise seen from outside.
void addFace(DrawingMesh& mesh, const std::vector<Vector3>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  for (const Vector3& corner : corners) {
    add(mesh.positions, corner);
    add(mesh.normals, normal);
  }
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i)
    mesh.indices.insert(mesh.indices.end(), {first, first + i, first + i + 1});
}

void addLoop(DrawingMesh& mesh, const std::vector<Vector3>& corners) {
  std::vector<float>& line = mesh.featureEdges.emplace_back();
  for (const Vector3& corner : corners)
    add(line, corner);
  add(line, corners.front());
}

DrawingMesh boxTriangles(const Bounds& box) {
  DrawingMesh mesh;
  // Each coordinate 0 or 1: the lower or the upper limit of the box.
  const auto corner = [&](int x, int y, int z) {
    return Vector3(x == 1 ? box.maximum.x() : box.minimum.x(), y == 1 ? box.maximum.y() : box.minimum.y(),
                   z == 1 ? box.maximum.z() : box.minimum.z());
  };
  const std::vector<Vector3> below = {corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)};
  const std::vector<Vector3> above = {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)};
  addFace(mesh, below);
  addFace(mesh, above);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3 &from = above[i], &to = above[(i + 1) % 4];
    const Vector3 fromBelow(from.x(), from.y(), box.minimum.z()), toBelow(to.x(), to.y(), box.minimum.z());
    addFace(mesh, {fromBelow, toBelow, to, from});
    mesh.featureEdges.push_back({});
    add(mesh.featureEdges.back(), fromBelow);
    add(mesh.featureEdges.back(), from);
  }
  addLoop(mesh, below);
  addLoop(mesh, above);
  return mesh;
}

DrawingMesh barTriangles(const Bounds& box) {
  constexpr std::uint32_t corners = 72;
  DrawingMesh mesh;
  std::vector<Vector3> above, below;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / corners;
    const double x = box.maximum.x() * std::cos(angle), y = box.maximum.x() * std::sin(angle);
    above.emplace_back(x, y, box.maximum.z());
    below.emplace_back(x, y, box.minimum.z());
  }
  addFace(mesh, above);
  addFace(mesh, {below.rbegin(), below.rend()});
  const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
  for (std::size_t i = 0; i < corners; ++i) {
    for (const Vector3& point : {below[i], above[i]}) {
      add(mesh.positions, point);
      add(mesh.normals, Vector3(point.x(), point.y(), 0).normalized());
    }
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % corners);
    for (const std::uint32_t corner : {a, b, b + 1, a, b + 1, a + 1})
      mesh.indices.push_back(corner);
  }
  addLoop(mesh, below);
  addLoop(mesh, above);
  return mesh;
}

}  // namespace

DrawingMesh solidTriangles(const Solid& solid) {
  if (dynamic_cast<const Box*>(&solid) != nullptr) return boxTriangles(solid.bounds());
  if (dynamic_cast<const RoundBar*>(&solid) != nullptr) return barTriangles(solid.bounds());
  return drawingMesh(solid);
}

}  // namespace probewright::simulation
