#pragma once

#include <string>
#include <string_view>

#include "language/block.hpp"

/// Parts of writeBlock: what has words of its own.
namespace probewright::language::klartext {

std::string writeCycle(const Block& block, const CycleCall& call);
std::string writeTransform(const Block& block, const Transform& transform);
std::string writeCommand(const Block& block, const Command& command);

/// "FU" or "FZ" if the word is a feed per revolution or per tooth; empty otherwise.
std::string_view feedPerTurn(const Block& block, const Word& word);

/// The comment in a line of the block's own text, with its ';'; empty if there is none. A continuation sign at its end
/// is left out.
std::string_view commentOfLine(const Block& block, std::uint32_t line);

/// The whole comment of a block that is not a cycle, with the lines that continuation signs add.
std::string commentOf(const Block& block);

}  // namespace probewright::language::klartext
