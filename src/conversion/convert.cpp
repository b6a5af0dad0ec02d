#include "conversion/convert.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/text.hpp"
#include "conversion/dialects.hpp"
#include "language/klartext/check.hpp"
#include "language/klartext/heidenhain_program.hpp"
#include "language/sinumerik/check.hpp"

namespace probewright::conversion {

using language::Block;
using language::BlockPosition;
using language::programFromText;
using language::ProgramLanguage;
using language::klartext::HeidenhainProgram;

namespace {

/// Leads a message about a program half way, which the user has not seen, back to the block that its line comes from.
void placeInOriginal(Diagnostic& message, language::Program& program, const std::vector<BlockPosition>& origins) {
  const std::uint64_t line = message.place.line;
  message.place.line = message.place.column = 0;
  if (line == 0 || line > origins.size()) return;
  Block block;
  Diagnostics ignored;
  const BlockPosition& origin = origins[line - 1];
  if (!program.parse(origin, block, ignored)) return;
  message.place.line = origin.line;
  message.place.column = 1;
  const std::string_view source = block.at(block.source);
  message.excerpt = trimmedAtEnd(source.substr(0, source.find('\n')), lineBlanks);
}

/// Checks what was written as its control would: a mistake in it is named.
void readBack(Conversion& conversion, const language::Program& original, ProgramLanguage language,
              control::ControlKind control) {
  if (hasErrors(conversion.mistakes)) return;
  const auto written = programFromText(original.file(), conversion.text, language);
  const Diagnostics mistakes =
      language == ProgramLanguage::Sinumerik
          ? language::sinumerik::check(dynamic_cast<language::sinumerik::SinumerikProgram&>(*written))
          : language::klartext::checkProgram(dynamic_cast<HeidenhainProgram&>(*written), control);
  for (const Diagnostic& each : mistakes) {
    if (each.severity != Severity::Error) continue;
    conversion.notCarriedOver.push_back({Severity::Warning,
                                         {original.file(), 0, 0},
                                         fmt::format("line {} of the program that was written is refused by the {}: {}",
                                                     each.place.line, control::name(control), each.message),
                                         each.excerpt,
                                         each.advice,
                                         {}});
  }
}

}  // namespace

bool convertible(ProgramLanguage from, ProgramLanguage to) {
  return from != ProgramLanguage::Sinumerik || to != ProgramLanguage::Sinumerik;
}

Conversion convert(language::Program& program, ProgramLanguage from, ProgramLanguage to,
                   const ConvertOptions& options) {
  const bool vendors = from == ProgramLanguage::Sinumerik || to == ProgramLanguage::Sinumerik;
  if (!vendors) {
    Conversion conversion = betweenDialects(dynamic_cast<HeidenhainProgram&>(program), from, to, options.toolCycles);
    // A program may have parameters that the older control does not know.
    if (options.control == control::ControlKind::iTNC530) readBack(conversion, program, to, options.control);
    return conversion;
  }
  const auto between = [&](ProgramLanguage first, ProgramLanguage second, ProgramLanguage last) {
    Conversion begun = convert(program, first, second, options);
    if (hasErrors(begun.mistakes)) return begun;
    const auto halfway = programFromText(program.file(), begun.text, second);
    Conversion ended = convert(*halfway, second, last, options);
    for (Diagnostic& each : ended.notCarriedOver) {
      placeInOriginal(each, program, begun.origins);
      begun.notCarriedOver.push_back(std::move(each));
    }
    ended.notCarriedOver = std::move(begun.notCarriedOver);
    return ended;
  };
  if (from == ProgramLanguage::Sinumerik && to == ProgramLanguage::Klartext) {
    Conversion conversion = toKlartext(dynamic_cast<language::sinumerik::SinumerikProgram&>(program),
                                       options.globalData, options.control, options.job, options.probe);
    if (options.toolCycles == ToolCycles::Old && !hasErrors(conversion.mistakes)) {
      const auto written = programFromText(program.file(), conversion.text, to);
      conversion.text = betweenDialects(dynamic_cast<HeidenhainProgram&>(*written), to, to, options.toolCycles).text;
    }
    readBack(conversion, program, to, options.control);
    return conversion;
  }
  if (from == ProgramLanguage::Klartext)
    return toSinumerik(dynamic_cast<HeidenhainProgram&>(program), options.job, options.probe);
  return between(from, ProgramLanguage::Klartext, to);
}

}  // namespace probewright::conversion
