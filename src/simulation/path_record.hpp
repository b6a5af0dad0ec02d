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

struct PathRecord {
  std::vector<PathPoint> points;
  std::vector<PathTouch> touches;
  double length = 0;  ///< mm, of the tip on the table
};

}  // namespace probewright::simulation
