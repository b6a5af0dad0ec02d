#pragma once

#include <array>
#include <string>

#include "cycles/heidenhain/inspection.hpp"

/// What cycles 425 and 426 have in common.
namespace probewright::cycles::heidenhain {

namespace parameters {

inline constexpr std::array widthInspectionResults = {
    ResultDefinition{"Q156", "actual width"},
    ResultDefinition{"Q157", "actual position of the centre line"},
    ResultDefinition{"Q166", "deviation of the width"},
    ResultDefinition{"Q180", "1: within tolerance", ValueKind::Integer},
    ResultDefinition{"Q181", "1: rework", ValueKind::Integer},
    ResultDefinition{"Q182", "1: scrap", ValueKind::Integer},
};

}  // namespace parameters

/// Evaluates the two walls (coordinates in the measuring axis) against Q311, Q288 and Q289.
void finishWidthInspection(Context& context, double plus, double minus, Side side, const std::string& title);

}  // namespace probewright::cycles::heidenhain
