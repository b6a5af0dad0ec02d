#pragma once

#include <string>

#include "base/diagnostic.hpp"
#include "language/block.hpp"

namespace probewright::language::din_iso {

/// The block in DIN/ISO in the form that controls write, without block number, with the sign '*' at its end. The block
/// must say everything itself: one of Klartext, or a DIN/ISO one after ModalState::resolve. G90 or G91 and the path
/// function are always written, so that the text means the same wherever it stands. Comments and names of cycles come
/// from the block's own text. Fails, with the reason, for what DIN/ISO cannot say.
Result<std::string> writeBlock(const Block& block);

}  // namespace probewright::language::din_iso
