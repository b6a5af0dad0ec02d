#include "survival/touched_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/face_at.hpp"
#include "simulation/other_faces.hpp"

namespace probewright::survival {

using simulation::AnalyticSurface;
using simulation::PathTouch;
using simulation::Truth;

namespace {

bool isMeant(const PathTouch& touch) { return touch.kind == simulation::PathKind::Measure && touch.part == "ball"; }

std::optional<std::size_t> solidOf(const PathTouch& touch, const Truth& truth) {
  const auto found = std::ranges::find(truth.solids, touch.solid, &simulation::PlacedSolid::name);
  if (found == truth.solids.end()) return std::nullopt;
  return static_cast<std::size_t>(found - truth.solids.begin());
}

/// True if the closed form passes through the point, with that normal.
bool passes(const AnalyticSurface& face, const Vector3& point, const Vector3& normal) {
  const simulation::SurfaceHeight height = face.height(point);
  return std::abs(height.signedDistance) < 1e-4 && std::abs(height.normal.dot(normal)) > 1 - 1e-6;
}

}  // namespace

std::vector<TouchedFace> touchedFaces(const simulation::PathRecord& path, const Truth& truth) {
  std::vector<TouchedFace> faces;
  for (const PathTouch& touch : path.touches) {
    if (!isMeant(touch)) continue;
    const auto solid = solidOf(touch, truth);
    TouchedFace touched;
    if (solid) {
      touched.solid = *solid;
      const Pose solidFromTable = truth.solids[*solid].tableFromSolid.inverse();
      touched.face = simulation::faceAt(*truth.solids[*solid].solid, solidFromTable * touch.point,
                                        solidFromTable.linear() * touch.normal);
    }
    faces.push_back(touched);
  }
  return faces;
}

std::optional<std::string> otherThanMeant(const std::vector<TouchedFace>& meant, const simulation::PathRecord& path,
                                          const Truth& truth, const std::vector<bool>& sizeVaries) {
  std::size_t count = 0;
  for (const PathTouch& touch : path.touches) {
    if (!isMeant(touch)) continue;
    if (count == meant.size()) return "more is touched than in the setup as it is written";
    const TouchedFace& face = meant[count++];
    const simulation::PlacedSolid& solid = truth.solids[face.solid];
    if (touch.solid != solid.name)
      return fmt::format("touch {} is of \"{}\" instead of \"{}\"", count, touch.solid, solid.name);
    if (!face.face || sizeVaries[face.solid]) continue;
    const Pose solidFromTable = solid.tableFromSolid.inverse();
    if (!passes(*face.face, solidFromTable * touch.point, solidFromTable.linear() * touch.normal))
      return fmt::format("touch {} is of another face of \"{}\" than in the setup as it is written", count, solid.name);
  }
  if (count < meant.size()) return "less is touched than in the setup as it is written";
  return std::nullopt;
}

std::shared_ptr<const simulation::Solid> OtherFaces::of(const simulation::Solid& solid, const AnalyticSurface& face) {
  const std::lock_guard lock(mutex_);
  for (const Entry& entry : entries_)
    if (entry.solid == &solid && simulation::sameSurface(entry.face, face)) return entry.others;
  entries_.push_back({&solid, face, simulation::otherFaces(solid, face)});
  return entries_.back().others;
}

}  // namespace probewright::survival
