#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "conversion/quantity.hpp"

/// What a measuring cycle is to do, in words that belong to no vendor: a reader per vendor fills it from a cycle's
/// call, a writer per vendor makes a call of it. Coordinates are those of the working plane: main axis, minor axis,
/// tool axis.
namespace probewright::conversion {

enum class Feature {
  Hole,
  Spigot,
  HoleSegment,    ///< a hole touched at given angles
  SpigotSegment,  ///< a spigot touched at given angles
  Groove,
  Rib,
  Pocket,             ///< rectangular
  RectangularSpigot,  ///< rectangular
  Surface,            ///< one touch along an axis
  Edge,               ///< its angle, by two touches along an axis
  Plane,              ///< its two angles, by three touches along the tool axis
  InsideCorner,       ///< of two edges, by two touches each
  OutsideCorner,
  HolePair,       ///< the line through the centres of two holes, whose size is not known
  SpigotPair,     ///< the same of two spigots
  BoltCircle,     ///< of three such holes
  HoleDiagonals,  ///< where the lines through four such holes cross, 1 and 3, 2 and 4
  ProbeLength,    ///< calibration on a surface of known height
  ProbeInRing,    ///< calibration of the ball in a ring
  ProbeOnBall,    ///< calibration of the ball on a calibration sphere
};

bool isInside(Feature feature);
bool isRound(Feature feature);
bool isRectangular(Feature feature);
/// Groove or rib: measured along one axis.
bool isWidth(Feature feature);
bool isCorner(Feature feature);

enum class Correction {
  None,
  Origin,             ///< the zero offset shifts until the feature lies where it should
  Rotation,           ///< the zero offset turns
  RotaryAxis,         ///< the zero offset of the rotary axis about the tool axis
  OriginAndRotation,  ///< of a corner: its first edge becomes the main axis
};

/// A point of the plane and its height.
using Place = std::array<Quantity, 3>;

/// What is measured; both controls have a result for most of it.
enum class Meaning {
  Centre1,
  Centre2,
  Size1,
  Size2,
  Coordinate,
  Angle,
  Angle2,
  Centre1Deviation,
  Centre2Deviation,
  Size1Deviation,
  Size2Deviation,
  CoordinateDeviation,
  AngleDeviation,
  Centre1Set,  ///< what the call expects
  Centre2Set,
  Size1Set,
  Size2Set,
  CoordinateSet,
};

/// A deviation that stands for no limit on this side.
inline constexpr double unlimited = 100000;

struct Limits {
  Quantity upper, lower;  ///< deviations from the set size
  /// Where only the running program knows whether there is a limit: values that are all 0 if there is none.
  std::vector<Quantity> upperUnlessZero = {}, lowerUnlessZero = {};

  bool areCertain() const { return upperUnlessZero.empty() && lowerUnlessZero.empty(); }
};

/// The tool that made what is measured, corrected by half the deviation of a size or the whole one of a surface.
struct ToolCorrection {
  std::string tool;  ///< its name, or its number as text
  Quantity least;    ///< smaller deviations correct nothing
  Quantity most;     ///< neither do larger ones; 0: no such limit
};

struct MeasuringTask {
  Feature feature = Feature::Hole;
  double millimetre = 1;  ///< in the unit of all lengths
  /// The expected centre or place of touch. The third is the height of the ball's centre; of a surface along the tool
  /// axis the height of the surface.
  Place place;
  /// Further places: centres of holes and spigots; places of touch: second point of an edge, second and third of a
  /// plane, points 2 to 4 of a corner. Points 1 and 2 of a corner lie on the edge along the main axis, 3 and 4 on the
  /// other one.
  std::vector<Place> further;
  std::array<Quantity, 2> size;  ///< diameter, width or the two lengths
  Quantity angle;                ///< of the first touch on a circle; set angle of an edge, from the main axis
  Quantity step;                 ///< from touch to touch on a circle
  int touches = 4;
  int axis = 0;        ///< measuring axis, 0 to 2
  int sign = 1;        ///< of the probing direction; of a corner's first edge
  int along = 0;       ///< axis in which the points of an edge lie apart
  int secondSign = 1;  ///< of the probing direction at a corner's second edge

  bool calibratesLength = false;  ///< of the probe, along with the ball on a calibration sphere

  Quantity path;                  ///< from where a touch begins to the expected surface
  Quantity beyond;                ///< as far past that place a touch looks for the surface
  Quantity clearance;             ///< height of the tip that is free everywhere
  bool clearanceBetween = false;  ///< go to that height between touches

  Correction correction = Correction::None;
  Quantity row;                                 ///< of the preset table, number of the settable zero offset
  bool active = false;                          ///< correct the zero offset that is in effect, whatever its number
  std::array<std::optional<Quantity>, 3> wish;  ///< coordinates that the feature gets by the correction
  bool fromUnturned = false;                    ///< an edge is measured without the rotation that was in effect
  std::array<std::optional<Limits>, 2> limits;  ///< of the sizes
  std::array<Quantity, 2> centreTolerance;      ///< permissible deviations of the centre; 0: not monitored
  std::optional<ToolCorrection> tool;
  enum class Log { None, File, Screen } log = Log::None;
  bool stops = false;   ///< the program ends if a limit is exceeded
  bool answers = true;  ///< false: what a cycle sets beside its own feature, as the preset in the tool axis; no results
};

}  // namespace probewright::conversion
