#pragma once

#include <string>

#include "language/block.hpp"
#include "language/klartext/program.hpp"

namespace probewright::language::klartext {

/// The block as Klartext in the form that controls write, without block number and line end: what it does is written
/// from its instructions, names of cycles and comments from its own text. Cycles have one line per parameter, parts of
/// old-form cycles one line each. Reading the text back gives the same instructions. Blocks that come from another
/// language must consist of what Klartext can say; what it cannot is written as an ERROR = block.
std::string writeBlock(const Block& block);

/// The whole program with block numbers from 0.
std::string writeProgram(KlartextProgram& program);

}  // namespace probewright::language::klartext
