#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "language/block.hpp"

namespace probewright::language {

/// One program file of one language, read block by block, so that memory does not grow with its length. Parsing a
/// block needs no knowledge of other blocks; what a jump needs (labels, structure) is found by scanning once.
class Program {
public:
  virtual ~Program() = default;

  /// The path as the user gave it or as the call found it; for messages.
  virtual const std::string& file() const = 0;
  /// The name without folder and ending.
  virtual const std::string& name() const = 0;

  virtual BlockPosition begin() const = 0;

  /// Parses the block at `position` into `block` (which is cleared first). False at the end of the program. Mistakes go
  /// to `diagnostics`; a block with a mistake has no instructions.
  virtual bool parse(BlockPosition position, Block& block, Diagnostics& diagnostics) = 0;

  /// The position of the block that carries `label`, seen from the block at `from`.
  virtual std::optional<BlockPosition> findLabel(std::string_view label, BlockPosition from,
                                                 JumpDirection direction) = 0;

  /// The counterpart of the structured statement at `position`: where the interpreter goes on looking for it.
  /// If -> Else or EndIf; Else -> EndIf; While/For/Loop -> End...; End... -> its beginning; Until -> Repeat.
  virtual std::optional<BlockPosition> counterpart(BlockPosition position) = 0;
};

/// Finds programs for calls.
class ProgramLibrary {
public:
  virtual ~ProgramLibrary() = default;
  /// The program that `caller` means by `name`, or the reason why there is none.
  virtual Result<std::shared_ptr<Program>> open(std::string_view name, const Program* caller) = 0;
  /// True if open would find a program: SINUMERIK programs take precedence over cycles of the same name.
  virtual bool exists(std::string_view name, const Program* caller) = 0;
};

}  // namespace probewright::language
