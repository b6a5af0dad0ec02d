#pragma once

#include "language/block.hpp"

namespace probewright::language {

/// True if an expression of the block divides by a number, or by a sum, difference or product of numbers, that is 0:
/// whatever runs before it, the run refuses this block.
bool dividesByZero(const Block& block);

}  // namespace probewright::language
