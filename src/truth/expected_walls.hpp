#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/working_plane.hpp"
#include "geometry/primitives.hpp"
#include "simulation/truth.hpp"

/// Slots, ridges, rectangular pockets and studs: what the call of a cycle says of their walls, and where they truly
/// are.
namespace probewright::truth {

/// Two walls that face each other, or away from each other.
struct WallPair {
  Vector3 across = Vector3::UnitX();  ///< unit, workpiece system
  double width = 0;
};

/// In workpiece coordinates.
struct ExpectedWalls {
  Vector3 centre = Vector3::Zero();  ///< at the measuring height, as far as the call tells it
  std::vector<WallPair> pairs;       ///< one of a slot or ridge, two of a rectangle
  bool inside = true;                ///< a slot or pocket
  std::string from;                  ///< what says where: "Q321/Q322", "the start position"
};

/// Pairs of these widths along main and minor axis, turned by `degrees`; nothing where one of them is no width.
std::vector<WallPair> wallPairs(const control::WorkingPlane& plane, std::optional<double> main,
                                std::optional<double> minor, double degrees = 0);
/// One pair, along the main axis (1) or the minor one (2).
std::vector<WallPair> wallPair(const control::WorkingPlane& plane, std::optional<double> axis,
                               std::optional<double> width, double degrees = 0);

struct TrueWalls {
  Vector3 centre = Vector3::Zero();  ///< table frame; where no wall was looked for as expected
  std::vector<double> widths;        ///< of each pair
};

/// The walls nearest to where they were expected, felt with a small ball at the expected height: at most 60 mm from
/// there. Nothing unless every pair has both walls, at least half as far apart as expected and at most twice as far.
std::optional<TrueWalls> trueWalls(const ExpectedWalls& expected, const Eigen::Affine3d& tableFromProgram,
                                   const std::vector<simulation::PlacedSolid>& solids);

}  // namespace probewright::truth
