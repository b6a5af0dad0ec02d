#pragma once

#include "simulation/truth.hpp"

/// From the touch of a solid to the signal of a sensor: what all machines with true probes share.
namespace probewright::simulation {

/// How much further the axes travel along their path from contact to signal, mm, without noise and delay: the formula
/// of TrueProbe. `normal`: outward, of the surface, in the spindle frame (at spindle angle 0); `spindleDegrees`: how
/// the spindle is turned.
double pretravelOf(const TrueTool& tool, double spindleDegrees, const Vector3& normal);

/// The direction in which a contact is pushed, in its frame: mainly along this axis.
Push pushOf(const Vector3& direction);

/// Contact of a ball is held to be no collision until the surface is this far within its first touch, in ball radii.
inline constexpr double deepestDeflection = 1.6;

}  // namespace probewright::simulation
