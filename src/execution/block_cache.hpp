#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "execution/names.hpp"
#include "language/block.hpp"

namespace probewright::execution {

/// A block with what was found out about it once.
struct ParsedBlock {
  Block block;
  /// The place that an instruction of this block leads to, because it is the same every time.
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};
  std::uint32_t targetOf = nothing;  ///< the instruction
  BlockPosition target;
};

/// Keeps up to `capacity` parsed blocks, each at one of a few slots its position decides; slots are reused, so a warm
/// cache allocates nothing.
class BlockCache {
public:
  static constexpr std::size_t capacity = 4096;

  /// The slot for the block at `offset` of program `program`, and whether the block is there already. A new one is to
  /// be filled by the caller. `pinned` is not given up for it.
  struct Slot {
    ParsedBlock& block;
    bool found;
  };
  Slot slot(std::uint32_t program, std::uint64_t offset, const ParsedBlock* pinned) {
    const std::uint64_t key = (offset << 20U) ^ program;
    Set& set = sets_[static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> (64U - setBits))];
    for (std::size_t way = 0; way < ways; ++way) {
      if (set.keys[way] == key && set.blocks[way]) return {*set.blocks[way], true};
    }
    std::size_t victim = set.next++ % ways;
    if (set.blocks[victim] && set.blocks[victim].get() == pinned) victim = set.next++ % ways;
    if (!set.blocks[victim]) set.blocks[victim] = std::make_unique<ParsedBlock>();
    set.keys[victim] = key;
    set.blocks[victim]->targetOf = ParsedBlock::nothing;
    return {*set.blocks[victim], false};
  }

  void clear() {
    for (Set& set : sets_)
      set.keys.fill(none);
  }

private:
  static constexpr std::size_t ways = 4;
  static constexpr unsigned setBits = 10;
  static constexpr std::uint64_t none = ~std::uint64_t{0};
  static_assert((std::size_t{1} << setBits) * ways == capacity);

  struct Set {
    std::array<std::uint64_t, ways> keys{none, none, none, none};
    std::array<std::unique_ptr<ParsedBlock>, ways> blocks;
    std::size_t next = 0;
  };
  std::vector<Set> sets_ = std::vector<Set>(std::size_t{1} << setBits);
};

}  // namespace probewright::execution
