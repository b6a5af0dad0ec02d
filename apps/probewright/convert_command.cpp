#include <fmt/format.h>

#include "base/file.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "session/convert.hpp"
#include "simulation/setup.hpp"

namespace probewright::app {

int convert(const ConvertArguments& arguments) {
  const auto refuse = [](const Diagnostic& why) {
    print({why});
    return 2;
  };
  const Result<std::string> text = readFile(arguments.input);
  if (!text) return refuse(text.error());
  if (text->find_first_not_of(" \t\r\n\x1a\xEF\xBB\xBF") == std::string::npos) {
    return refuse({Severity::Error,
                   {arguments.input.string(), 0, 0},
                   "the program is empty",
                   {},
                   "check that the file was saved and copied whole",
                   {}});
  }
  const auto from = session::languageOf(arguments.input, *text);
  if (!from) {
    return refuse({Severity::Error,
                   {arguments.input.string(), 0, 0},
                   "neither the ending nor the text tells the language of this program",
                   {},
                   "give it an ending: .H, .I, .MPF",
                   {}});
  }
  const auto to = session::languageOf(arguments.output, {});
  if (!to) {
    return refuse({Severity::Error,
                   {arguments.output.string(), 0, 0},
                   "the ending does not tell the language to convert to",
                   {},
                   "end the name with .H for Klartext, .I for DIN/ISO or .MPF for a SINUMERIK",
                   {}});
  }
  if (!session::convertible(*from, *to)) {
    return refuse({Severity::Error,
                   {arguments.input.string(), 0, 0},
                   fmt::format("the program is one of {} already", session::nameOf(*from)),
                   {},
                   "name a file with the ending of another language: .H, .I or .MPF",
                   {}});
  }
  Diagnostics found;
  std::optional<simulation::Setup> setup;
  if (!arguments.setup.empty()) {
    setup = simulation::readSetup(arguments.setup, found);
    if (!setup) {
      print(found);
      return 2;
    }
  }
  conversion::GlobalData globalData;
  if (*from == session::ProgramLanguage::Sinumerik)
    globalData = session::globalDataFor(arguments.input, setup ? &*setup : nullptr, found);
  print(found);
  if (hasErrors(found)) return 2;
  if (arguments.control && (*to == session::ProgramLanguage::Sinumerik) == control::isHeidenhain(*arguments.control)) {
    return refuse({Severity::Error,
                   {arguments.output.string(), 0, 0},
                   fmt::format("the {} does not read {}", control::name(*arguments.control), session::nameOf(*to)),
                   {},
                   "leave --control out, or name a control of the language of OUT",
                   {}});
  }
  const auto program = session::openProgram(arguments.input, *text, *from);
  if (!program) return refuse(program.error());
  const session::Conversion conversion = session::convert(
      **program, *from, *to,
      {.globalData = &globalData, .control = arguments.control.value_or(control::ControlKind::TNC640)});
  const language::Encoding encoding = language::detectEncoding(*text);
  print(conversion.mistakes, encoding);
  if (hasErrors(conversion.mistakes)) {
    if (const auto note = session::otherLanguage(arguments.input, *text)) print({*note});
    return 2;
  }
  if (const Result<void> written = writeFileAtomically(arguments.output, conversion.text); !written) {
    return refuse(written.error());
  }
  print(conversion.notCarriedOver, encoding);
  return conversion.notCarriedOver.empty() ? 0 : 1;
}

}  // namespace probewright::app
