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

/// The same in the working plane: main and minor axis.
struct PlaneCorner {
  Vector2 corner = Vector2::Zero();
  std::array<Vector2, 2> point, into;
  double height = 0;
  std::string from;
};
ExpectedCorner inWorkpiece(const PlaneCorner& known, int tool);

double cross(const Vector2& a, const Vector2& b);
/// Where the lines p + t*d and q + t*e meet; nothing if they are nearly parallel.
std::optional<Vector2> crossing(const Vector2& p, const Vector2& d, const Vector2& q, const Vector2& e);

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
