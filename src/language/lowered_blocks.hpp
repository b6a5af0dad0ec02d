#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "language/block.hpp"

namespace probewright::language {

/// The blocks of a program that is read again and again, as they came out of the parser. Holds so many that what is
/// measured in a program of ordinary size is parsed once, and no more, so that memory does not grow with its length.
class LoweredBlocks {
public:
  static constexpr std::size_t most = 4096;

  /// The block that was kept of this position; null if none was.
  const Block* find(BlockPosition position) const {
    const auto found = blocks_.find(position.offset);
    return found == blocks_.end() ? nullptr : &found->second;
  }
  /// Keeps a block without mistakes.
  void keep(const Block& block) {
    if (blocks_.size() < most) blocks_.try_emplace(block.position.offset, block);
  }

private:
  std::unordered_map<std::uint64_t, Block> blocks_;
};

}  // namespace probewright::language
