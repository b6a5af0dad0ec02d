#pragma once

#include <optional>
#include <string>

#include "machine/description.hpp"

namespace probewright::adapter {

/// No touch lies farther from the straight line of its measuring move: mm, degrees of rotary axes. Machines deviate by
/// less (following error, overshoot); another unit, another zero point and the touch of another move by more.
constexpr double latchedWithin = 1;

/// Why an adapter cannot have latched this position in a measuring move between two positions of the axes; nothing: it
/// can. Of axes without end stops turns do not count.
std::optional<std::string> offTheMeasuringMove(const machine::MachineDescription& machine,
                                               const machine::AxisPositions& start,
                                               const machine::AxisPositions& target,
                                               const machine::AxisPositions& latched);

}  // namespace probewright::adapter
