#pragma once

#include <optional>

#include "language/block.hpp"

/// Touch probe cycles 30 to 33 and 480 to 483 do the same; the old form names the parameter of its status itself, the
/// new one has it in Q199.
namespace probewright::conversion {

/// In which form a program gets these cycles.
enum class ToolCycles { AsWritten, Old, New };

struct ToolCycleForm {
  language::Block block;
  /// Number of the Q parameter that is to have the value of Q199 after the block.
  std::optional<double> status;
};

/// A block with one of the old cycles as its new one; nothing of other blocks.
std::optional<ToolCycleForm> newToolCycle(const language::Block& block);

/// The other way round. Nothing where the old form cannot say it: a clearance height of GLOBAL DEF.
std::optional<ToolCycleForm> oldToolCycle(const language::Block& block);

/// True for a block with one of cycles 480 to 483.
bool hasNewToolCycle(const language::Block& block);

}  // namespace probewright::conversion
