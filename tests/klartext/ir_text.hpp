#pragma once

#include <string>

#include "language/block.hpp"

namespace probewright::language::klartext::testing {

/// What a block does, written in one line per instruction, for comparison: "Linear X=10 Y=Q5 RL FMAX".
std::string irText(const Block& block);

/// Parses one block and writes it; mistakes are written as "column: message".
std::string irOf(const std::string& text);

}  // namespace probewright::language::klartext::testing
