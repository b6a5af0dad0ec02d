// Any bytes as a Klartext program: checked, written back, and run on a control with a five-axis machine that reaches
// everything. What was read without a mistake is written so that it reads without a mistake again.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "heidenhain_run.hpp"
#include "language/klartext/check.hpp"
#include "language/klartext/writer.hpp"

namespace {

using namespace probewright;
using namespace probewright::language;

void writeBack(klartext::KlartextProgram& program) {
  Block block, again;
  Diagnostics mistakes;
  BlockPosition position = program.begin();
  while (mistakes.clear(), program.parse(position, block, mistakes)) {
    position = block.next;
    if (!mistakes.empty()) continue;
    klartext::KlartextProgram written("written.h", klartext::writeBlock(block) + "\n");
    const bool read = written.parse(written.begin(), again, mistakes);
    const bool same =
        again.instructions.size() == block.instructions.size() && again.words.size() == block.words.size();
    if (!block.instructions.empty() && (!read || !mistakes.empty() || !same)) std::abort();
  }
  klartext::writeProgram(program);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  klartext::KlartextProgram program("fuzz.h", text);
  for (const Diagnostic& mistake : klartext::checkProgram(program, control::ControlKind::iTNC530)) {
    if (mistake.message.empty() || mistake.place.line == 0) std::abort();
  }
  writeBack(program);
  fuzzing::run(std::make_shared<klartext::KlartextProgram>("fuzz.h", text), text);
  return 0;
}
