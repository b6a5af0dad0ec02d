#pragma once

#include <optional>
#include <string>

#include "language/block.hpp"

/// Which words the path functions G00 to G16 take. A control refuses a block with any other word.
namespace probewright::language::din_iso {

struct PathMistake {
  Word word;  ///< the one that does not belong to the path
  std::string message, advice;
};

/// What is wrong with the words of a path block (Move with the variant "G", as BlockParser leaves it) under the path
/// function G`path`, which the block itself or one before it has.
std::optional<PathMistake> pathMistake(int path, const Block& block, const Move& move);

/// True for G00 to G03, G05 to G07, G10 to G13, G15 and G16.
bool isPath(int number);

/// The number of the path function that a block has: of its Modal "G11"; nothing if it has none.
std::optional<int> pathOf(const Block& block);

}  // namespace probewright::language::din_iso
