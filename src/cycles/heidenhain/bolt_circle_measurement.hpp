#pragma once

#include <array>

#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/parameters.hpp"

/// What cycles 416 and 430 have in common: a bolt hole circle through three of its holes.
namespace probewright::cycles::heidenhain {

namespace parameters {
inline constexpr std::array boltCircleParameters = {
    coordinate(273, "Q273", "nominal centre in the main axis"),
    coordinate(274, "Q274", "nominal centre in the minor axis"),
    length(262, "Q262", "nominal diameter of the bolt hole circle"),
    angle(291, "Q291", "angle of the first hole from the main axis"),
    angle(292, "Q292", "angle of the second hole from the main axis"),
    angle(293, "Q293", "angle of the third hole from the main axis"),
    measuringHeight,
    clearanceHeight,
};
}  // namespace parameters

/// Centre and diameter of the circle through the centres of the three holes.
MeasuredCircle measureBoltCircle(Context& context);

}  // namespace probewright::cycles::heidenhain
