#pragma once

#include <optional>
#include <vector>

#include "geometry/primitives.hpp"
#include "machine/description.hpp"

namespace probewright::machine {

/// All positions of the rotary axes, within their travels, that point the tool (from its tip to the spindle) along
/// `direction`. Unit vector in the table frame as it lies when the rotary axes stand at `reference`. `toolAxis`: the
/// tool's direction in the spindle frame. Linear axes and rotary axes without influence are those of `now`. Exact to
/// rounding for machines with one or two rotary axes; axes beyond the two that turn the tool stay where they are.
std::vector<AxisPositions> solveRotaryAxes(const MachineDescription& machine, const Vector3& direction,
                                           const Vector3& toolAxis, const AxisPositions& reference,
                                           const AxisPositions& now);

/// The direction of the tool in the same frame, at the axis positions `axes`.
Matrix3 toolOrientation(const MachineDescription& machine, const AxisPositions& reference, const AxisPositions& axes);

/// The axis that decides how far the tool leans: the last one from the workpiece to the tool that does not turn the
/// tool about itself; nothing if there is none.
struct TiltingAxis {
  std::size_t axis = 0;
  /// The angle at which the tool points most nearly along the positive direction of the rotary axis before it, degrees
  /// in machine coordinates; there the two solutions of a direction lie opposite each other. 0 if it is the only one.
  double symmetry = 0;
};
std::optional<TiltingAxis> tiltingAxis(const MachineDescription& machine, const Vector3& toolAxis);

/// The rotary axis next to the workpiece if it lies parallel to the tool that points along `direction` (as in
/// solveRotaryAxes): turning it does not change where the tool points. Otherwise nothing.
std::optional<std::size_t> freeRotaryAxis(const MachineDescription& machine, const Vector3& direction,
                                          const AxisPositions& reference);

/// The position of a free rotary axis that brings a direction in line with another as far as turning can: for an axis
/// of the table the direction `along` of the workpiece (as it lies at `reference`) with `target` in the base frame, for
/// an axis of the spindle side the direction `target` of the spindle frame with `along`. The one nearest to `rest`,
/// where the other axes stand; nothing if no such position lies within the travel.
std::optional<double> alignedAngle(const MachineDescription& machine, std::size_t axis, const Vector3& along,
                                   const Vector3& target, const AxisPositions& reference, const AxisPositions& rest);

}  // namespace probewright::machine
