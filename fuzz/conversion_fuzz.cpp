// Any text as a program that is converted, as the command line does it: read for mistakes first, then written in the
// other vendor's language and in the other language of its own control. Whatever is written must be a program of its
// language, or the conversion must say so. The first byte chooses languages and control.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "language/encoding.hpp"
#include "session/check.hpp"
#include "session/convert.hpp"
#include "session/source.hpp"

namespace {

using namespace probewright;
using control::ControlKind;
using session::ProgramLanguage;

void convertOnce(const std::string& text, ProgramLanguage from, ProgramLanguage to, ControlKind control) {
  const char* name = from == ProgramLanguage::Sinumerik ? "fuzz.mpf"
                     : from == ProgramLanguage::DinIso  ? "fuzz.i"
                                                        : "fuzz.h";
  const auto program = session::programOf(name, text, from);
  const ControlKind reads = from == ProgramLanguage::Sinumerik ? ControlKind::Sinumerik840Dsl : ControlKind::TNC640;
  if (hasErrors(session::checkProgram(*program, reads))) return;
  const conversion::Conversion written =
      conversion::convert(*program, from, to, {.globalData = {}, .control = control});
  if (hasErrors(written.mistakes)) return;
  for (const Diagnostic& each : written.notCarriedOver)
    if (each.message.empty()) std::abort();
  const auto again = session::programOf("written", written.text, to);
  language::Block block;
  Diagnostics mistakes;
  for (language::BlockPosition at = again->begin(); again->parse(at, block, mistakes); at = block.next) {
    if (block.next.offset <= at.offset) std::abort();
  }
  if (hasErrors(mistakes) && written.notCarriedOver.empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  language::toUtf8(text, language::detectEncoding(text));
  const ControlKind control = (data[0] & 4) != 0 ? ControlKind::iTNC530 : ControlKind::TNC640;
  switch (data[0] % 4) {
    case 0:
      convertOnce(text, ProgramLanguage::Klartext, ProgramLanguage::Sinumerik, control);
      break;
    case 1:
      convertOnce(text, ProgramLanguage::Sinumerik, ProgramLanguage::Klartext, control);
      break;
    case 2:
      convertOnce(text, ProgramLanguage::DinIso, ProgramLanguage::Sinumerik, control);
      break;
    default:
      convertOnce(text, ProgramLanguage::Sinumerik, ProgramLanguage::DinIso, control);
      break;
  }
  return 0;
}
