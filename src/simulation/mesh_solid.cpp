#include "simulation/mesh_solid.hpp"

#include <algorithm>

#include "simulation/contact.hpp"

namespace probewright::simulation {
namespace {

using Edge = std::pair<std::uint64_t, bool>;  ///< its two corners, and whether it runs from the higher to the lower

/// All edges of the triangles, sorted, so that the two uses of an inner edge stand side by side.
std::vector<Edge> sortedEdges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t a = t[i];
      const std::uint64_t b = t[(i + 1) % 3];
      edges.emplace_back(std::min(a, b) << 32 | std::max(a, b), a > b);
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// True if every edge is used as often in one direction as in the other.
bool everyEdgeIsShared(const TriangleMesh& mesh) {
  const std::vector<Edge> edges = sortedEdges(mesh);
  for (std::size_t i = 0; i < edges.size();) {
    int balance = 0;
    std::size_t j = i;
    for (; j < edges.size() && edges[j].first == edges[i].first; ++j)
      balance += edges[j].second ? 1 : -1;
    if (balance != 0) return false;
    i = j;
  }
  return true;
}

double signedVolume(const TriangleMesh& mesh) {
  double sum = 0;
  const Vector3& origin = mesh.corners.front();
  for (const auto& t : mesh.triangles) {
    sum += (mesh.corners[t[0]] - origin).dot((mesh.corners[t[1]] - origin).cross(mesh.corners[t[2]] - origin));
  }
  return sum / 6;
}

}  // namespace

MeshSolid::MeshSolid(TriangleMesh mesh, Instructions instructions) : mesh_(std::move(mesh)) {
  prepare(nullptr, instructions);
}

MeshSolid::MeshSolid(TriangleMesh mesh, ImportWatch& watch) : mesh_(std::move(mesh)) {
  prepare(&watch, bestInstructions());
}

void MeshSolid::prepare(ImportWatch* watch, Instructions instructions) {
  if (mesh_.triangles.empty()) return;
  const auto at = [watch](const char* stage) {
    if (watch != nullptr) watch->tell(stage, 0, 0);
  };
  at("looking for open edges");
  closed_ = everyEdgeIsShared(mesh_);
  if (closed_ && signedVolume(mesh_) < 0) {
    for (auto& t : mesh_.triangles)
      std::swap(t[1], t[2]);
  }
  const auto triangle = [&](std::size_t i) {
    const auto& t = mesh_.triangles[i];
    return Triangle{mesh_.corners[t[0]], mesh_.corners[t[1]], mesh_.corners[t[2]]};
  };
  at("building the search tree");
  std::vector<SearchElement> elements;
  elements.reserve(mesh_.triangles.size());
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
    elements.push_back({triangle(i)});
  tree_ = SearchTree(elements, Elements::Triangles, instructions, watch);
}

bool MeshSolid::isInside(const Vector3& point) const {
  return closed_ &&
         isWithin(tree_, point, Rays::One, [](std::uint32_t, const Triangle& t, const auto& cross) { cross(t); });
}

std::optional<BallContact> MeshSolid::firstContact(const Vector3& from, const Vector3& to, double radius) const {
  const Mover mover{wayBetween(from, to), radius};
  Meeting best;
  tree_.search(mover, best, [&](std::uint32_t, const Triangle& t) { sweepTriangle(mover.way, radius, t, best); });
  if (!(best.when < 0) && !meetsFront(mover.way, best) && isInside(from)) return contactWithin(mover.way, radius);
  return ballContact(mover.way, best);
}

std::optional<Meeting> MeshSolid::meetingAlongAxis(const Way& way, const Vector3& axis, double radius) const {
  constexpr double kAside = 1e-7;
  const double along = axis.dot(way.direction);
  if (way.length == 0 || (axis - along * way.direction).norm() > kAside) return std::nullopt;
  const double size = std::abs(along);
  const Vector3 tail = along < 0 ? Vector3(way.start + axis) : way.start;
  const Mover ball{{tail, way.direction, size + way.length}, radius};
  Meeting best;
  tree_.search(ball, best, [&](std::uint32_t, const Triangle& t) { sweepTriangle(ball.way, radius, t, best); });
  if (!best.found()) return best;
  best.when -= size;
  if (best.when < 0) return std::nullopt;
  return best;
}

std::optional<BallContact> MeshSolid::firstCapsuleContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                          double radius) const {
  const Way way = wayBetween(from, to);
  if (const auto meeting = meetingAlongAxis(way, axis, radius)) {
    if (isInside(from)) return contactWithin(way, radius);
    return capsuleContact(way, axis, *meeting);
  }
  Meeting best;
  const std::size_t parts = capsuleParts(axis, radius);
  const Vector3 part = axis / static_cast<double>(parts);
  for (std::size_t i = 0; i < parts; ++i) {
    const Mover mover{{way.start + static_cast<double>(i) * part, way.direction, way.length}, radius, part};
    tree_.search(mover, best,
                 [&](std::uint32_t, const Triangle& t) { sweepCapsule(mover.way, radius, part, t, best); });
  }
  if (!(best.when < 0) && isInside(from)) return contactWithin(way, radius);
  return capsuleContact(way, axis, best);
}

