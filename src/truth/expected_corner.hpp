#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "control/journal.hpp"
#include "geometry/primitives.hpp"
#include "simulation/truth.hpp"

/// Corners of two sides: what the call of a cycle says of them, and where they truly are.
namespace probewright::truth {

/// A side as the call expects it: the touch on it that is furthest from the corner, and the direction into the
/// material. Workpiece coordinates.
struct ExpectedSide {
  Vector3 point = Vector3::Zero();
  Vector3 into = Vector3::UnitX();  ///< unit; how it is probed
};

struct ExpectedCorner {
  Vector3 corner = Vector3::Zero();  ///< at the measuring height, as far as the call tells it
  std::array<ExpectedSide, 2> sides;
  int tool = 2;      ///< the axis of the workpiece system that the tool lies along
  std::string from;  ///< what says where: "Q263/Q264", "the pole"
};

/// Nothing for cycles that look for something else. `tool`, `start`: as of expectedRound.
std::optional<ExpectedCorner> expectedCorner(const control::CycleRecord& cycle, int tool, const Vector3& start);

struct TrueCorner {
  Vector3 corner = Vector3::Zero();  ///< table frame
  std::array<Vector3, 2> along;      ///< unit, table frame: from the corner along the sides
  std::array<double, 2> turned{};    ///< degrees, of each side from the one expected, about the tool's axis
};

/// Where the sides cross that are felt from where they are expected, up to 60 mm further. Nothing unless both are
/// found.
std::optional<TrueCorner> trueCorner(const ExpectedCorner& expected, const Eigen::Affine3d& tableFromProgram,
                                     const std::vector<simulation::PlacedSolid>& solids);

}  // namespace probewright::truth
