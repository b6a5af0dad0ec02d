#include "simulation/setup_solids.hpp"

namespace probewright::simulation {

namespace {

constexpr NumberRange positive = NumberRange::positive();
constexpr NumberRange notNegative = NumberRange::notNegative();

FeaturePattern readPattern(TomlReader& reader) {
  FeaturePattern pattern;
  reader.require("kind");
  const bool circular = reader.choice("kind", {"linear", "circular"}).value_or(0) == 1;
  pattern.kind = circular ? FeaturePattern::Kind::Circular : FeaturePattern::Kind::Linear;
  reader.require("count");
  pattern.count = static_cast<int>(reader.integer("count", 1, 10000).value_or(1));
  if (circular) {
    pattern.centre = readVector(reader, "centre").value_or(Vector3::Zero());
    pattern.angle = reader.number("angle", {-360, 360}).value_or(0);
  } else {
    reader.require("spacing");
    pattern.spacing = readVector(reader, "spacing").value_or(Vector3::UnitX());
  }
  reader.finish();
  return pattern;
}

/// The first `count` lengths of a body, all above 0.
Vector3 readSize(TomlReader& reader, std::size_t count) {
  Vector3 size = Vector3::Zero();
  reader.require("size");
  if (const auto values = reader.numbers("size", count)) {
    for (std::size_t i = 0; i < count; ++i)
      size[static_cast<Eigen::Index>(i)] = (*values)[i];
    if (size.head(static_cast<Eigen::Index>(count)).minCoeff() <= 0) reader.report("size", "lengths must be above 0");
  }
  return size;
}

SolidFeature readFeature(TomlReader& reader) {
  static const std::vector<std::string> shapes = {"box",  "cylinder", "cone", "sphere",  "torus",
                                                  "hole", "pocket",   "slot", "chamfer", "fillet"};
  SolidFeature feature;
  feature.place = reader.placeOf("shape");
  reader.require("shape");
  const auto shape = reader.choice("shape", shapes);
  if (!shape) return feature;
  feature.shape = featureShapeNamed(shapes[*shape]).value_or(FeatureShape::Box);
  const auto required = [&](const char* key) { return reader.requiredNumber(key, positive).value_or(0); };
  const auto optional = [&](const char* key) { return reader.number(key, notNegative).value_or(0); };
  bool isBody = true;
  switch (feature.shape) {
    case FeatureShape::Box:
      feature.size = readSize(reader, 3);
      feature.cornerRadius = optional("corner_radius");
      break;
    case FeatureShape::Cylinder:
      feature.diameter = required("diameter");
      feature.height = required("height");
      break;
    case FeatureShape::Cone:
      feature.diameter = required("diameter");
      feature.topDiameter = optional("top_diameter");
      feature.height = required("height");
      break;
    case FeatureShape::Sphere:
      feature.diameter = required("diameter");
      break;
    case FeatureShape::Torus:
      feature.diameter = required("diameter");
      feature.tubeDiameter = required("tube_diameter");
      break;
    case FeatureShape::Hole:
      feature.diameter = required("diameter");
      feature.depth = optional("depth");
      isBody = false;
      break;
    case FeatureShape::Pocket:
    case FeatureShape::Slot:
      feature.size = readSize(reader, 2);
      feature.depth = optional("depth");
      if (feature.shape == FeatureShape::Pocket) feature.cornerRadius = optional("corner_radius");
      isBody = false;
      break;
    case FeatureShape::Chamfer:
    case FeatureShape::Fillet:
      feature.edgeSize = required(feature.shape == FeatureShape::Chamfer ? "width" : "radius");
      reader.require("edges");
      for (const auto& point : reader.points("edges").value_or(std::vector<std::array<double, 3>>{})) {
        feature.edges.emplace_back(point[0], point[1], point[2]);
      }
      reader.finish();
      return feature;
  }
  if (isBody && reader.choice("mode", {"add", "cut"}).value_or(0) == 1) feature.mode = FeatureMode::Cut;
  feature.centre = readVector(reader, "centre").value_or(Vector3::Zero());
  feature.rotation = readVector(reader, "rotation").value_or(Vector3::Zero());
  for (TomlReader& pattern : reader.tables("pattern"))
    feature.patterns.push_back(readPattern(pattern));
  reader.finish();
  return feature;
}

}  // namespace

std::optional<Vector2> readVector2(TomlReader& reader, std::string_view key) {
  const auto values = reader.numbers(key, 2);
  return values ? std::optional(Vector2((*values)[0], (*values)[1])) : std::nullopt;
}

std::optional<Vector3> readVector(TomlReader& reader, std::string_view key) {
  const auto values = reader.numbers(key, 3);
  return values ? std::optional(Vector3((*values)[0], (*values)[1], (*values)[2])) : std::nullopt;
}

Pose readPose(TomlReader& owner) {
  auto reader = owner.table("pose");
  if (!reader) return Pose::Identity();
  const auto get = [&](const char* key) { return reader->number(key).value_or(0); };
  const Vector3 origin(get("x"), get("y"), get("z"));
  const double a = get("a"), b = get("b"), c = get("c");
  reader->finish();
  return translation(origin) * rotation(Vector3::UnitZ(), c) * rotation(Vector3::UnitY(), b) *
         rotation(Vector3::UnitX(), a);
}

SolidRecipe readRecipe(TomlReader& owner) {
  SolidRecipe recipe;
  for (TomlReader& feature : owner.tables("feature"))
    recipe.features.push_back(readFeature(feature));
  return recipe;
}

}  // namespace probewright::simulation
