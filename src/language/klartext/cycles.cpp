#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "language/klartext/parser.hpp"

/// TCH PROBE and CYCL DEF with parameters Q200=..., and the choice between this and the old form n.0, n.1.
namespace probewright::language::klartext {

namespace {

constexpr int highestCycle = 9999;

/// Where the parameters begin in the line of a cycle's name: at a Q, after a blank, whose number is followed by '='.
bool parameterBegins(const Lexer& lexer) {
  if (upper(lexer.here()) != 'Q') return false;
  std::size_t i = 1;
  if (std::string_view("SLR").find(upper(lexer.here(i))) != std::string_view::npos) ++i;
  while (isBlankOrReturn(lexer.here(i)))
    ++i;
  if (!isDigit(lexer.here(i))) return false;
  while (isDigit(lexer.here(i)))
    ++i;
  while (isBlankOrReturn(lexer.here(i)))
    ++i;
  return lexer.here(i) == '=';
}

}  // namespace

bool BlockParser::skipCycleName() {
  const auto coordinateAt = [this](std::size_t at) {
    const char axis = upper(lexer_.here(at)), sign = lexer_.here(at + 1);
    const bool named = axis != '\0' && std::string_view("XYZABCUVWIJKRH").find(axis) != std::string_view::npos;
    return named && (sign == '+' || sign == '-') && isDigit(lexer_.here(at + 2));
  };
  const auto axisBegins = [&] { return coordinateAt(0) || (upper(lexer_.here()) == 'I' && coordinateAt(1)); };
  bool behindBlank = true;
  for (char c = lexer_.here(); c != '\0' && c != '\n' && c != ';'; c = lexer_.here()) {
    if (behindBlank && parameterBegins(lexer_)) return true;
    if (behindBlank && axisBegins())
      return error("this block defines a cycle and moves no axis", "write the position in a block of its own");
    behindBlank = isBlankOrReturn(c);
    lexer_.advance();
  }
  return true;
}

bool BlockParser::touchProbe() {
  if (!isDigit(lexer_.peek())) return error("the number of the touch probe cycle is expected after TCH PROBE");
  int number = 0;
  for (; isDigit(lexer_.here()) && number <= highestCycle; lexer_.advance())
    number = number * 10 + (lexer_.here() - '0');
  if (lexer_.here() == '.' && isDigit(lexer_.here(1))) return oldProbeCycle(number);
  constexpr int firstWithParameters = 400;
  if (number < firstWithParameters) {
    return error(fmt::format("touch probe cycle {} is written in parts", number),
                 fmt::format("write TCH PROBE {}.0 and its other parts below", number));
  }
  return parameterCycle("TCH PROBE", number);
}

bool BlockParser::cycleDefinition() {
  if (!isDigit(lexer_.peek())) return error("the number of the cycle is expected after CYCL DEF");
  int number = 0;
  for (; isDigit(lexer_.here()) && number <= highestCycle; lexer_.advance())
    number = number * 10 + (lexer_.here() - '0');
  if (lexer_.here() == '.' && isDigit(lexer_.here(1))) return oldCycle(number);
  constexpr std::array inParts = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 18, 19, 26, 32};
  if (std::ranges::find(inParts, number) != inParts.end()) {
    return error(fmt::format("cycle {} is written in parts", number),
                 fmt::format("write CYCL DEF {}.0 and its other parts below", number));
  }
  return parameterCycle("CYCL DEF", number);
}

bool BlockParser::parameterCycle(std::string_view kind, int number) {
  lexer_.setComments(Lexer::Comments::ToLineEnd);
  if (number < 0) {  // GLOBAL DEF has its number after it
    const std::optional<double> written = lexer_.number();
    if (!written || *written > highestCycle) return error("the number of the global definition is expected here");
    number = static_cast<int>(*written);
  }
  const std::size_t first = block_.words.size();
  if (kind == "GLOBAL DEF") addWord(0, Operand::of(number));
  if (!skipCycleName() || !cycleParameters(first)) return false;
  const WordRange words = wordsSince(first);
  if (kind == "GLOBAL DEF") {
    emit(Command{constant(nameOf(CommandKind::GlobalDefinition)), {}, -1, words});
  } else if (kind == "CYCL DEF" && number == 247) {
    if (words.count != 1 || block_.words[first].address != 339) {
      return error("cycle 247 takes Q339 with the row of the preset table and nothing else", "write Q339=+1");
    }
    emit(Transform{constant(nameOf(TransformKind::PresetByCycle)), words, {}});
  } else {
    emit(CycleCall{number, constant(kind), words});
  }
  return true;
}

bool BlockParser::cycleParameters(std::size_t firstWord) {
  bool once = true;
  while (!lexer_.atEnd()) {
    if (!cycleParameter()) return false;
    const Word& added = block_.words.back();
    const bool known =
        std::any_of(block_.words.begin() + static_cast<std::ptrdiff_t>(firstWord), block_.words.end() - 1,
                    [&](const Word& other) { return other.address == added.address; });
    if (!known) continue;
    once = errorAt(added, fmt::format("Q{} is given twice in this cycle", added.address), "remove one of the two");
  }
  return once;
}

bool BlockParser::cycleParameter() {
  constexpr int monitoredTool = 330;
  if (!variableFollows()) {
    return error("a parameter Qn = value of the cycle is expected here",
                 "write each parameter as Qn=value ;COMMENT, and ~ if another one follows");
  }
  const std::uint32_t column = lexer_.column();
  const std::uint32_t line = lexer_.line();
  const VariableRef parameter = *variable();
  if (!expect('=', "the parameter of the cycle")) return false;
  std::optional<Operand> assigned;
  if (const std::optional<std::string_view> text = lexer_.quoted()) {
    assigned = textOperand(ref(*text));
  } else if (lexer_.acceptKeyword("PREDEF")) {
    assigned = callHost("PREDEF", {parameter.index[0]});
  } else if (lexer_.acceptKeyword("MAX") || lexer_.acceptKeyword("FMAX")) {
    assigned = textOperand(constant("FMAX"));
  } else if (lexer_.acceptKeyword("FAUTO") || lexer_.acceptKeyword("AUTO")) {
    assigned = textOperand(constant("FAUTO"));
  } else if (lexer_.peek() == 'F' && (upper(lexer_.here(1)) == 'U' || upper(lexer_.here(1)) == 'Z')) {
    const bool perRevolution = upper(lexer_.here(1)) == 'U';
    lexer_.advance(2);
    const std::optional<Operand> feed = value("the feed");
    if (feed) assigned = callHost(perRevolution ? "FU" : "FZ", {*feed});
  } else if (parameter.space == VariableSpace::QS && isWordByte(lexer_.peek()) && !variableFollows()) {
    // Printed programs leave the quotation marks out.
    const std::string_view bare = lexer_.chunk();
    if (bare.find('"') != std::string_view::npos) return error("the quotation marks of this text do not match");
    assigned = textOperand(ref(bare));
  } else if (parameter.index[0].number == monitoredTool && lexer_.peek() == '"' && isWordByte(lexer_.here(1))) {
    // The control shows a tool's name without its closing quotation mark.
    lexer_.advance(1);
    assigned = textOperand(ref(lexer_.chunk()));
  } else {
    assigned = formula();
  }
  if (!assigned) return false;
  Word& added = addWord(static_cast<std::uint32_t>(parameter.index[0].number), *assigned);
  added.column = column;
  added.line = line;
  return true;
}

}  // namespace probewright::language::klartext
