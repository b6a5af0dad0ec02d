#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <TopoDS_Shape.hxx>

#include "simulation/mesh_solid.hpp"
#include "simulation/solid_recipe.hpp"
#include "worlds.hpp"

namespace probewright::simulation {
namespace {

using ::testing::HasSubstr;
using testing::ScratchFolder;

constexpr double kPi = std::numbers::pi;

double volume(const SolidRecipe& recipe) {
  const auto shape = buildShape(recipe);
  EXPECT_TRUE(shape) << format(shape.error());
  if (!shape) return 0;
  GProp_GProps properties;
  BRepGProp::VolumeProperties(*shape, properties);
  return properties.Mass();
}

SolidFeature feature(FeatureShape shape) {
  SolidFeature f;
  f.shape = shape;
  return f;
}

SolidFeature block(double x, double y, double z) {
  SolidFeature f = feature(FeatureShape::Box);
  f.centre = {0, 0, -z};
  f.size = {x, y, z};
  return f;
}

TEST(Recipe, BodiesHaveTheirVolumes) {
  SolidFeature box = block(10, 20, 30);
  EXPECT_NEAR(volume({{box}}), 6000, 1e-6);
  box.cornerRadius = 3;
  EXPECT_NEAR(volume({{box}}), 6000 - 30 * (4 - kPi) * 9, 1e-6);
  SolidFeature cylinder = feature(FeatureShape::Cylinder);
  cylinder.diameter = 20;
  cylinder.height = 7;
  EXPECT_NEAR(volume({{cylinder}}), 700 * kPi, 1e-6);
  SolidFeature cone = feature(FeatureShape::Cone);
  cone.diameter = 20;
  cone.height = 6;
  EXPECT_NEAR(volume({{cone}}), 200 * kPi, 1e-6);
  SolidFeature sphere = feature(FeatureShape::Sphere);
  sphere.diameter = 6;
  EXPECT_NEAR(volume({{sphere}}), 36 * kPi, 1e-6);
  SolidFeature torus = feature(FeatureShape::Torus);
  torus.diameter = 20;
  torus.tubeDiameter = 4;
  EXPECT_NEAR(volume({{torus}}), 2 * kPi * 10 * kPi * 4, 1e-6);
}

TEST(Recipe, CutsTakeTheirVolumesAway) {
  const SolidFeature plate = block(100, 80, 10);
  const double whole = 80000;
  SolidFeature hole = feature(FeatureShape::Hole);
  hole.diameter = 8;
  EXPECT_NEAR(volume({{plate, hole}}), whole - 160 * kPi, 1e-5);
  hole.depth = 4;
  EXPECT_NEAR(volume({{plate, hole}}), whole - 64 * kPi, 1e-5);
  FeaturePattern ring;
  ring.kind = FeaturePattern::Kind::Circular;
  ring.count = 5;
  hole.centre = {25, 0, 0};
  hole.patterns = {ring};
  EXPECT_NEAR(volume({{plate, hole}}), whole - 5 * 64 * kPi, 1e-5);
  FeaturePattern row;
  row.count = 3;
  row.spacing = {12, 0, 0};
  FeaturePattern column;
  column.count = 2;
  column.spacing = {0, 15, 0};
  hole.centre = {-20, -10, 0};
  hole.patterns = {row, column};
  EXPECT_NEAR(volume({{plate, hole}}), whole - 6 * 64 * kPi, 1e-5);
  SolidFeature pocket = feature(FeatureShape::Pocket);
  pocket.size = {30, 20, 0};
  pocket.cornerRadius = 5;
  pocket.depth = 6;
  pocket.rotation = {0, 0, 30};
  EXPECT_NEAR(volume({{plate, pocket}}), whole - 6 * (600 - (4 - kPi) * 25), 1e-5);
  SolidFeature slot = feature(FeatureShape::Slot);
  slot.size = {30, 10, 0};
  slot.depth = 6;
  EXPECT_NEAR(volume({{plate, slot}}), whole - 6 * (200 + 25 * kPi), 1e-5);
  SolidFeature cut = block(10, 200, 20);
  cut.centre.z() = -5;
  cut.mode = FeatureMode::Cut;
  EXPECT_NEAR(volume({{plate, cut}}), whole - 10 * 80 * 5, 1e-5);
  SolidFeature chamfer = feature(FeatureShape::Chamfer);
  chamfer.edgeSize = 2;
  chamfer.edges = {{0, 40, 0}};
  EXPECT_NEAR(volume({{plate, chamfer}}), whole - 2 * 100, 1e-5);
  SolidFeature fillet = feature(FeatureShape::Fillet);
  fillet.edgeSize = 2;
  fillet.edges = {{0, 40, 0}};
  EXPECT_NEAR(volume({{plate, fillet}}), whole - (4 - kPi) * 100, 1e-5);
}

TEST(Recipe, RotationTurnsAboutXThenYThenZ) {
  // A pin along Z, turned 90 degrees about X points to -Y; then 90 degrees about Z to +X.
  SolidFeature pin = feature(FeatureShape::Cylinder);
  pin.diameter = 4;
  pin.height = 30;
  pin.centre = {1, 2, 3};
  pin.rotation = {90, 0, 90};
  const auto solid = buildSolid({{pin}});
  ASSERT_TRUE(solid) << format(solid.error());
  const auto contact = (*solid)->firstContact({60, 2, 3}, {0, 2, 3}, 1);
  ASSERT_TRUE(contact);
  EXPECT_LT((contact->touchPoint - Vector3(31, 2, 3)).norm(), 1e-9);
}

TEST(Recipe, BuiltInGaugesMeasureAsNamed) {
  const auto ring = buildSolid(ringGauge(50, 80, 20));
  const auto sphere = buildSolid(referenceSphere(25, 8, 60));
  const auto blockGauge = buildSolid(gaugeBlock(50, 20, 10));
  ASSERT_TRUE(ring && sphere && blockGauge);
  EXPECT_NEAR((*ring)->firstContact({0, 0, -10}, {40, 0, -10}, 3)->ballCentre.x(), 22, 1e-9);
  EXPECT_FALSE((*ring)->firstContact({0, 0, 30}, {0, 0, -60}, 3));
  EXPECT_NEAR((*sphere)->firstContact({0, 0, 40}, {0, 0, 0}, 3)->ballCentre.z(), 15.5, 1e-9);
  EXPECT_NEAR((*sphere)->firstContact({40, 0, -30}, {0, 0, -30}, 3)->ballCentre.x(), 7, 1e-9);
  EXPECT_NEAR((*sphere)->bounds().minimum.z(), -60, 1e-9);
  EXPECT_NEAR((*blockGauge)->firstContact({60, 0, -5}, {0, 0, -5}, 3)->ballCentre.x(), 28, 1e-9);
}

TEST(Recipe, SaysWhichFeatureIsWrongAndWhy) {
  const auto message = [](const SolidRecipe& recipe) {
    const auto shape = buildShape(recipe);
    return shape ? std::string("built") : format(shape.error());
  };
  EXPECT_THAT(message({}), HasSubstr("no features"));
  EXPECT_THAT(message({{feature(FeatureShape::Hole)}}), HasSubstr("feature 1 (hole): its diameter"));
  SolidFeature hole = feature(FeatureShape::Hole);
  hole.diameter = 5;
  EXPECT_THAT(message({{hole}}), HasSubstr("the first feature must add a body"));
  SolidFeature pocket = feature(FeatureShape::Pocket);
  pocket.size = {10, 20, 0};
  pocket.cornerRadius = 6;
  pocket.place = {"setup.toml", 12, 1};
  EXPECT_THAT(message({{block(50, 50, 10), pocket}}),
              HasSubstr("setup.toml:12:1: error: feature 2 (pocket): its corner_radius"));
  SolidFeature everything = block(80, 80, 30);
  everything.centre.z() = -20;
  everything.mode = FeatureMode::Cut;
  EXPECT_THAT(message({{block(50, 50, 10), everything}}), HasSubstr("leaves nothing"));
  SolidFeature fillet = feature(FeatureShape::Fillet);
  fillet.edgeSize = 2;
  fillet.edges = {{7, 7, 7}};
  EXPECT_THAT(message({{block(50, 50, 10), fillet}}), HasSubstr("no edge passes through 7 7 7"));
  fillet.edges = {{25, 0, 0}};
  fillet.edgeSize = 200;
  EXPECT_THAT(message({{block(50, 50, 10), fillet}}), HasSubstr("feature 2 (fillet)"));
  SolidFeature broken = block(50, 50, 10);
  broken.size.x() = std::nan("");
  EXPECT_THAT(message({{broken}}), HasSubstr("feature 1 (box): its size"));
}

TEST(Recipe, NamesOfShapesReadBack) {
  for (const char* name :
       {"box", "cylinder", "cone", "sphere", "torus", "hole", "pocket", "slot", "chamfer", "fillet"}) {
    ASSERT_TRUE(featureShapeNamed(name));
    EXPECT_EQ(nameOf(*featureShapeNamed(name)), name);
  }
  EXPECT_FALSE(featureShapeNamed("blob"));
}

Vector3 corner(const std::vector<float>& list, std::uint32_t i) {
  const std::size_t first = 3 * std::size_t{i};
  return {list[first], list[first + 1], list[first + 2]};
}

TEST(DrawingMesh, ShowsACadSolidWithOutwardNormalsAndItsEdges) {
  const auto solid = buildSolid(ringGauge(50, 80, 20));
  ASSERT_TRUE(solid);
  const DrawingMesh drawing = drawingMesh(**solid);
  EXPECT_EQ(drawing.positions.size(), drawing.normals.size());
  EXPECT_EQ(drawing.featureEdges.size(), 4U) << "the four rims, no seams";
  double volumeOfTriangles = 0;
  for (std::size_t i = 0; i < drawing.indices.size(); i += 3) {
    const Vector3 a = corner(drawing.positions, drawing.indices[i]);
    const Vector3 b = corner(drawing.positions, drawing.indices[i + 1]);
    const Vector3 c = corner(drawing.positions, drawing.indices[i + 2]);
    volumeOfTriangles += a.dot(b.cross(c)) / 6;
    EXPECT_GT(corner(drawing.normals, drawing.indices[i]).dot((b - a).cross(c - a)), 0);
    EXPECT_NEAR(corner(drawing.normals, drawing.indices[i]).norm(), 1, 1e-5);
  }
  EXPECT_NEAR(volumeOfTriangles, kPi * (1600 - 625) * 20, 0.01 * volumeOfTriangles);
  for (const auto& line : drawing.featureEdges) {
    for (std::size_t i = 0; i + 2 < line.size(); i += 3) {
      const double radius = std::hypot(line[i], line[i + 1]);
      EXPECT_LT(std::min(std::abs(radius - 25), std::abs(radius - 40)), 1e-4);
    }
  }
}

TEST(DrawingMesh, ShowsWhereFilletsBeginAndEnd) {
  SolidFeature block, fillet;
  block.size = {40, 30, 20};
  fillet.shape = FeatureShape::Fillet;
  fillet.edgeSize = 3;
  fillet.edges = {{20, 0, 20}};
  const auto solid = buildSolid({{block, fillet}});
  ASSERT_TRUE(solid) << format(solid.error());
  const DrawingMesh drawing = drawingMesh(**solid);
  EXPECT_EQ(drawing.featureEdges.size(), 15U) << "an edge became two lines and two arcs";
  const auto isAlong = [](const std::vector<float>& line, double x, double z) {
    for (std::size_t i = 0; i + 2 < line.size(); i += 3)
      if (std::abs(line[i] - x) > 1e-4 || std::abs(line[i + 2] - z) > 1e-4) return false;
    return true;
  };
  for (const auto& [x, z] : {std::pair(17.0, 20.0), {20.0, 17.0}})
    EXPECT_TRUE(std::ranges::any_of(drawing.featureEdges, [&](const auto& line) { return isAlong(line, x, z); }))
        << "at X" << x << " Z" << z;
}

TEST(DrawingMesh, StaysNearFacesThatAreBentBothWays) {
  SolidFeature feature;
  feature.diameter = 60;
  feature.tubeDiameter = 16;
  for (const bool torus : {true, false}) {
    feature.shape = torus ? FeatureShape::Torus : FeatureShape::Sphere;
    const auto solid = buildSolid({{feature}});
    ASSERT_TRUE(solid) << format(solid.error());
    const auto offSurface = [&](const Vector3& p) {
      return torus ? std::hypot(p.head<2>().norm() - 30, p.z()) - 8 : p.norm() - 30;
    };
    const DrawingMesh drawing = drawingMesh(**solid);
    ASSERT_GT(drawing.indices.size(), 300U);
    double farthest = 0;
    for (std::size_t i = 0; i < drawing.indices.size(); i += 3) {
      const Vector3 a = corner(drawing.positions, drawing.indices[i]);
      const Vector3 b = corner(drawing.positions, drawing.indices[i + 1]);
      const Vector3 c = corner(drawing.positions, drawing.indices[i + 2]);
      for (const Vector3& place : {Vector3((a + b) / 2), Vector3((b + c) / 2), Vector3((c + a) / 2)})
        farthest = std::max(farthest, std::abs(offSurface(place)));
    }
    // Half a hundredth for the float numbers of a drawing and the place of the deepest point of a side.
    EXPECT_LT(farthest, 0.055) << (torus ? "torus" : "sphere");
  }
}

TEST(DrawingMesh, ShowsAMeshWithItsSharpEdges) {
  const ScratchFolder folder;
  TriangleMesh cube;
  for (int i = 0; i < 8; ++i)
    cube.corners.emplace_back((i & 1) ? 1 : 0, (i & 2) ? 1 : 0, (i & 4) ? 1 : 0);
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const MeshSolid solid(cube);
  const DrawingMesh drawing = drawingMesh(solid);
  EXPECT_EQ(drawing.indices.size(), 36U);
  EXPECT_EQ(drawing.featureEdges.size(), 12U) << "no diagonals";
  EXPECT_FALSE(writeStep(solid, folder / "mesh.step"));
}

}  // namespace
}  // namespace probewright::simulation
