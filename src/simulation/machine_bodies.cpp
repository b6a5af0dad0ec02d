#include "simulation/machine_bodies.hpp"

#include <algorithm>

#include "simulation/analytic_solids.hpp"

namespace probewright::simulation {

namespace {

/// A box or a cylinder that is added as it is.
bool isPlain(const SolidFeature& feature) {
  const bool shape =
      feature.shape == FeatureShape::Cylinder || (feature.shape == FeatureShape::Box && feature.cornerRadius == 0);
  return shape && feature.mode == FeatureMode::Add && feature.patterns.empty();
}

std::shared_ptr<const Solid> plainSolid(const SolidFeature& feature) {
  if (feature.shape == FeatureShape::Cylinder)
    return std::make_shared<RoundBar>(feature.diameter / 2, 0, feature.height);
  const Vector3 half(feature.size.x() / 2, feature.size.y() / 2, 0);
  return std::make_shared<Box>(-half, half + Vector3(0, 0, feature.size.z()));
}

Pose poseOf(const SolidFeature& feature) {
  return translation(feature.centre) * rotation(Vector3::UnitZ(), feature.rotation.z()) *
         rotation(Vector3::UnitY(), feature.rotation.y()) * rotation(Vector3::UnitX(), feature.rotation.x());
}

}  // namespace

Result<std::vector<MachineBody>> loadBodies(const std::vector<WorldBody>& bodies, const ImportOptions& import) {
  std::vector<MachineBody> loaded;
  for (const WorldBody& body : bodies) {
    const auto& features = body.source.recipe.features;
    if (body.source.file.empty() && !features.empty() && std::ranges::all_of(features, isPlain)) {
      for (const SolidFeature& feature : features)
        loaded.push_back({body.name, body.link, plainSolid(feature), body.linkFromSolid * poseOf(feature)});
      continue;
    }
    auto solid = loadSolid(body.source, import);
    if (!solid) return tl::unexpected(std::move(solid.error()));
    loaded.push_back({body.name, body.link, std::move(*solid), body.linkFromSolid});
  }
  return loaded;
}

}  // namespace probewright::simulation
