#include <fmt/format.h>

#include <TopoDS_Shape.hxx>

#include "simulation/solid_recipe.hpp"

/// Writes the housing of the examples as STEP: `make_housing housing.step`. README.md has the table of its features.
namespace {

using namespace probewright;
using namespace probewright::simulation;

SolidRecipe housing() {
  SolidFeature body;
  body.shape = FeatureShape::Box;
  body.centre = {60, 40, -40};
  body.size = {120, 80, 40};

  SolidFeature bore;
  bore.shape = FeatureShape::Hole;
  bore.centre = {60, 40, 0};
  bore.diameter = 40.012;

  SolidFeature boltCircle;
  boltCircle.shape = FeatureShape::Hole;
  boltCircle.centre = {90, 40, 0};
  boltCircle.diameter = 8;
  boltCircle.depth = 20;
  FeaturePattern six;
  six.kind = FeaturePattern::Kind::Circular;
  six.count = 6;
  six.centre = {60, 40, 0};
  boltCircle.patterns = {six};

  SolidFeature pocket;
  pocket.shape = FeatureShape::Pocket;
  pocket.centre = {20, 16, 0};
  pocket.size = {30, 20, 0};
  pocket.cornerRadius = 4;
  pocket.depth = 15;

  SolidFeature slot;
  slot.shape = FeatureShape::Slot;
  slot.centre = {20, 64, 0};
  slot.size = {30, 10, 0};
  slot.depth = 12;

  SolidFeature spigot;
  spigot.shape = FeatureShape::Cylinder;
  spigot.centre = {104, 62, 0};
  spigot.diameter = 19.994;
  spigot.height = 12;

  SolidFeature rib;
  rib.shape = FeatureShape::Box;
  rib.centre = {104, 18, 0};
  rib.size = {24, 8, 10};

  SolidFeature cornerFillet;
  cornerFillet.shape = FeatureShape::Fillet;
  cornerFillet.edgeSize = 6;
  cornerFillet.edges = {{120, 80, -20}};

  SolidFeature spigotFillet;
  spigotFillet.shape = FeatureShape::Fillet;
  spigotFillet.edgeSize = 1.5;
  spigotFillet.edges = {{104 + 19.994 / 2, 62, 0}};

  SolidFeature boreChamfer;
  boreChamfer.shape = FeatureShape::Chamfer;
  boreChamfer.edgeSize = 1;
  boreChamfer.edges = {{60 + 40.012 / 2, 40, 0}, {60 + 40.012 / 2, 40, -40}};

  SolidFeature spigotChamfer;
  spigotChamfer.shape = FeatureShape::Chamfer;
  spigotChamfer.edgeSize = 1;
  spigotChamfer.edges = {{104 + 19.994 / 2, 62, 12}};

  SolidFeature bodyChamfer;
  bodyChamfer.shape = FeatureShape::Chamfer;
  bodyChamfer.edgeSize = 2;
  bodyChamfer.edges = {{60, 80, 0}};

  return {{body, bore, boltCircle, pocket, slot, spigot, rib, cornerFillet, spigotFillet, boreChamfer, spigotChamfer,
           bodyChamfer}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_housing FILE.step\n");
    return 2;
  }
  const auto shape = buildShape(housing());
  if (!shape) {
    fmt::print(stderr, "{}\n", format(shape.error()));
    return 4;
  }
  const auto written = writeStep(*shape, argv[1]);
  if (!written) {
    fmt::print(stderr, "{}\n", format(written.error()));
    return 4;
  }
  return 0;
}