std::optional<BallContact> MeshSolid::firstCylinderContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                           double radius) const {
  const Mover mover{wayBetween(from, to), 0, axis, radius};
  Meeting best;
  tree_.search(mover, best, [&](std::uint32_t, const Triangle& t) { sweepCylinder(mover.way, radius, axis, t, best); });
  if (!(best.when < 0) && isInside(from)) return contactWithin(mover.way, radius);
  return cylinderContact(mover.way, axis, radius, best);
}

DrawingMesh MeshSolid::drawing() const {
  DrawingMesh drawing;
  std::vector<Vector3> normals;
  normals.reserve(mesh_.triangles.size());
  for (const auto& t : mesh_.triangles) {
    const Vector3 normal =
        (mesh_.corners[t[1]] - mesh_.corners[t[0]]).cross(mesh_.corners[t[2]] - mesh_.corners[t[0]]).normalized();
    normals.push_back(normal);
    for (const std::uint32_t corner : t) {
      drawing.indices.push_back(static_cast<std::uint32_t>(drawing.indices.size()));
      for (Eigen::Index k = 0; k < 3; ++k) {
        drawing.positions.push_back(static_cast<float>(mesh_.corners[corner][k]));
        drawing.normals.push_back(static_cast<float>(normal[k]));
      }
    }
  }
  // An edge shows where its triangles meet at more than 30 degrees or where there is no neighbour.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> uses;
  for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
    const auto& t = mesh_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = t[k];
      const std::uint64_t b = t[(k + 1) % 3];
      uses.emplace_back(std::min(a, b) << 32 | std::max(a, b), i);
    }
  }
  std::sort(uses.begin(), uses.end());
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t j = i + 1;
    while (j < uses.size() && uses[j].first == uses[i].first)
      ++j;
    if (j != i + 2 || normals[uses[i].second].dot(normals[uses[i + 1].second]) < 0.866) {
      std::vector<float> line;
      for (const std::uint64_t corner : {uses[i].first >> 32, uses[i].first & 0xFFFFFFFFU}) {
        for (Eigen::Index k = 0; k < 3; ++k)
          line.push_back(static_cast<float>(mesh_.corners[corner][k]));
      }
      drawing.featureEdges.push_back(std::move(line));
    }
    i = j;
  }
  return drawing;
}

Result<std::unique_ptr<Solid>> readStl(const std::filesystem::path& path, const ImportOptions& import) {
  ImportWatch watch(path.string(), import);
  try {
    Result<TriangleMesh> mesh = readStlMesh(path, watch);
    if (!mesh) return tl::unexpected(mesh.error());
    return std::make_unique<MeshSolid>(std::move(*mesh), watch);
  } catch (const ImportStopped&) {
    return tl::unexpected(watch.interrupted());
  }
}

}  // namespace probewright::simulation
