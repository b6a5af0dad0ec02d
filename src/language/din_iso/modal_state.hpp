#pragma once

#include <optional>

#include "language/block.hpp"
#include "language/din_iso/path_words.hpp"

namespace probewright::language::din_iso {

/// What the blocks before a DIN/ISO block have left in force. It follows the order in which blocks are carried
/// out: a subprogram inherits it from its caller and hands it back.
struct ModalState {
  bool incremental = false;            ///< G91
  int path = 1;                        ///< G0 to G16
  char toolAxis = 0;                   ///< G17 Z, G18 Y, G19 X; 0: not programmed yet
  bool toolCalled = false;             ///< a T block has handed the axis over
  std::optional<PathMistake> mistake;  ///< what the path block that was resolved last must not have

  /// Fills what the parser left open (see BlockParser), so that `resolved` says what a Klartext block would say. Its
  /// instructions stand under the numbers they have in `block`; Modal ones that nothing is left to do for stay as they
  /// are. The state is then that after the block.
  void resolve(const Block& block, Block& resolved);
};

/// True for the modal functions that resolve uses up: "G0", "G90"...
bool isModalFunction(const Block& block, const Modal& modal);

}  // namespace probewright::language::din_iso
