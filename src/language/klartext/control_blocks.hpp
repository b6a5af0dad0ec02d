#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "control/control_kind.hpp"
#include "language/block.hpp"

/// Blocks that only one of the controls has.
namespace probewright::language::klartext {

struct LackedBlock {
  std::string name;         ///< as a program writes it: "PRESET SELECT"
  std::string_view advice;  ///< what to write on this control
};

/// The block, or the word of it, that came after the last software of the iTNC 530 and that `control` lacks; nothing if
/// it has all of the instruction.
std::optional<LackedBlock> lackedBlock(control::ControlKind control, const Block& block,
                                       const Instruction& instruction);

}  // namespace probewright::language::klartext
