#include "conversion/convert.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "conversion/dialects.hpp"
#include "language/klartext/check.hpp"
#include "language/klartext/heidenhain_program.hpp"

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

/// Checks what was written for a HEIDENHAIN control as this would: a mistake in it is named.
void readBack(Conversion& conversion, const language::Program& original, ProgramLanguage language,
              control::ControlKind control) {
  if (hasErrors(conversion.mistakes)) return;
  const auto written = programFromText(original.file(), conversion.text, language);
  const Diagnostics mistakes = language::klartext::checkProgram(dynamic_cast<HeidenhainProgram&>(*written), control);
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

Conversion betweenOwn(language::Program& program, ProgramLanguage from, ProgramLanguage to,
                      const ConvertOptions& options) {
  Conversion conversion = betweenDialects(dynamic_cast<HeidenhainProgram&>(program), from, to, options.toolCycles);
  // A program may have parameters that the older control does not know.
  if (options.control == control::ControlKind::iTNC530) readBack(conversion, program, to, options.control);
  return conversion;
}

Conversion klartextToSinumerik(language::Program& program, ProgramLanguage, ProgramLanguage,
                               const ConvertOptions& options) {
  return toSinumerik(dynamic_cast<HeidenhainProgram&>(program), options.job, options.probe);
}

Conversion sinumerikToKlartext(language::Program& program, ProgramLanguage, ProgramLanguage to,
                               const ConvertOptions& options) {
  Conversion conversion = toKlartext(dynamic_cast<language::sinumerik::SinumerikProgram&>(program),
                                     options.globalData.get(), options.control, options.job, options.probe);
  if (options.toolCycles == ToolCycles::Old && !hasErrors(conversion.mistakes)) {
    const auto written = programFromText(program.file(), conversion.text, to);
    conversion.text = betweenDialects(dynamic_cast<HeidenhainProgram&>(*written), to, to, options.toolCycles).text;
  }
  readBack(conversion, program, to, options.control);
  return conversion;
}

/// A way from one language into another that needs none between.
struct Way {
  ProgramLanguage from, to;
  Conversion (*convert)(language::Program& program, ProgramLanguage from, ProgramLanguage to,
                        const ConvertOptions& options);
};

constexpr auto klartext = ProgramLanguage::Klartext, dinIso = ProgramLanguage::DinIso,
               sinumerik = ProgramLanguage::Sinumerik;
/// All of them; where two languages have none, others may lead from the one to the other.
constexpr std::array ways = {Way{klartext, klartext, betweenOwn},
                             Way{klartext, dinIso, betweenOwn},
                             Way{dinIso, klartext, betweenOwn},
                             Way{dinIso, dinIso, betweenOwn},
                             Way{klartext, sinumerik, klartextToSinumerik},
                             Way{sinumerik, klartext, sinumerikToKlartext}};

/// The shortest way over others; empty if there is none. A language becomes itself only by a way of its own.
std::vector<const Way*> wayOver(ProgramLanguage from, ProgramLanguage to) {
  std::vector<std::vector<const Way*>> begun = {{}};
  std::set<ProgramLanguage> reached = {from};
  for (std::size_t i = 0; i < begun.size(); ++i) {
    const ProgramLanguage here = begun[i].empty() ? from : begun[i].back()->to;
    for (const Way& next : ways) {
      if (next.from != here) continue;
      std::vector<const Way*> longer = begun[i];
      longer.push_back(&next);
      if (next.to == to && (from != to || longer.size() == 1)) return longer;
      if (reached.insert(next.to).second) begun.push_back(std::move(longer));
    }
  }
  return {};
}

}  // namespace

bool convertible(ProgramLanguage from, ProgramLanguage to) { return !wayOver(from, to).empty(); }

bool hasToolCycleForms(ProgramLanguage language) { return language == klartext; }

Conversion convert(language::Program& program, ProgramLanguage from, ProgramLanguage to,
                   const ConvertOptions& options) {
  Conversion conversion;
  const std::vector<const Way*> route = wayOver(from, to);
  for (std::size_t i = 0; i < route.size(); ++i) {
    const Way& way = *route[i];
    const auto halfway = i == 0 ? nullptr : programFromText(program.file(), conversion.text, way.from);
    Conversion next = way.convert(halfway ? *halfway : program, way.from, way.to, options);
    if (halfway) {
      for (Diagnostic& each : next.notCarriedOver)
        placeInOriginal(each, program, conversion.origins);
      next.notCarriedOver.insert(next.notCarriedOver.begin(),
                                 std::make_move_iterator(conversion.notCarriedOver.begin()),
                                 std::make_move_iterator(conversion.notCarriedOver.end()));
    }
    conversion = std::move(next);
    if (hasErrors(conversion.mistakes)) break;
  }
  return conversion;
}

}  // namespace probewright::conversion
