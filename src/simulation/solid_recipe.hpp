#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"
#include "simulation/cad_solid.hpp"

/// Parts described in a few lines instead of a CAD file.
namespace probewright::simulation {

enum class FeatureShape { Box, Cylinder, Cone, Sphere, Torus, Hole, Pocket, Slot, Chamfer, Fillet };

/// Whether a box, cylinder, cone, sphere or torus is added to the part or cut out of it. Holes, pockets and slots are
/// always cut.
enum class FeatureMode { Add, Cut };

/// Copies of a feature; the feature itself is the first of `count`.
struct FeaturePattern {
  enum class Kind { Linear, Circular };
  Kind kind = Kind::Linear;
  int count = 1;                      ///< 1 .. 10000
  Vector3 spacing = Vector3::Zero();  ///< linear: from one copy to the next, mm
  Vector3 centre = Vector3::Zero();   ///< circular: a point of the axis, which is parallel to the part's Z
  double angle = 0;                   ///< circular: degrees from one copy to the next; 0 spreads them over the turn
};

/// One step in making a part. Every feature has a frame of its own: at `centre`, turned by `rotation`. Bodies stand on
/// their centre: box, cylinder and cone reach from there to +Z by their height, spheres and tori lie around it. Cuts
/// open at their centre: holes, pockets and slots reach from there to -Z by their depth.
struct SolidFeature {
  FeatureShape shape = FeatureShape::Box;
  FeatureMode mode = FeatureMode::Add;
  Vector3 centre = Vector3::Zero();    ///< mm, in the part's frame
  Vector3 rotation = Vector3::Zero();  ///< degrees about the part's X, then Y, then Z
  Vector3 size = Vector3::Zero();      ///< box: length in X, width in Y, height in Z; pocket and slot: length and width
  double diameter = 0;                 ///< cylinder, sphere, hole; cone: at its base; torus: of the tube's middle line
  double topDiameter = 0;              ///< cone, 0 for a tip
  double tubeDiameter = 0;             ///< torus
  double height = 0;                   ///< cylinder, cone
  double depth = 0;                    ///< hole, pocket, slot; 0 cuts through
  double cornerRadius = 0;             ///< box and pocket: of the corners seen along Z
  double edgeSize = 0;                 ///< chamfer: width on both faces at 45 degrees; fillet: radius
  std::vector<Vector3> edges;          ///< chamfer and fillet: a point on each edge to be treated, to within 0.1 mm
  std::vector<FeaturePattern> patterns;  ///< each repeats what the ones before have made
  SourcePlace place;                     ///< where the user wrote the feature
};

/// The features in the order in which they are made; the first must add a body.
struct SolidRecipe {
  std::vector<SolidFeature> features;
};

/// The shape for a word of a setup file: box, cylinder, cone, sphere, torus, hole, pocket, slot, chamfer, fillet.
std::optional<FeatureShape> featureShapeNamed(std::string_view word);
std::string_view nameOf(FeatureShape shape);

/// Builds the part. Refused: sizes that are not positive, corners that do not fit, edges that are not there, features
/// that leave nothing or break the part; the diagnostic names the feature by its place, number and shape.
Result<std::unique_ptr<Solid>> buildSolid(const SolidRecipe& recipe, const CadOptions& options = {},
                                          const std::stop_token& stop = {});
Result<TopoDS_Shape> buildShape(const SolidRecipe& recipe, const std::stop_token& stop = {});

/// A ring whose bore has its axis on Z, from the top face at Z0 down to -height.
SolidRecipe ringGauge(double boreDiameter, double outerDiameter, double height);

/// A sphere around the origin on a stem that reaches down to -stemLength below the centre.
SolidRecipe referenceSphere(double diameter, double stemDiameter, double stemLength);

/// The contact of a tool touch probe on its stem: the middle of its top face in the origin. A disc where `length` is 0.
struct ToolProbeContact {
  double diameter = 40;          ///< of a disc
  double length = 0, width = 0;  ///< of a cuboid
  double thickness = 10;
  double stemDiameter = 8, stemLength = 30;  ///< below the contact
};
SolidRecipe toolProbeContact(const ToolProbeContact& contact);

/// A block with the middle of its top face in the origin.
SolidRecipe gaugeBlock(double length, double width, double height);

}  // namespace probewright::simulation
