// Any bytes as a DIN/ISO program: checked, written back, and run on a control with a five-axis machine that reaches
// everything. What was read without a mistake and can be written reads without a mistake again.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "heidenhain_run.hpp"
#include "language/din_iso/modal_state.hpp"
#include "language/din_iso/program.hpp"
#include "language/din_iso/writer.hpp"
#include "language/klartext/check.hpp"

namespace {

using namespace probewright;
using namespace probewright::language;

bool isFrame(const Block& block) {
  for (const Instruction& instruction : block.instructions) {
    const auto* command = std::get_if<Command>(&instruction);
    if (command != nullptr && block.at(command->name) == "BEGIN PGM") return true;
  }
  return false;
}

void writeBack(din_iso::DinIsoProgram& program) {
  Block block, resolved, again;
  Diagnostics mistakes;
  din_iso::ModalState state;
  BlockPosition position = program.begin();
  while (mistakes.clear(), program.parse(position, block, mistakes)) {
    position = block.next;
    state.resolve(block, resolved);
    std::erase_if(resolved.instructions, [&](const Instruction& instruction) {
      const auto* modal = std::get_if<Modal>(&instruction);
      return modal != nullptr && din_iso::isModalFunction(resolved, *modal);
    });
    // Several functions in one block are written one by one where programs are translated.
    if (!mistakes.empty() || resolved.instructions.size() != 1 || isFrame(block)) continue;
    const Result<std::string> text = din_iso::writeBlock(resolved);
    if (!text) continue;
    din_iso::DinIsoProgram written("written.i", "%A G71 *\n" + *text + "\n");
    mistakes.clear();
    if (!written.parse(written.begin(), again, mistakes)) std::abort();
    if (!written.parse(again.next, again, mistakes) || !mistakes.empty() || again.instructions.empty()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t longest = 4096;
  const std::string text(reinterpret_cast<const char*>(data), std::min(size, longest));
  const auto program = std::make_shared<din_iso::DinIsoProgram>("fuzz.i", text);
  klartext::checkProgram(*program, control::ControlKind::TNC640);
  writeBack(*program);
  fuzzing::run(program, text);
  return 0;
}
