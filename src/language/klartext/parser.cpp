#include "language/klartext/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/nearest_name.hpp"
#include "language/klartext/meant_word.hpp"

namespace probewright::language::klartext {

TextRef BlockParser::ref(std::string_view part) const {
  if (part.empty()) return {};
  return {static_cast<std::uint32_t>(lexer_.offsetOf(part)), static_cast<std::uint32_t>(part.size())};
}

bool BlockParser::error(std::string message, std::string advice) {
  const std::string_view text = lexer_.text();
  const std::size_t at = std::min(lexer_.offset(), text.size());
  const std::size_t before = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
  report(lexer_.line(), lexer_.column(), text.substr(before == std::string_view::npos ? 0 : before + 1),
         std::move(message), std::move(advice));
  return false;
}

bool BlockParser::errorAt(const Word& word, std::string message, std::string advice) {
  std::string_view text = lexer_.text();
  for (std::uint32_t line = word.line; line > 0 && text.find('\n') != std::string_view::npos; --line)
    text.remove_prefix(text.find('\n') + 1);
  report(word.line, word.column, text, std::move(message), std::move(advice));
  return false;
}

/// `text` begins with the line of the mistake.
void BlockParser::report(std::uint32_t line, std::uint32_t column, std::string_view text, std::string message,
                         std::string advice) {
  Diagnostic diagnostic;
  diagnostic.place = {file_, block_.position.line + line, column};
  diagnostic.message = std::move(message);
  diagnostic.advice = std::move(advice);
  diagnostic.excerpt = trimmedAtEnd(text.substr(0, text.find('\n')), blanksAndReturn);
  diagnostics_.push_back(std::move(diagnostic));
}

/// Refuses a word that stands among those from `first` on twice.
bool BlockParser::eachOnce(std::size_t first, std::string_view where) {
  for (std::size_t i = first; i < block_.words.size(); ++i) {
    const Word& word = block_.words[i];
    for (std::size_t k = first; k < i; ++k) {
      if (block_.words[k].address != word.address) continue;
      return errorAt(word, fmt::format("{} is given twice in this {}", addressName(word.address), where),
                     "remove one of the two");
    }
  }
  return true;
}

bool BlockParser::expect(char wanted, std::string_view after) {
  if (lexer_.accept(wanted)) return true;
  return error(std::string("'") + wanted + "' is expected after " + std::string(after));
}

bool BlockParser::expectEnd() {
  if (lexer_.atEnd()) return true;
  return error("the block should end here", "put a comment after ';' or write a block of its own");
}

/// False, with a complaint, if the block has a number that no double holds.
bool BlockParser::numbersFit() {
  if (!lexer_.tooLarge()) return true;
  lexer_.seek(*lexer_.tooLarge());
  return error("this number is too large to compute with", "correct it: numbers reach up to 1.7 * 10^308");
}

void BlockParser::parse() {
  if (lexer_.peek() == '/') {
    block_.skippable = true;
    lexer_.advance();
  }
  lexer_.peek();
  while (isDigit(lexer_.here()))
    lexer_.advance();
  if (lexer_.peek() == '/') {
    block_.skippable = true;
    lexer_.advance();
  }
  if (!statement() || !numbersFit() || !formulasFit()) block_.instructions.clear();
}

bool BlockParser::textCommand(CommandKind kind) {
  emit(Command{constant(nameOf(kind)), ref(lexer_.restOfBlock()), -1, {}});
  return true;
}

bool BlockParser::statement() {
  const char first = lexer_.peek();
  const char second = upper(lexer_.here(1));
  const bool single = !isLetter(second);
  switch (first) {
    case '\0':
    case '*':
      return true;  // empty, comment, structure
    case 'L':
      if (lexer_.acceptPrefix("LBL")) return label();
      if (lexer_.acceptKeyword("LABEL"))
        return error("this is not a block of the Klartext language", "Did you mean LBL?");
      lexer_.advance();
      if (second == 'P' && !isLetter(lexer_.here(1))) {
        lexer_.advance();
        return move(MoveKind::Linear, pathWords("LP"));
      }
      if (second == 'N' && !isLetter(lexer_.here(1))) {
        lexer_.advance();
        return move(MoveKind::Linear, pathWords("LN"));
      }
      return move(MoveKind::Linear, pathWords("L"));
    case 'C':
      if (lexer_.acceptKeyword("CYCL")) {
        if (lexer_.acceptKeyword("DEF")) return cycleDefinition();
        if (lexer_.acceptKeyword("CALL")) return cycleCall();
        return error("DEF or CALL is expected after CYCL", meantWord(lexer_, {"DEF", "CALL"}));
      }
      if (lexer_.acceptKeyword("CALL")) {
        if (lexer_.acceptPrefix("LBL")) return callLabel();
        if (lexer_.acceptKeyword("SELECTED PGM")) return callSelectedProgram();
        if (lexer_.acceptKeyword("PGM")) return callProgram();
        return error("LBL or PGM is expected after CALL", meantWord(lexer_, {"LBL", "PGM"}));
      }
      if (lexer_.acceptKeyword("CC")) return move(MoveKind::SetCentre, pathWords("CC"));
      if (lexer_.acceptKeyword("CR")) return arcWithRadius();
      if (lexer_.acceptKeyword("CTP")) return move(MoveKind::ArcTangential, pathWords("CTP"));
      if (lexer_.acceptKeyword("CT")) return move(MoveKind::ArcTangential, pathWords("CT"));
      if (lexer_.acceptKeyword("CP")) return arc(pathWords("CP"));
      if (lexer_.acceptKeyword("CHF")) return move(MoveKind::Chamfer, pathWords("CHF"));
      if (lexer_.acceptKeyword("CONTOUR")) return textCommand(CommandKind::Contour);
      if (single && (second == '+' || second == '-' || isDigit(second))) return move(MoveKind::Linear, pathWords("L"));
      if (single) {
        lexer_.advance();
        return arc(pathWords("C"));
      }
      break;
    case 'Q':
      if (variableFollows()) return assignment();
      break;
    case 'F':
      if (second == 'N' && !isLetter(lexer_.here(2))) return lexer_.advance(2), function();
      if (lexer_.acceptKeyword("FUNCTION")) return functionKeyword();
      for (const CommandKind kind :
           {CommandKind::FreeLineTangential, CommandKind::FreeArcTangential, CommandKind::FreePole,
            CommandKind::FreeSelection, CommandKind::FreeLine, CommandKind::FreeArc}) {
        if (lexer_.acceptKeyword(nameOf(kind))) return textCommand(kind);
      }
      if (!isLetter(second) || lexer_.acceptKeyword("FMAX") || lexer_.acceptKeyword("FAUTO")) {
        return machineFunctionBlock();
      }
      break;
    case 'T':
      if (lexer_.acceptKeyword("TCH")) {
        if (!lexer_.acceptPrefix("PROBE")) return error("PROBE is expected after TCH", meantWord(lexer_, {"PROBE"}));
        return touchProbe();
      }
      if (lexer_.acceptKeyword("TOOL")) {
        if (lexer_.acceptPrefix("CALL")) return toolCall();
        if (lexer_.acceptPrefix("DEF")) return toolDefinition();
        return error("CALL or DEF is expected after TOOL", meantWord(lexer_, {"CALL", "DEF"}));
      }
      if (lexer_.acceptKeyword("TRANS")) return transformation();
      if (lexer_.acceptKeyword("TABDATA")) return tableData();
      break;
    case 'M':
      if (isDigit(second) || isBlankOrReturn(second)) return machineFunctionBlock();
      if (lexer_.acceptKeyword("MONITORING")) return textCommand(CommandKind::Monitoring);
      break;
    case 'B':
      if (lexer_.acceptKeyword("BEGIN")) return beginOrEnd();
      if (lexer_.acceptKeyword("BLK")) return blankForm();
      break;
    case 'E':
      if (lexer_.acceptKeyword("END")) {
        if (lexer_.acceptPrefix("PGM")) {
          emit(EndProgram{});
          return true;
        }
        return error("PGM is expected after END");
      }
      if (lexer_.acceptKeyword("ERROR")) {
        lexer_.accept('=');
        return textCommand(CommandKind::Error);
      }
      break;
    case 'R':
      if (lexer_.acceptPrefix("RND")) return move(MoveKind::Rounding, pathWords("RND"));
      break;
    case 'A':
      if (lexer_.acceptKeyword("APPR")) return approachOrDepart(MoveKind::Approach);
      break;
    case 'D':
      if (lexer_.acceptKeyword("DEP")) return approachOrDepart(MoveKind::Depart);
      if (lexer_.acceptKeyword("DECLARE")) {
        if (lexer_.acceptKeyword("STRING")) return assignment();
        return textCommand(CommandKind::Declare);
      }
      break;
    case 'P':
      if (lexer_.acceptKeyword("PLANE")) return plane();
      if (lexer_.acceptKeyword("PRESET")) return presetKeyword();
      if (lexer_.acceptKeyword("PATTERN")) return patternDefinition();
      break;
    case 'S':
      if (lexer_.acceptKeyword("STOP")) return stop();
      if (lexer_.acceptKeyword("SEL")) return selection();
      if (lexer_.acceptKeyword("SQL")) return textCommand(CommandKind::Sql);
      if (lexer_.acceptKeyword("SECTION")) return textCommand(CommandKind::Section);
      break;
    case 'O':
      if (lexer_.acceptKeyword("OPEN")) {
        return lexer_.acceptKeyword("FILE") ? textCommand(CommandKind::OpenFile) : error("FILE is expected after OPEN");
      }
      break;
    case 'G':
      if (lexer_.acceptKeyword("GLOBAL")) {
        if (!lexer_.acceptKeyword("DEF")) return error("DEF is expected after GLOBAL");
        return parameterCycle("GLOBAL DEF", -1);
      }
      break;
    default:
      break;
  }
  if (std::string_view("XYZABUVWI").find(first) != std::string_view::npos && single) {
    return move(MoveKind::Linear, pathWords("L"));
  }
  if (first == 'I' && std::string_view("XYZABCUVW").find(second) != std::string_view::npos) {
    return move(MoveKind::Linear, pathWords("L"));
  }
  return error("this is not a block of the Klartext language", meantKeyword());
}

/// Advice for a block that begins with no keyword: the keyword that is nearly the same, or all kinds of blocks.
std::string BlockParser::meantKeyword() {
  static const std::vector<std::string> keywords = {"TOOL CALL",
                                                    "TOOL DEF",
                                                    "CYCL DEF",
                                                    "CYCL CALL",
                                                    "TCH PROBE",
                                                    "CALL LBL",
                                                    "CALL PGM",
                                                    "BEGIN PGM",
                                                    "END PGM",
                                                    "BLK FORM",
                                                    "GLOBAL DEF",
                                                    "PATTERN DEF",
                                                    "SEL TABLE",
                                                    "SEL PGM",
                                                    "SEL PATTERN",
                                                    "SEL CYCLE",
                                                    "PLANE SPATIAL",
                                                    "PLANE RESET",
                                                    "PLANE AXIAL",
                                                    "FUNCTION TCPM",
                                                    "TRANS DATUM",
                                                    "TRANS MIRROR",
                                                    "TRANS ROTATION",
                                                    "PRESET SELECT",
                                                    "PRESET CORR",
                                                    "TABDATA READ",
                                                    "LBL",
                                                    "STOP",
                                                    "FN",
                                                    "RND",
                                                    "CHF",
                                                    "APPR",
                                                    "DEP"};
  std::string written;
  std::size_t words = 1;
  for (std::size_t i = 0; i < 30; ++i) {
    const char c = lexer_.here(i);
    if (isBlankOrReturn(c) && ++words > 2) break;
    if (!isLetter(c) && !isBlankOrReturn(c)) break;
    written += isBlankOrReturn(c) ? ' ' : upper(c);
  }
  while (written.ends_with(' '))
    written.pop_back();
  if (written.size() > 3) {
    if (const auto near = nearestName(written, keywords)) return fmt::format("Did you mean {}?", *near);
  }
  return "begin the block with a path function (L, CC, C...), TOOL CALL, CYCL DEF, TCH PROBE, FN, Q or M; begin "
         "comments with ';'";
}

bool BlockParser::beginOrEnd() {
  if (!lexer_.acceptPrefix("PGM")) return error("PGM is expected after BEGIN");
  const std::string_view head = lexer_.restOfLine();
  if (!endsWithWord(head, "MM") && !endsWithWord(head, "INCH"))
    return error("MM or INCH is expected at the end of BEGIN PGM");
  emit(Command{constant(nameOf(CommandKind::BeginProgram)), ref(head), -1, {}});
  return true;
}

/// BLK FORM is a picture for the control's graphics; the words of the corner points are kept, other forms as text.
bool BlockParser::blankForm() {
  if (!lexer_.acceptKeyword("FORM")) return error("FORM is expected after BLK");
  return textCommand(CommandKind::BlankForm);
}

bool BlockParser::stop() {
  emit(Stop{});
  while (lexer_.peek() == 'M') {
    if (!machineFunction(nullptr)) return false;
  }
  emitWithMachineFunctions(nullptr);
  return expectEnd();
}

}  // namespace probewright::language::klartext
