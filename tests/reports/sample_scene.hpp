#pragma once

#include <algorithm>
#include <vector>

#include "records/sample_run.hpp"
#include "reports/scene.hpp"

/// The bearing block of sample_run.hpp in its vice, as a report would draw it.
namespace probewright::sample {

/// The block lies shifted and skewed on the table.
inline Pose blockPose() { return translation({251.437, -98.682, 82}) * rotation(Vector3::UnitZ(), 1.5); }

inline void addQuad(reports::Mesh& mesh, const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 normal = (b - a).cross(c - a).normalized();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector3& p : {a, b, c, d}) {
    mesh.positions.emplace_back(p.cast<float>());
    mesh.normals.emplace_back(normal.cast<float>());
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U})
    mesh.triangles.push_back(first + i);
}

inline void addEdge(reports::Mesh& mesh, const Vector3& a, const Vector3& b) {
  mesh.featureEdges.emplace_back(a.cast<float>());
  mesh.featureEdges.emplace_back(b.cast<float>());
}

inline void addBoxSides(reports::Mesh& mesh, const Vector3& low, const Vector3& high) {
  const Vector3 corners[4] = {
      low, {high.x(), low.y(), low.z()}, {high.x(), high.y(), low.z()}, {low.x(), high.y(), low.z()}};
  const Vector3 up(0, 0, high.z() - low.z());
  for (int i = 0; i < 4; ++i) {
    const Vector3 &a = corners[i], &b = corners[(i + 1) % 4];
    addQuad(mesh, a, b, b + up, a + up);
    addEdge(mesh, a, b);
    addEdge(mesh, a + up, b + up);
    addEdge(mesh, a, a + up);
  }
}

inline reports::Mesh box(const std::string& name, const Vector3& low, const Vector3& high) {
  reports::Mesh mesh;
  mesh.name = name;
  mesh.role = reports::MeshRole::Fixture;
  addBoxSides(mesh, low, high);
  for (const double z : {low.z(), high.z()}) {
    const Vector3 a(low.x(), low.y(), z), b(high.x(), low.y(), z), c(high.x(), high.y(), z), d(low.x(), high.y(), z);
    z > low.z() ? addQuad(mesh, a, b, c, d) : addQuad(mesh, d, c, b, a);
  }
  return mesh;
}

inline reports::Mesh block() {
  const Vector3 low(-blockLength / 2, -blockWidth / 2, -blockHeight), high(blockLength / 2, blockWidth / 2, 0);
  const Vector3 centre(boreX, boreY, 0);
  reports::Mesh mesh;
  mesh.name = "Bearing block";
  mesh.sceneFromMesh = blockPose();
  addBoxSides(mesh, low, high);
  // Rays from the bore's axis cut the faces into quads between bore and rim; the corners get rays of their own.
  std::vector<double> angles;
  for (int i = 0; i < 96; ++i)
    angles.push_back(-std::numbers::pi + i * std::numbers::pi / 48);
  for (const double x : {low.x(), high.x()})
    for (const double y : {low.y(), high.y()})
      angles.push_back(std::atan2(y - boreY, x - boreX));
  std::sort(angles.begin(), angles.end());
  const auto onBore = [&](double angle, double z) -> Vector3 {
    return centre + boreDiameter / 2 * Vector3(std::cos(angle), std::sin(angle), 0) + Vector3(0, 0, z);
  };
  const auto onRim = [&](double angle, double z) -> Vector3 {
    const Vector3 ray(std::cos(angle), std::sin(angle), 0);
    double reach = 1e9;
    for (int axis = 0; axis < 2; ++axis) {
      if (ray[axis] > 1e-12) reach = std::min(reach, (high[axis] - centre[axis]) / ray[axis]);
      if (ray[axis] < -1e-12) reach = std::min(reach, (low[axis] - centre[axis]) / ray[axis]);
    }
    return centre + reach * ray + Vector3(0, 0, z);
  };
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double a = angles[i], b = angles[(i + 1) % angles.size()];
    addQuad(mesh, onBore(a, 0), onRim(a, 0), onRim(b, 0), onBore(b, 0));
    addQuad(mesh, onBore(b, low.z()), onRim(b, low.z()), onRim(a, low.z()), onBore(a, low.z()));
    addQuad(mesh, onBore(b, low.z()), onBore(a, low.z()), onBore(a, 0), onBore(b, 0));
    // The wall of the bore is round: its normals point to the axis.
    const std::size_t first = mesh.normals.size() - 4;
    for (std::size_t k = 0; k < 4; ++k) {
      const double angle = k == 0 || k == 3 ? b : a;
      mesh.normals[first + k] = Vector3(-std::cos(angle), -std::sin(angle), 0).cast<float>();
    }
    addEdge(mesh, onBore(a, 0), onBore(b, 0));
    addEdge(mesh, onBore(a, low.z()), onBore(b, low.z()));
  }
  return mesh;
}

inline reports::Scene scene(const control::Journal& journal) {
  using reports::MoveKind;
  reports::Scene scene;
  scene.meshes = {block(), box("Fixed jaw", {171, -26, 32}, {331, 4, 62}),
                  box("Moving jaw", {171, -200, 32}, {331, -141, 62}), box("Vice", {151, -230, 0}, {351, 30, 32})};
  scene.ballRadius = ballRadius;
  scene.sceneFromWorkpiece = blockPose();
  auto& path = scene.path;
  const auto go = [&](const Vector3& point, MoveKind kind, double speed) {
    const reports::Vector3f to = (blockPose() * point).cast<float>();
    if (!path.points.empty()) {
      path.kinds.push_back(kind);
      path.seconds.push_back(path.seconds.back() + static_cast<float>((to - path.points.back()).norm() / speed));
    } else {
      path.seconds.push_back(0);
    }
    path.points.push_back(to);
  };
  go({0, 0, 100}, MoveKind::Rapid, 250);
  for (std::uint32_t c = 0; c < journal.cycles.size(); ++c) {
    const auto& touches = journal.cycles[c].touches;
    for (std::uint32_t t = 0; t < touches.size(); ++t) {
      Vector3 surface = touches[t].surface;
      // The first two cycles ran in coordinates that they corrected themselves.
      if (c == 0) surface.y() = -blockWidth / 2;
      if (c == 1) surface.z() = 0;
      const Vector3 centre = surface - ballRadius * touches[t].direction;
      const Vector3 start = centre - 5 * touches[t].direction;
      const Vector3 above(start.x(), start.y(), 50);
      const bool inside =
          touches[t].direction.head<2>().dot((centre - Vector3(boreX, boreY, 0)).head<2>()) > 0 && t > 0;
      if (!inside) go(above, MoveKind::Rapid, 250);
      go(start, MoveKind::Feed, 50);
      go(centre, MoveKind::Measure, 5);
      go(start, MoveKind::Feed, 50);
      if (t + 1 == touches.size() || !inside) go(above, MoveKind::Rapid, 250);
      const bool contact = touches[t].outcome == "touched";
      scene.touches.push_back(
          {c, t, (blockPose() * centre).cast<float>(), (blockPose() * (contact ? surface : centre)).cast<float>()});
    }
  }
  go({0, 0, 100}, MoveKind::Rapid, 250);
  return scene;
}

}  // namespace probewright::sample
