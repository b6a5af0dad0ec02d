#pragma once

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

}  // namespace probewright::machine
