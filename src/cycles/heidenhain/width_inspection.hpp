#pragma once

#include <string>

#include "cycles/heidenhain/inspection.hpp"

/// What cycles 425 and 426 have in common.
namespace probewright::cycles::heidenhain {

/// Evaluates the two walls (coordinates in the measuring axis) against Q311, Q288 and Q289.
void finishWidthInspection(Context& context, double plus, double minus, Side side, const std::string& title);

}  // namespace probewright::cycles::heidenhain
