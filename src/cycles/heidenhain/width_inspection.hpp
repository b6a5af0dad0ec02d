#pragma once

#include <array>
#include <string>

#include "cycles/heidenhain/inspection.hpp"

/// What cycles 425 and 426 have in common.
namespace probewright::cycles::heidenhain {

namespace parameters {

inline constexpr std::array widthInspectionResults = {
    ResultDefinition{"Q156", {"actual ", "width"}, result::actual(of::width).main()},
    ResultDefinition{"Q157", {"actual ", "position of the centre line"}, result::actual(of::coordinate).main()},
    ResultDefinition{"Q166", {"deviation of the ", "width"}, result::difference(of::width)},
    ResultDefinition{"Q180", "1: within tolerance", result::status},
    ResultDefinition{"Q181", "1: rework", result::status},
    ResultDefinition{"Q182", "1: scrap", result::status},
};

}  // namespace parameters

/// Evaluates the two walls (coordinates in the measuring axis) against Q311, Q288 and Q289.
void finishWidthInspection(Context& context, double plus, double minus, Side side, const std::string& title);

}  // namespace probewright::cycles::heidenhain
