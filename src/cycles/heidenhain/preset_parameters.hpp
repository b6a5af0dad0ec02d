#pragma once

#include <array>

#include "cycles/heidenhain/parameters.hpp"
#include "cycles/joined.hpp"

/// The parameters at the end of most presetting cycles, in the order in which the control writes them. Programs of
/// older controls end with Q332: they know no Q303, which counts as -1, and set no preset in the touch probe axis.
namespace probewright::cycles::heidenhain::parameters {

inline constexpr std::array toolAxisPreset = {standard(probeToolAxis, 0), standard(toolAxisPoint1, 0),
                                              standard(toolAxisPoint2, 0), standard(toolAxisPoint3, 0), newPreset3};

/// Q303 and the preset in the touch probe axis.
inline constexpr std::array transferAndToolAxis = joined(std::array{standard(transfer, -1)}, toolAxisPreset);

/// Where the measured centre goes: Q305, Q331, Q332, Q303, and the preset in the touch probe axis.
inline constexpr std::array centreTransfer =
    joined(std::array{presetTableRow, newPreset1, newPreset2}, transferAndToolAxis);

inline constexpr Choice basicRotationChoices[] = {{0, "no"}, {1, "yes"}};
inline constexpr Parameter basicRotation =
    option(304, "Q304", "compensate the misalignment by a basic rotation", basicRotationChoices);

inline constexpr std::array heights = {measuringHeight, setUpClearance, clearanceHeight};
inline constexpr std::array heightsAndTravel = {measuringHeight, setUpClearance, clearanceHeight, moveToClearance};

}  // namespace probewright::cycles::heidenhain::parameters
