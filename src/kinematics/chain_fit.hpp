#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"
#include "machine/rotary_correction.hpp"

/// All axes of rotation of a machine at once, from a sphere on its table that was found at several positions of them,
/// whichever of them carry the table and whichever the tool, in any order.
namespace probewright::kinematics {

/// The sphere as it was found once: the readings of all axes with the ball's centre at the sphere's, computed from the
/// touches.
struct SphereSighting {
  machine::AxisPositions axes;
  Vector3 ball = Vector3::Zero();  ///< mm, the centre of the probe's ball in the spindle frame
};

/// What of an axis is to be found; the rest stays as it is believed. Its place always is.
struct AxisFreedoms {
  std::size_t axis = 0;
  bool tilt = false;  ///< its direction
  /// Where it truly stands when it reads 0: of an axis that carries another one, whose direction tells it.
  bool zero = false;
  /// Of the direction only the turn across `zeroOf`: what is left to an axis whose carrier has its zero position found.
  std::optional<std::size_t> zeroOf = std::nullopt;
};

struct ChainFitTask {
  machine::MachineDescription built;                ///< as its builder describes it
  std::vector<machine::RotaryCorrection> believed;  ///< what is believed to differ
  machine::AxisPositions reference;                 ///< of the rotary axes: where machine coordinates count
  std::vector<AxisFreedoms> free;
  /// How far the tip is believed to be from where the axes tell, machine axes, by the positions of the rotary axes.
  std::function<Vector3(const machine::AxisPositions&)> tipDeviation;
  /// Where the sphere is, machine coordinates at the reference posture, mm. Nothing: to be found as well.
  std::optional<Vector3> sphere;
  /// The spindle may have shifted as a whole; `sphere` must be told. Axes of `beforeShift` carry the shifted ones: the
  /// shift turns with them.
  bool shift = false;
  std::vector<std::size_t> beforeShift;
};

/// What was found of one axis. Cofactors: covariances where each coordinate of a found sphere has the standard
/// deviation 1 mm; base frame, all axes at 0.
struct FoundAxis {
  std::size_t axis = 0;
  double radius = 0;    ///< mm, mean radius of the circles about it on which sphere or ball were found
  double span = 0;      ///< degrees, between its outermost positions
  bool tilted = false;  ///< its direction was found too
  Matrix3 positionCofactors = Matrix3::Zero();     ///< mm^2
  Matrix3 orientationCofactors = Matrix3::Zero();  ///< rad^2
};

struct ChainFit {
  std::vector<machine::RotaryCorrection> corrections;  ///< those of the task, with what was found
  machine::MachineDescription machine;                 ///< as corrected
  Vector3 shift = Vector3::Zero();                     ///< mm, machine axes: what tipDeviation is to grow by
  Vector3 sphere = Vector3::Zero();                    ///< machine coordinates at the reference posture
  std::vector<FoundAxis> axes;                         ///< in the order of the task
  std::vector<Vector3> residuals;                      ///< mm, of each sighting, machine axes at the reference posture
  double rms = 0;                                      ///< mm
  int degreesOfFreedom = 0;
  /// Freedoms that the positions leave open and that therefore stay as believed, each as a sentence with numbers.
  std::vector<std::string> undetermined;
};

/// Where the sighting sees the sphere with these corrections: machine coordinates at the reference posture.
Vector3 seen(const ChainFitTask& task, const machine::MachineDescription& machine, const SphereSighting& sighting);

/// How far from that axis the sphere's centre (axes of the table) or the ball's (axes of the spindle side) is, mm.
double radiusAbout(const machine::MachineDescription& machine, const SphereSighting& sighting, std::size_t axis);

/// Least squares over all sightings. Directions and zero positions that the positions leave open are dropped and named;
/// fails if they leave even the place of an axis open.
Result<ChainFit> fitChain(const ChainFitTask& task, std::span<const SphereSighting> sightings);

/// How well the sightings of each series tell the places of the free axes, in the order of the task: 1 / the larger
/// variance of an axis' two coordinates, where the first sighting of a series counts as exact and each coordinate of
/// the others has the standard deviation 1 mm. Of a single axis the sum of 2 - 2 cos of its angles; 0 if they leave the
/// place open.
std::vector<double> valuations(const ChainFitTask& task, std::span<const std::vector<SphereSighting>> series);

}  // namespace probewright::kinematics
