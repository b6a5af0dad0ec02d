#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "language/block.hpp"
#include "language/program.hpp"

/// Where the blocks of a program may go on, whatever its language.
namespace probewright::conversion {

/// A block; others are named by their place in FlowGraph::blocks.
struct FlowBlock {
  language::BlockPosition position;
  bool returns = false;             ///< LBL 0
  bool passes = true;               ///< the next block may follow
  bool conditional = false;         ///< only under a condition
  std::vector<std::size_t> jumps;   ///< GOTO, IF, loops
  std::vector<std::size_t> called;  ///< CALL LBL without REP
  std::vector<std::size_t> parts;   ///< CALL LBL with REP: where the repeated part begins
  /// REPEAT: first and last block of the section.
  std::optional<std::pair<std::size_t, std::size_t>> section;
};

class FlowGraph {
public:
  explicit FlowGraph(language::Program& program);

  const std::vector<FlowBlock>& blocks() const { return blocks_; }
  std::optional<std::size_t> at(language::BlockPosition position) const;
  /// The block with LBL 0 that ends the subprogram beginning at `first`, read from top to bottom.
  std::optional<std::size_t> endOf(std::size_t first) const;
  /// False if the blocks follow each other from the first to the last.
  bool branches() const;
  /// No jump and no repetition leaves the blocks from `first` to `last`.
  bool isClosed(std::size_t first, std::size_t last) const;
  /// What may run from `first` on before the subprogram that begins there returns.
  std::vector<std::size_t> reachedFrom(std::size_t first) const;

  /// True if every subprogram ends where its first LBL 0 stands, and every repeated part and section is left at its end
  /// only: then each is one stretch of the program.
  bool subprogramsAreStretches() const;

  /// Calls `flow(from, to)` for each pair of blocks that may follow each other. `isNeutral`: tells of a block that it
  /// leaves things as they were; a subprogram of such blocks is passed over.
  template <class IsNeutral, class Flow>
  void forEachFlow(const IsNeutral& isNeutral, const Flow& flow) const {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const FlowBlock& block = blocks_[i];
      for (const std::size_t to : block.jumps)
        flow(i, to);
      for (const std::size_t to : block.parts)
        flow(i, to);
      bool back = true;  // the block after a call follows the call, not the subprogram
      for (const std::size_t first : block.called) {
        flow(i, first);
        const std::vector<std::size_t> reached = reachedFrom(first);
        for (const std::size_t each : reached)
          back = back && isNeutral(each);
        for (const std::size_t each : reached)
          if (blocks_[each].returns && i + 1 < blocks_.size()) flow(each, i + 1);
      }
      if (block.section) {
        const auto [first, last] = *block.section;
        flow(i, first);
        if (last != i) flow(last, first);
        for (std::size_t each = first; each <= last && each < blocks_.size(); ++each)
          back = back && isNeutral(each);
        if (i + 1 < blocks_.size()) flow(last, i + 1);
      }
      const bool calls = !block.called.empty() || block.section.has_value();
      if (i + 1 < blocks_.size() && block.passes && (!calls || back || block.conditional)) flow(i, i + 1);
    }
  }

private:
  std::vector<FlowBlock> blocks_;
};

}  // namespace probewright::conversion
