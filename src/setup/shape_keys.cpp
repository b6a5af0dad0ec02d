#include "setup/shape_keys.hpp"

#include <fmt/format.h>

#include <map>
#include <string>

namespace probewright::setup {

using simulation::FeatureMode;
using simulation::FeaturePattern;
using simulation::FeatureShape;
using simulation::SolidFeature;
using simulation::SolidRecipe;

namespace {

/// Each copy is joined with the part or cut from it, and a part of thousands takes minutes.
constexpr long long mostCopies = 1000;

/// What people call a shape otherwise.
const std::map<std::string, std::string>& otherShapeNames() {
  static const std::map<std::string, std::string> names = {
      {"bore", "hole"},    {"drill", "hole"},    {"drilling", "hole"}, {"boss", "cylinder"}, {"stud", "cylinder"},
      {"pin", "cylinder"}, {"rod", "cylinder"},  {"block", "box"},     {"cuboid", "box"},    {"cube", "box"},
      {"plate", "box"},    {"groove", "slot"},   {"keyway", "slot"},   {"ball", "sphere"},   {"ring", "torus"},
      {"round", "fillet"}, {"bevel", "chamfer"}, {"recess", "pocket"}, {"frustum", "cone"},
  };
  return names;
}

FeaturePattern readPattern(TomlReader& reader) {
  FeaturePattern pattern;
  reader.require("kind");
  const bool circular = reader.choice("kind", {"linear", "circular"}).value_or(0) == 1;
  pattern.kind = circular ? FeaturePattern::Kind::Circular : FeaturePattern::Kind::Linear;
  reader.require("count");
  pattern.count = static_cast<int>(reader.integer("count", 1, mostCopies).value_or(1));
  if (circular) {
    pattern.centre = readVector(reader, "centre").value_or(Vector3::Zero());
    pattern.angle = reader.number("angle", anyAngle).value_or(0);
  } else {
    reader.require("spacing");
    pattern.spacing = readVector(reader, "spacing").value_or(Vector3::UnitX());
    if (pattern.count > 1 && pattern.spacing.isZero())
      reader.report("spacing", "the copies would all lie in one place");
  }
  reader.finish();
  return pattern;
}

/// The first `count` lengths of a body.
Vector3 readSize(TomlReader& reader, std::size_t count) {
  Vector3 size = Vector3::Zero();
  reader.require("size");
  if (const auto values = reader.numbers("size", count, anyLength)) {
    for (std::size_t i = 0; i < count; ++i)
      size[static_cast<Eigen::Index>(i)] = (*values)[i];
  }
  return size;
}

/// Radii of corners take at most half of the length and of the width.
double readCornerRadius(TomlReader& reader, const Vector3& size) {
  const double radius = reader.number("corner_radius", anyLengthOrNone).value_or(0);
  if (2 * radius > size.head<2>().minCoeff() && size.head<2>().minCoeff() > 0) {
    reader.report("corner_radius", "\"corner_radius\" must be at most half of the length and of the width in \"size\"");
  }
  return radius;
}

SolidFeature readFeature(TomlReader& reader) {
  static const std::vector<std::string> shapes = {"box",  "cylinder", "cone", "sphere",  "torus",
                                                  "hole", "pocket",   "slot", "chamfer", "fillet"};
  SolidFeature feature;
  feature.place = reader.placeOf("shape");
  reader.require("shape");
  const auto shape = reader.choice("shape", shapes, otherShapeNames());
  if (!shape) return feature;
  feature.shape = simulation::featureShapeNamed(shapes[*shape]).value_or(FeatureShape::Box);
  const auto required = [&](const char* key) { return reader.requiredNumber(key, anyLength).value_or(0); };
  const auto optional = [&](const char* key) { return reader.number(key, anyLengthOrNone).value_or(0); };
  bool isBody = true;
  switch (feature.shape) {
    case FeatureShape::Box:
      feature.size = readSize(reader, 3);
      feature.cornerRadius = readCornerRadius(reader, feature.size);
      break;
    case FeatureShape::Cylinder:
      feature.diameter = required("diameter");
      feature.height = required("height");
      break;
    case FeatureShape::Cone:
      feature.diameter = required("diameter");
      feature.topDiameter = optional("top_diameter");
      if (feature.topDiameter > 0 && feature.topDiameter == feature.diameter) {
        reader.report("top_diameter", "\"top_diameter\" is equal to \"diameter\"", "Write shape = \"cylinder\"");
      }
      feature.height = required("height");
      break;
    case FeatureShape::Sphere:
      feature.diameter = required("diameter");
      break;
    case FeatureShape::Torus:
      feature.diameter = required("diameter");
      feature.tubeDiameter = required("tube_diameter");
      if (feature.tubeDiameter >= feature.diameter && feature.diameter > 0)
        reader.report("tube_diameter", "\"tube_diameter\" must be smaller than \"diameter\"");
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
      if (feature.shape == FeatureShape::Pocket) feature.cornerRadius = readCornerRadius(reader, feature.size);
      if (feature.shape == FeatureShape::Slot && feature.size.y() > feature.size.x())
        reader.report("size", "a slot is at most as wide as it is long: \"size\" is [length, width]");
      isBody = false;
      break;
    case FeatureShape::Chamfer:
    case FeatureShape::Fillet:
      feature.edgeSize = required(feature.shape == FeatureShape::Chamfer ? "width" : "radius");
      reader.require("edges");
      for (const auto& point : reader.points("edges").value_or(std::vector<std::array<double, 3>>{})) {
        feature.edges.emplace_back(point[0], point[1], point[2]);
      }
      if (reader.has("edges") && feature.edges.empty())
        reader.report("edges", "\"edges\" needs a point on each edge that is to be treated");
      reader.finish();
      return feature;
  }
  if (isBody && reader.choice("mode", {"add", "cut"}).value_or(0) == 1) feature.mode = FeatureMode::Cut;
  feature.centre = readVector(reader, "centre").value_or(Vector3::Zero());
  feature.rotation = readVector(reader, "rotation", anyAngle).value_or(Vector3::Zero());
  long long copies = 1;
  for (TomlReader& pattern : reader.tables("pattern")) {
    feature.patterns.push_back(readPattern(pattern));
    copies *= feature.patterns.back().count;
    if (copies <= mostCopies) continue;
    pattern.report("count", fmt::format("the patterns of this feature make more than {} copies", mostCopies),
                   "Each pattern repeats what the ones before it have made");
    break;
  }
  reader.finish();
  return feature;
}

}  // namespace

std::optional<Vector2> readVector2(TomlReader& reader, std::string_view key, NumberRange range) {
  const auto values = reader.numbers(key, 2, range);
  return values ? std::optional(Vector2((*values)[0], (*values)[1])) : std::nullopt;
}

std::optional<Vector3> readVector(TomlReader& reader, std::string_view key, NumberRange range) {
  const auto values = reader.numbers(key, 3, range);
  return values ? std::optional(Vector3((*values)[0], (*values)[1], (*values)[2])) : std::nullopt;
}

Pose readPose(TomlReader& owner) {
  auto reader = owner.table("pose");
  if (!reader) return Pose::Identity();
  const auto get = [&](const char* key, NumberRange range) { return reader->number(key, range).value_or(0); };
  const Vector3 origin(get("x", anyPlace), get("y", anyPlace), get("z", anyPlace));
  const double a = get("a", anyAngle), b = get("b", anyAngle), c = get("c", anyAngle);
  reader->finish();
  return poseOf(origin, a, b, c);
}

Pose poseOf(const Vector3& origin, double a, double b, double c) {
  return translation(origin) * rotation(Vector3::UnitZ(), c) * rotation(Vector3::UnitY(), b) *
         rotation(Vector3::UnitX(), a);
}

SolidRecipe readRecipe(TomlReader& owner) {
  SolidRecipe recipe;
  for (TomlReader& feature : owner.tables("feature"))
    recipe.features.push_back(readFeature(feature));
  if (owner.has("feature") && recipe.features.empty())
    owner.report("feature", "there is no feature in it", "Begin with a body, for instance a box");
  return recipe;
}

}  // namespace probewright::setup
