#pragma once

#include <vector>

#include "simulation/truth.hpp"

/// What of a tool can touch something: the ball of a probe (four of a star), and shafts for everything else: capsules
/// and cylinders. All in the spindle frame.
namespace probewright::simulation {

struct Ball {
  Vector3 centre = Vector3::Zero();
  double radius = 0;
};

enum class Ends { Round, Flat };

/// All points within `radius` of the segment from start to start + axis; with flat ends the cylinder about it.
struct Shaft {
  Vector3 start = Vector3::Zero();
  Vector3 axis = Vector3::UnitZ();
  double radius = 0;
  const char* part = "";  ///< for messages: "stylus", "body", "tool"
  Ends ends = Ends::Round;
};

/// The part that a stylus is called.
inline constexpr const char* shaftName = "stylus";
/// The part of a cutter that its edges are in.
inline constexpr const char* cutterName = "tool";

struct ToolShape {
  std::vector<Ball> balls;  ///< none of a cutter
  std::vector<Shaft> shafts;
  Vector3 tip = Vector3::Zero();  ///< what the path record follows: the ball's centre, the middle of a star, a cutter's
                                  ///< tip, the nose
  Vector3 shank = Vector3::UnitZ();  ///< unit, from the tip along the shank
};

/// The axes of a tool as columns, spindle frame, untwisted: Z from the tip to the holder; X and Y the spindle's own, or
/// of tools along the spindle's X or Y the two axes that follow it in the order X, Y, Z. The spindle turns the tool
/// about its Z, also where an angle head leads it aside.
Matrix3 toolFrame(const TrueTool& tool);

/// The shape of `tool` (none: the empty spindle) with the spindle turned to `spindleDegrees`.
ToolShape shapeOf(const TrueTool* tool, double spindleDegrees);

}  // namespace probewright::simulation
