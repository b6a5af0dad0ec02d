#pragma once

#include <string>

#include "klartext/ir_text.hpp"
#include "language/din_iso/modal_state.hpp"
#include "language/din_iso/program.hpp"

namespace probewright::language::din_iso::testing {

/// What the blocks do, one line each, completed by the modal functions in force; mistakes behind them as
/// "line:column: message". Modal functions themselves are left out.
inline std::string resolvedText(const std::string& text) {
  DinIsoProgram program("test.i", text);
  Block block, resolved;
  Diagnostics diagnostics;
  ModalState state;
  std::string result;
  for (BlockPosition at = program.begin(); program.parse(at, block, diagnostics); at = block.next) {
    state.resolve(block, resolved);
    std::erase_if(resolved.instructions, [&resolved](const Instruction& instruction) {
      const auto* modal = std::get_if<Modal>(&instruction);
      return modal != nullptr && isModalFunction(resolved, *modal);
    });
    const std::string written = klartext::testing::irText(resolved);
    if (!result.empty() && !written.empty()) result += "\n";
    result += written;
  }
  for (const Diagnostic& d : diagnostics) {
    if (!result.empty()) result += "\n";
    result += std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + ": " + d.message;
  }
  return result;
}

}  // namespace probewright::language::din_iso::testing
