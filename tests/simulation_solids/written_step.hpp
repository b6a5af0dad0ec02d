#pragma once

#include <string>
#include <vector>

#include "geometry/primitives.hpp"

/// STEP files written entity by entity: forms that are legal, but that OpenCASCADE's own writer never makes. What the
/// files mean is known in closed form.
namespace probewright::simulation::testing {

class StepFile {
public:
  struct Units {
    double length = 1;     ///< mm: 1, 25.4 or 1000
    bool degrees = false;  ///< angles in degrees, not in radians
  };
  explicit StepFile(Units units);
  StepFile() : StepFile(Units{}) {}

  const Units& units() const { return units_; }
  /// Appends an entity, "PLANE('',#7)", and returns its number.
  int add(const std::string& text);
  /// mm and radians become what the units of the file ask for.
  std::string length(double mm) const;
  std::string angle(double radians) const;

  int point(const Vector3& place);
  int vertex(const Vector3& place);
  int direction(const Vector3& direction);
  int axes(const Vector3& origin, const Vector3& z, const Vector3& x);
  int axes(const Pose& pose) { return axes(pose.translation(), pose.linear().col(2), pose.linear().col(0)); }
  /// The units, as every representation needs them.
  int context() const { return context_; }
  /// Lengths and angles from here on are in these units; what is represented later is, too.
  void use(Units units);
  /// A product and the definition of its shape.
  int product(const std::string& name);
  /// The product's shape are the `items`.
  int represent(int definition, const std::vector<int>& items, const std::string& type = "SHAPE_REPRESENTATION");
  /// The body that the faces close.
  int solid(const std::vector<int>& faces);
  /// A product with its shape, whose coordinates are those of `origin`.
  struct Shape {
    int product = 0, representation = 0, origin = 0;
  };
  /// Puts the component into the assembly, with its origin at the axes `place`.
  void put(const Shape& component, const Shape& assembly, int place);
  /// The file with one product of these items.
  std::string withItems(const std::vector<int>& items);
  std::string text() const;

private:
  Units units_;
  std::string data_;
  int last_ = 0;
  int context_ = 0;
};

/// "#1,#2,#3".
std::string listOf(const std::vector<int>& ids);

/// A body of revolution: the closed line about its meridian, the material to its left (r to the right, z upwards).
struct Meridian {
  struct Piece {
    double r, z;                ///< where it begins; it ends where the next begins
    bool isArc = false;         ///< else straight
    double centreR = 0;         ///< of the arc
    double centreZ = 0;         ///< of the arc
    bool anticlockwise = true;  ///< the way it runs, seen with r to the right
  };
  std::vector<Piece> pieces;

  /// The distance of a point from the body's surface, always positive; axis Z.
  double distance(const Vector3& point) const;
};

/// How a body of revolution is written.
struct Dialect {
  enum class Surfaces { Own, Revolution, Offset, Splines };
  enum class Loops { Seam, TwoCircles, Sectors };
  Surfaces surfaces = Surfaces::Own;
  Loops loops = Loops::Seam;
  int sectors = 1;             ///< of Loops::Sectors
  double seamAt = 0;           ///< radians: where the first meridian lies
  bool axesDown = false;       ///< surfaces have their axis the other way round
  bool loopsReversed = false;  ///< loops the other way round, with .F. in their bounds
  bool edgesReversed = false;  ///< edges against their curves
  int firstEdge = 0;           ///< the edge with which loops begin
};

/// The faces of the body at a pose, as entities of the file.
std::vector<int> revolvedFaces(StepFile& file, const Meridian& meridian, const Pose& pose, const Dialect& dialect);

}  // namespace probewright::simulation::testing
