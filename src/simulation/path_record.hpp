#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "machine/description.hpp"

/// What a report needs to show where the tool went and what it felt: the truth, seen from the table.
namespace probewright::simulation {

enum class PathKind : std::uint8_t { Start, Rapid, Feed, Measure, Retract, ToolChange };

/// The end of a piece of path. Table frame, mm.
struct PathPoint {
  Vector3 tip = Vector3::Zero();     ///< the ball's centre; a cutter's tip; the spindle nose
  Vector3 shank = Vector3::UnitZ();  ///< unit, from the tip along the tool's shank
  PathKind kind = PathKind::Start;   ///< how the tool came here
  double seconds = 0;
  int tool = -1;                ///< in the spindle: its place in Truth::tools; -1: none
  machine::AxisPositions axes;  ///< as they read
};

/// One touch as it truly was. Table frame, mm.
struct PathTouch {
  std::size_t pathPoint = 0;  ///< the index of the point where the axes stopped
  PathKind kind = PathKind::Measure;
  std::string solid;                     ///< what was touched
  std::string part;                      ///< with what: "ball", "stylus", "body", "tool"
  Vector3 point = Vector3::Zero();       ///< on the surface
  Vector3 normal = Vector3::UnitZ();     ///< outward, unit
  Vector3 ballCentre = Vector3::Zero();  ///< at contact; only where the ball touched
  machine::AxisPositions latched;        ///< what the control was told; only for measuring moves
  double seconds = 0;
};

enum class Recording : std::uint8_t {
  Everything,
  Touches,  ///< of the tool, with the points where they happened, and tool changes
  Nothing,
};

struct PathRecord {
  std::vector<PathPoint> points;
  std::vector<PathTouch> touches;
  double length = 0;     ///< mm, of the tip on the table, as it was travelled
  double tolerance = 0;  ///< mm: how far points that were left out may lie beside the path that is kept
};

/// Keeps the record of a run without letting it grow with a program of a million blocks. Beyond twice `most` points it
/// leaves out ends of positioning and feed moves, as far as the rest, joined by straight lines, stays within a
/// tolerance. The tolerance begins at 0.001 mm and doubles until at most `most` points are left. Measuring and
/// retracting moves, tool changes, turns of the tool of more than 2 degrees and points where something was touched
/// stay, however many they are.
class PathRecorder {
public:
  explicit PathRecorder(PathPoint start, std::size_t most = 100'000);

  void add(const PathPoint& point);
  /// A touch at the last point.
  void add(PathTouch touch);
  const PathRecord& record() const { return record_; }

private:
  void thinOut();
  void thinOutFrom(std::size_t first, double tolerance);
  bool chordHolds(std::size_t from, std::size_t to, double tolerance) const;

  std::size_t most_;
  std::size_t limit_;        ///< the number of points that thins out again
  std::size_t thinned_ = 0;  ///< the points before this one are as thin as the tolerance allows
  PathRecord record_;
};

}  // namespace probewright::simulation
