#include <fmt/format.h>

#include "base/file.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "session/convert.hpp"

namespace probewright::app {

int convert(const ConvertArguments& arguments) {
  const auto refuse = [](const Diagnostic& why) {
    print({why});
    return 2;
  };
  const Result<std::string> text = readFile(arguments.input);
  if (!text) return refuse(text.error());
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
  const auto program = session::programOf(arguments.input.string(), *text, *from);
  const session::Conversion conversion = session::convert(*program, *from, *to);
  const language::Encoding encoding = language::detectEncoding(*text);
  print(conversion.mistakes, encoding);
  if (hasErrors(conversion.mistakes)) return 2;
  if (const Result<void> written = writeFileAtomically(arguments.output, conversion.text); !written) {
    return refuse(written.error());
  }
  print(conversion.notCarriedOver, encoding);
  return conversion.notCarriedOver.empty() ? 0 : 1;
}

}  // namespace probewright::app
