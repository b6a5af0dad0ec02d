#pragma once

#include <cstddef>
#include <span>

#include "geometry/primitives.hpp"
#include "machine/description.hpp"

/// Where axes of rotation lie, other than a description says: what separates one description of a machine from another.
/// Directions and places are those of the base frame with all axes at 0.
namespace probewright::machine {

/// The rotation by a vector's length (degrees) about its direction; for small ones its components are turns about X, Y
/// and Z.
Pose rotationVector(const Vector3& degrees);

struct RotaryCorrection {
  std::size_t axis = 0;
  Vector3 position = Vector3::Zero();     ///< mm, by which the axis of rotation lies elsewhere
  Vector3 orientation = Vector3::Zero();  ///< degrees, a rotation vector that turns its direction about its point
  /// Degrees at which the axis stands when it reads 0. Turns the axes that it carries; the frame of table or spindle at
  /// the end of the chain stays, because a turned table is a turned workpiece and a turned tool is none.
  double zero = 0;
  bool operator==(const RotaryCorrection&) const = default;
};

/// Corrects the element of that axis; does nothing if no chain has it.
void correct(MachineDescription& machine, const RotaryCorrection& correction);

/// `built` with all corrections, from the bed to the ends of the chains whatever their order is.
MachineDescription corrected(const MachineDescription& built, std::span<const RotaryCorrection> corrections);

}  // namespace probewright::machine
