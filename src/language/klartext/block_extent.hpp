#pragma once

#include <cstdint>
#include <string_view>

namespace probewright::language::klartext {

/// How far a block reaches.
struct BlockExtent {
  std::size_t length = 0;   ///< bytes of the block without its last line end
  std::size_t next = 0;     ///< where the next block begins
  std::uint64_t lines = 1;  ///< line ends up to `next`
};

/// The extent of the block at the beginning of `text`, which reaches to the end of the file.
BlockExtent blockExtent(std::string_view text);

/// True if `block` ends with a `~` after which nothing of it follows.
bool endsOpen(std::string_view block);

/// The block's first word and all after it: block number, skip sign and blanks removed.
std::string_view withoutBlockNumber(std::string_view text);

}  // namespace probewright::language::klartext
